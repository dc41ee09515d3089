"""That the checker of examples finds what is wrong with a page."""
import pathlib
import tempfile
import unittest

from blocks import blocks_of


def blocks_in(text):
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "page.md").write_text(text)
        return blocks_of(folder, "page.md")


class Blocks(unittest.TestCase):
    def test_kind_place_and_content(self):
        blocks = blocks_in("# Page\n\n```sh\nscantet info a\n```\n\n```\nplain\n\n    indented\n```\n")
        self.assertEqual([(b.kind, b.place(1), b.text()) for b in blocks],
                         [("sh", "page.md:4", "scantet info a\n"), ("", "page.md:8", "plain\n\n    indented\n")])

    def test_indented_blocks_are_refused(self):
        with self.assertRaisesRegex(ValueError, "page.md:3: a block without a fence"):
            blocks_in("Text\n\n    scantet info a\n")

    def test_lists_may_be_indented(self):
        self.assertEqual(blocks_in("- item\n    goes on\n"), [])

    def test_hosts_are_told_by_what_they_import(self):
        text = "".join(f"```{kind}\n{line}\n```\n" for kind, line in (
            ("python", "import scantet"), ("python", "from paraview.simple import *"), ("python", "from vtkscantet.vtkScantet import a"),
            ("python", "slicer.util.a()"), ("cpp", "#include <itkImage.h>"), ("cpp", "#include <vtkNew.h>")))
        self.assertEqual([block.host() for block in blocks_in(text)], ["", "paraview", "vtk", "slicer", "itk", ""])

    def test_a_fence_must_end(self):
        with self.assertRaisesRegex(ValueError, "page.md:1: the fence has no end"):
            blocks_in("```sh\nscantet info a\n")


if __name__ == "__main__":
    unittest.main()
