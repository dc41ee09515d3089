"""Writes the options into scantet/__init__.pyi, between its two marks, or checks that they are there (--check).

    PYTHONPATH=build/release/python scripts/python_stub.py [--check] [STUB]
"""
import pathlib
import sys

import scantet

BEGIN, END = "    # Options of `scantet mesh` (scripts/python_stub.py):\n", "    # End of the options.\n"
TYPES = {"flag": "bool", "number": "float | str | None", "integer": "int", "choice": "str", "text": "_Text",
         "list": "_Texts", "numbers": "float | Sequence[float] | None"}


def with_options(stub):
    lines = [f"    {keyword}: {'_Images' if keyword == 'tissue' else TYPES[option['kind']]} = ...,\n"
             for keyword, option in sorted(scantet.options().items())]
    parts = [stub]
    out = ""
    while BEGIN in parts[-1]:
        before, rest = parts[-1].split(BEGIN, 1)
        out += before + BEGIN + "".join(lines) + END
        parts.append(rest.split(END, 1)[1])
    return out + parts[-1]


def main(words):
    check = "--check" in words
    named = [word for word in words if word != "--check"]
    path = pathlib.Path(named[0]) if named else pathlib.Path(__file__).resolve().parents[1] / "bindings/python/scantet/__init__.pyi"
    stub = path.read_text(encoding="utf-8")
    made = with_options(stub)
    if not check:
        path.write_text(made, encoding="utf-8")
    elif made != stub:
        print(f"{path}: not the options that there are; run scripts/python_stub.py", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
