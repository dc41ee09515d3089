"""`python3 -m scantet_cohort`: what `scantet cohort` executes."""
import sys

from scantet_cohort.command_line import main

if sys.stdout:
    sys.stdout.reconfigure(errors="backslashreplace")  # type: ignore[attr-defined]  # names of files need be no text
sys.exit(main(sys.argv[1:]))
