"""What the tables of codes in docs/ are held to, whatever the codes are of: the code has each, has no other, and each row is whole."""
import re
import sys
from pathlib import Path

ROW = re.compile(r"^\| `([a-z_]+\.[a-z_]+)` \|(.*)$", re.MULTILINE)


def table_faults(page, text, made, cells):
    """text: of the page, or of its part with the table. made: by code the source that makes it. cells: what a row says."""
    rows = ROW.findall(text)
    listed = [code for code, _ in rows]
    for code in sorted(set(made) - set(listed)):
        yield f"{page}: lacks {code}, which {made[code]} has"
    for code in sorted(set(listed) - set(made)):
        yield f"{page}: has {code}, which no source has; remove it"
    for code in sorted(code for code in set(listed) if listed.count(code) > 1):
        yield f"{page}: has {code} twice"
    for code, rest in rows:
        if [cell.strip() for cell in rest.split("|")].count("") != 1:
            yield f"{page}: {code} lacks {cells}"


def listed_codes(text):
    return [code for code, _ in ROW.findall(text)]


def run(usage, faults, arguments):
    """Prints one line for each of faults(root). Return: the exit status."""
    if len(arguments) != 1:
        print(usage, file=sys.stderr)
        return 2
    root = Path(arguments[0]).resolve()
    found = list(faults(root))
    for fault in found:
        print(fault.replace(f"{root}/", ""), file=sys.stderr)
    return 1 if found else 0
