"""Holds the table of findings in docs/certificate.md against the verifier: it has every code of a finding, and no other.

    finding_codes.py ROOT

Prints one line for each fault, and ends with status 1 if there is any.
"""
import re
import sys

from code_table import listed_codes, run, table_faults

MADE = re.compile(r"""(?:\badd(?:_undecided|_found)?\(|\bVerifyFinding \w+\{)\s*"([a-z_]+\.[a-z_]+)\"""")
OF_SURFACES = re.compile(r"""add_undecided\(\s*"surface\." \+""")  # of the boundary's, when a surface is looked at itself
ON_SURFACES = ("contact", "crossing", "edge", "vertex")
FOLDERS = ("src/scantet/verify", "src/scantet/verification")


def made(root):
    """By code the source that makes it."""
    codes = {}
    for folder in FOLDERS:
        for path in sorted((root / folder).glob("*.cpp")):
            text = path.read_text(encoding="utf-8")
            for code in MADE.findall(text):
                codes.setdefault(code, path)
            if OF_SURFACES.search(text):
                codes.update({f"surface.{end}": path for end in ON_SURFACES})
    return codes


def faults(root):
    page = root / "docs/certificate.md"
    section = page.read_text(encoding="utf-8").partition("\n## Findings\n")[2].partition("\n## ")[0]
    yield from table_faults(page, section, made(root), "what it says, or how sure it is")
    listed = listed_codes(section)
    for first, second in zip(listed, listed[1:]):
        if first > second:
            yield f"{page}: {second} is out of order, after {first}"


if __name__ == "__main__":
    sys.exit(run(__doc__, faults, sys.argv[1:]))
