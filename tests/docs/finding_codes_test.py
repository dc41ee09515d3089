"""Shows finding_codes.py a small tree that is right, then one fault at a time."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
import finding_codes  # noqa: E402

SOURCE = """faults.add("boundary.edge", what, place);
findings.add_undecided(
    "vertex.off_level", what, place, true);
VerifyFinding finding{"mesh.second_order", what};
"""
PAGE = ("# The certificate\n\n| `mesh.other` | another table | of something |\n\n## Findings\n\n"
        "| `boundary.edge` | no surface | wrong |\n| `mesh.second_order` | ten nodes | not proved |\n"
        "| `vertex.off_level` | off | not proved |\n\n## What is not proved\n")


class FindingCodes(unittest.TestCase):
    def faults(self, source=SOURCE, page=PAGE):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for name, text in {"src/scantet/verify/shell.cpp": source, "docs/certificate.md": page}.items():
                (root / name).parent.mkdir(parents=True)
                (root / name).write_text(text, encoding="utf-8")
            return list(finding_codes.faults(root))

    def assert_one_fault(self, words, **changes):
        found = self.faults(**changes)
        self.assertEqual(len(found), 1, found)
        self.assertIn(words, found[0])

    def test_good_tree_has_no_faults(self):
        self.assertEqual(self.faults(), [])

    def test_faults(self):
        self.assert_one_fault("lacks boundary.edge", page=PAGE.replace("| `boundary.edge` | no surface | wrong |\n", ""))
        self.assert_one_fault("has vertex.off_level, which no source", source=SOURCE.replace("vertex.off_level", "mesh.second_order"))
        self.assert_one_fault("mesh.second_order lacks", page=PAGE.replace("| ten nodes |", "| |"))
        self.assert_one_fault("boundary.edge is out of order", page=PAGE.replace("`boundary.edge`", "`x.y`").replace(
            "`mesh.second_order`", "`boundary.edge`").replace("`x.y`", "`mesh.second_order`"))

    def test_findings_of_a_surface(self):
        found = self.faults(source=SOURCE + 'findings.add_undecided("surface." + end, what, place, false);\n')
        self.assertEqual(len(found), 4, found)
        self.assertIn("lacks surface.contact", found[0])


if __name__ == "__main__":
    unittest.main()
