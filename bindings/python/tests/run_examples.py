"""Runs every Python block of the documentation, one after the other of a page in one session, in a folder with the
small inputs that the command's examples have, and the files of the command's examples made beforehand."""
import os
import pathlib
import sys
import tempfile
import warnings

import scantet


def main(root):
    root = pathlib.Path(root)
    sys.path.insert(0, str(root / "tests" / "docs"))
    from blocks import blocks_of, pages_of
    from example_inputs import write_inputs
    faults = count = 0
    with tempfile.TemporaryDirectory(prefix="scantet_python_") as folder:
        write_inputs(pathlib.Path(folder))
        os.chdir(folder)
        for page in pages_of(root):
            session = {"__name__": "example"}
            for block in blocks_of(root, page):
                if block.kind != "python" or block.host():  # hosts have tests of their own
                    continue
                count += 1
                code = "\n" * block.line + block.text()
                try:
                    exec(compile(code, block.page, "exec"), session)  # pylint: disable=exec-used
                except Exception as error:  # pylint: disable=broad-except
                    faults += 1
                    print(f"{block.place()}: {type(error).__name__}: {error}", file=sys.stderr)
    print(f"{count} blocks of Python, with scantet {scantet.__version__}")
    return 1 if faults or count == 0 else 0


if __name__ == "__main__":
    warnings.simplefilter("default")
    sys.exit(main(sys.argv[1]))
