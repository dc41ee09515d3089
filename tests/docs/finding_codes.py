"""Holds the table of findings in docs/certificate.md against the verifier: it has every code of a finding, and no other.

    finding_codes.py ROOT

Prints one line for each fault, and ends with status 1 if there is any.
"""
import re
import sys
from pathlib import Path

MADE = re.compile(r"""(?:\badd(?:_undecided|_found)?\(|\bVerifyFinding \w+\{)\s*"([a-z_]+\.[a-z_]+)\"""")
OF_SURFACES = re.compile(r"""add_undecided\(\s*"surface\." \+""")  # of the boundary's, when a surface is looked at itself
ON_SURFACES = ("contact", "crossing", "edge", "vertex")
LISTED = re.compile(r"^\| `([a-z_]+\.[a-z_]+)` \|(.*)$", re.MULTILINE)
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
    codes = made(root)
    page = root / "docs/certificate.md"
    section = page.read_text(encoding="utf-8").partition("\n## Findings\n")[2].partition("\n## ")[0]
    rows = LISTED.findall(section)
    listed = [code for code, _ in rows]
    for code in sorted(set(codes) - set(listed)):
        yield f"{page}: lacks {code}, which {codes[code]} has"
    for code in sorted(set(listed) - set(codes)):
        yield f"{page}: has {code}, which no source has; remove it"
    for code, rest in rows:
        if [cell.strip() for cell in rest.split("|")].count("") != 1:
            yield f"{page}: {code} lacks what it says, or how sure it is"
    for first, second in zip(listed, listed[1:]):
        if first >= second:
            yield f"{page}: {second} is out of order, after {first}"


def main(arguments):
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    root = Path(arguments[0]).resolve()
    found = list(faults(root))
    for fault in found:
        print(fault.replace(f"{root}/", ""), file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
