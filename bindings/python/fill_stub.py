"""Writes the package's type stub: that of a file, with the options of mesh() filled in from their declarations.

    fill_stub.py FROM TO      run by the build, with the package in PYTHONPATH
"""
import pathlib
import sys

MARK = "    # Here stand the options of `scantet mesh`.\n"
TYPES = {"flag": "bool", "number": "float | str | None", "integer": "int", "choice": "str", "text": "_Text",
         "list": "_Texts", "numbers": "float | Sequence[float] | None"}


def main(given, made):
    sys.path.pop(0)  # this file's folder, where the package's sources are
    import scantet
    lines = [f"    {keyword}: {'_Images' if keyword == 'tissue' else TYPES[option['kind']]} = ...,\n"
             for keyword, option in sorted(scantet.options().items())]
    stub = pathlib.Path(given).read_text(encoding="utf-8")
    assert stub.count(MARK) == 1
    pathlib.Path(made).write_text(stub.replace(MARK, "".join(lines)), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
