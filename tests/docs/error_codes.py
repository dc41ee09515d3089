"""Holds docs/errors.md against the code: it has every code of an error, and no other; and every code has a test.

    error_codes.py ROOT

Prints one line for each fault, and ends with status 1 if there is any. A test of a code names it; what a command refuses before there is
an Error to look at is tested by its message, with the code beside it.
"""
import re
import sys

from code_table import listed_codes, run, table_faults

CODE = re.compile(r"""["']((?:usage|input|output|internal)\.[a-z_]+)["']""")
THROWN = re.compile(r"""\bFault::[a-z]+,\s*"([a-z_]+\.[a-z_]+)\"""")  # of any first word
NAMED = re.compile(r"\b((?:usage|input|output)\.[a-z_]+)\b")
QUOTED = re.compile(r"""["']([a-z_]+\.[a-z_]+)["']""")  # of other first words, which variables have, too
SOURCES = ("src", "plugins", "bindings", "cohort")
SUFFIXES = (".h", ".cpp", ".cxx", ".py", ".in")


def files(root, folders):
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in SUFFIXES and path.is_file():
                yield path, "tests" in path.relative_to(root).parts


def named(text):
    return NAMED.findall(text) + QUOTED.findall(text)


def faults(root):
    thrown, tested = {}, set()
    for path, is_test in files(root, SOURCES):
        text = path.read_text(encoding="utf-8")
        for code in named(text) if is_test else CODE.findall(text) + THROWN.findall(text):
            tested.add(code) if is_test else thrown.setdefault(code, path)
    for path, _ in files(root, ["tests"]):
        if path.name not in ("error_codes.py", "error_codes_test.py"):
            tested.update(named(path.read_text(encoding="utf-8")))
    page = root / "docs/errors.md"
    text = page.read_text(encoding="utf-8")
    yield from table_faults(page, text, thrown, "its meaning or its remedy")
    codes = listed_codes(text)
    for first, second in zip(codes, codes[1:]):
        if first.split(".")[0] == second.split(".")[0] and first > second:
            yield f"{page}: {second} is out of order, after {first}"
    for code in sorted(set(thrown) - tested):
        if not code.startswith("internal."):
            yield f"{thrown[code]}: {code} has no test; one that provokes it names it"


if __name__ == "__main__":
    sys.exit(run(__doc__, faults, sys.argv[1:]))
