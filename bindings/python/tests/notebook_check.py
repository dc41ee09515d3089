"""A notebook without a display: scantet in IPython's kernel, by nbclient. notebook_check.py SCAN; PYTHONPATH has the package.

A mesh shows its table and histograms, mesh.page() the page, and interrupting the kernel ends a run with KeyboardInterrupt."""
import asyncio
import sys
import threading
import time

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError

MESHES = f"""\
import scantet
mesh = scantet.mesh({sys.argv[1]!r}, level=127.5, size=3)
mesh"""
LONG = f"scantet.mesh({sys.argv[1]!r}, level=127.5, size=0.15, max_vertices=100000000)"


def shown(cell):
    """What a cell shows as HTML, once."""
    (output,) = [each for each in cell.outputs if each.output_type == "execute_result"]
    return output.data["text/html"]


def main():
    book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(text) for text in (MESHES, "mesh.page()", LONG, "1 + 1")])
    client = NotebookClient(book, timeout=120, kernel_name="python3")
    with client.setup_kernel():
        client.execute_cell(book.cells[0], 0)
        html = shown(book.cells[0])
        assert "<table" in html and "<svg" in html, html[:500]
        client.execute_cell(book.cells[1], 1)
        assert shown(book.cells[1]).startswith("<iframe srcdoc="), shown(book.cells[1])[:200]
        threading.Timer(3, lambda: asyncio.run(client.km.interrupt_kernel())).start()
        begin = time.monotonic()
        try:
            client.execute_cell(book.cells[2], 2)
        except CellExecutionError as error:
            assert error.ename == "KeyboardInterrupt", error
        else:
            raise AssertionError("the run ended before it was interrupted")
        seconds = time.monotonic() - begin
        assert seconds < 60, seconds
        client.execute_cell(book.cells[3], 3)  # the kernel goes on
        assert book.cells[3].outputs[0].data["text/plain"] == "2"
    print(f"a notebook shows a mesh and its page; interrupted after 3 s, it ended after {seconds:.1f} s")


if __name__ == "__main__":
    main()
