"""Shows error_codes.py a small tree that is right, then one fault at a time."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
import error_codes  # noqa: E402

GOOD = {
    "src/scantet/base/point.cpp": 'throw Error(Fault::input, "input.nan", what);\n'
                                  'throw Error(Fault::internal, "internal.fork", what);\n',
    "bindings/python/scantet/_images.py": 'raise UsageError("affine: none", "usage.affine", "")\n',
    "bindings/python/tests/images_test.py": 'assert caught.value.code == "usage.affine"\n',
    "tests/unit/base/point_test.cpp": 'EXPECT_EQ(error.code(), "input.nan");\n',
    "docs/errors.md": "| code | wrong | do |\n| --- | --- | --- |\n| `usage.affine` | none | give it |\n\n"
                      "| `input.nan` | not finite | replace it |\n\n| `internal.fork` | no child | report it |\n",
}


class ErrorCodes(unittest.TestCase):
    def faults(self, changes=None):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for name, text in {**GOOD, **(changes or {})}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            return list(error_codes.faults(root))

    def assert_one_fault(self, changes, *words):
        found = self.faults(changes)
        self.assertEqual(len(found), 1, found)
        for word in words:
            self.assertIn(word, found[0])

    def test_good_tree_has_no_faults(self):
        self.assertEqual(self.faults(), [])

    def test_page(self):
        page = GOOD["docs/errors.md"]
        self.assert_one_fault({"docs/errors.md": page.replace("| `input.nan` | not finite | replace it |\n", "")}, "lacks input.nan")
        self.assert_one_fault({"docs/errors.md": page + "| `output.full` | full | free some |\n"}, "has output.full, which no source has")
        self.assert_one_fault({"docs/errors.md": page.replace("| replace it |", "| |")}, "input.nan lacks its meaning or its remedy")
        self.assert_one_fault({"docs/errors.md": page + "| `internal.fork` | no child | report it |\n"}, "internal.fork twice")

    def test_order(self):
        changes = {"src/scantet/base/frame.cpp": 'throw Error(Fault::input, "input.frame", what);\n',
                   "tests/unit/base/frame_test.cpp": "// input.frame\n",
                   "docs/errors.md": GOOD["docs/errors.md"].replace("replace it |\n", "replace it |\n| `input.frame` | flat | correct it |\n")}
        self.assert_one_fault(changes, "input.frame is out of order, after input.nan")

    def test_code_without_a_test(self):
        self.assert_one_fault({"tests/unit/base/point_test.cpp": ""}, "point.cpp: input.nan has no test")
        self.assert_one_fault({"bindings/python/tests/images_test.py": ""}, "usage.affine has no test")

    def test_other_first_words(self):
        thrown = {"src/scantet/base/mesh.cpp": 'throw Error(Fault::internal,\n            "mesh.facet", what);\n'
                                               'add("mesh.regions", what);  // a finding\n'}
        row = {"docs/errors.md": GOOD["docs/errors.md"] + "\n| `mesh.facet` | no face | rebuild it |\n"}
        test = {"tests/unit/base/mesh_test.cpp": 'EXPECT_EQ(error.code(), "mesh.facet");\n'}
        self.assertEqual(self.faults({**thrown, **row, **test}), [])
        self.assert_one_fault({**thrown, **test}, "lacks mesh.facet")
        self.assert_one_fault({**row}, "has mesh.facet, which no source has")
        self.assert_one_fault({**thrown, **row, "tests/unit/base/mesh_test.cpp": "mesh.facet = 1;\n"}, "mesh.facet has no test")


if __name__ == "__main__":
    unittest.main()
