"""`python3 -m scantet_cohort`: what `scantet cohort` executes."""
import sys

from scantet_cohort.command_line import main

sys.exit(main(sys.argv[1:]))
