#!/usr/bin/env python3
"""Counts what docs/checks.md's scorecard says of the sources: sizes, tests beside sources, raw memory, conditions, prints.

    scripts/scorecard.py

Lines are counted without those that are blank or comments alone. Standard library only.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests/architecture"))
from check_architecture import HIDING, code_files, functions, read_lines  # noqa: E402

SOURCES = ("src", "plugins")
CORE = ROOT / "src/scantet"
PROGRAM = CORE / "cli"  # which prints
RAW = re.compile(r"\bnew\s+[A-Za-z_(:]|\bdelete\b(?!\s*[;,)])|\bmalloc\(|\bfree\(")
CONDITION = re.compile(r"^\s*#\s*if", re.MULTILINE)
PRINT = re.compile(r"\bstd::(?:cout|cerr|clog)\b|\bf?printf\(|\bputs\(")


def code_of(path):
    """The text without comments and strings, and its lines that are not blank."""
    text = HIDING.sub(lambda match: re.sub(r"[^\n]", " ", match.group(0)), path.read_text(encoding="utf-8"))
    return text, sum(1 for line in text.splitlines() if line.strip())


def main():
    files = [path for path in code_files(ROOT) if path.relative_to(ROOT).parts[0] in SOURCES]
    tests = [path for path in code_files(ROOT) if path.relative_to(ROOT).parts[0] == "tests"]
    sizes = sorted((len(read_lines(path)), path) for path in files)
    print(f"files of src and plugins: {len(files)}, median {sizes[len(sizes) // 2][0]} lines, largest {sizes[-1][0]} ({sizes[-1][1].name}), "
          f"{100 * sum(1 for size, _ in sizes if size <= 400) / len(sizes):.1f} % with at most 400")
    longest = sorted(((last - first + 1, f"{path.relative_to(ROOT)}:{first}") for path in files
                      for first, last in functions(path.read_text(encoding="utf-8"))), reverse=True)
    print("ten longest functions:", ", ".join(f"{lines}" for lines, _ in longest[:10]), f"({longest[0][1]})")
    counts = {path: code_of(path) for path in files}
    lines = sum(count for _, count in counts.values())
    test_lines = sum(code_of(path)[1] for path in tests)
    print(f"lines of code: {lines}; of tests {test_lines}, {test_lines / lines:.2f} for each")

    def per_thousand(pattern, chosen):
        found = sum(len(pattern.findall(counts[path][0])) for path in chosen)
        return f"{found} ({1000 * found / sum(counts[path][1] for path in chosen):.2f} a thousand lines)"
    print("raw new, delete, malloc, free:", per_thousand(RAW, files))
    core = [path for path in files if CORE in path.parents and PROGRAM not in path.parents]
    print("#if in the library:", per_thousand(CONDITION, core), "; prints in it:", per_thousand(PRINT, core))
    sources = [path for path in core if path.suffix == ".cpp"]
    mirrored = sum(1 for path in sources
                   if (ROOT / "tests/unit" / path.parent.name / f"{path.stem}_test.cpp").exists())
    print(f"sources of the library with a unit test of their own name: {mirrored} of {len(sources)}")


if __name__ == "__main__":
    main()
