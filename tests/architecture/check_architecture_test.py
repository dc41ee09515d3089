"""Shows each check a small tree that is right, then one fault at a time."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
import check_architecture as checker  # noqa: E402

GOOD = {
    "src/scantet/base/CMakeLists.txt": "scantet_module(base SOURCES point.cpp)\n",
    "src/scantet/base/point.h": "#include <vector>\n\nnamespace SCANTET_API scantet {}\n",
    "src/scantet/base/point.cpp": '#include "scantet/base/point.h"\n',
    "src/scantet/refine/CMakeLists.txt": "scantet_module(refine SOURCES mesher.cpp NEEDS base PRIVATE CGAL::CGAL)\n",
    "src/scantet/refine/mesher.h": '#include "scantet/base/point.h"\n\nnamespace SCANTET_API scantet {}\n',
    "src/scantet/refine/mesher_impl.h": "#include <CGAL/Delaunay.h>\n",
    "src/scantet/refine/mesher.cpp": '#include "scantet/refine/mesher_impl.h"\n',
    "tests/unit/refine/CMakeLists.txt": "scantet_test(test_refine\n  SOURCES mesher_test.cpp\n  NEEDS refine)\n",
    "src/scantet/image/CMakeLists.txt": "scantet_module(image SOURCES field.cpp NEEDS base)\n"
                                        "scantet_module(image_itk SOURCES reader.cpp  # ITK is here\n"
                                        "               NEEDS image PRIVATE ITK)\n",
    "src/scantet/image/field.h": '#include "scantet/base/point.h"\n\nnamespace SCANTET_API scantet {}\n',
    "src/scantet/image/field.cpp": '#include "scantet/image/field.h"\n',
    "src/scantet/image/reader.h": '#include "scantet/image/field.h"\n',
    "src/scantet/image/reader.cpp": "#include <itkImage.h>\n",
    "src/scantet/cli/CMakeLists.txt": "add_executable(scantet main.cpp)\n",
    "docs/architecture.md": "For users: `refine/mesher.h`, `adapters/from_itk.h`.\n\ngraph TD\n  refine --> base\n  image_itk --> image\n  image --> base\n\n"
                            "| `base` | points | – | – |\n| `refine` | rules | base | CGAL |\n"
                            "| `image` | fields | base | – |\n| `image_itk` | files | image | ITK |\n",
    "cmake/PublicHeaders.cmake": "# for users\nset(scantet_user_headers refine/mesher.h base/point.h)\n"
                                 "set(scantet_plugin_headers image/field.h)  # for plugins\n"
                                 "set(scantet_adapter_headers adapters/from_itk.h)\n",
    "src/scantet/adapters/from_itk.h": '#include <itkImage.h>\n\n#include "scantet/image/field.h"\n',
    "src/scantet/scantet.h": '#include "scantet/base/point.h"\n#include "scantet/refine/mesher.h"\n',
    "plugins/vdb/plugin.cpp": '#include <openvdb/openvdb.h>\n\n#include "scantet/image/field.h"\n',
    "src/scantet/cli/main.cpp": '#include "scantet/refine/mesher.h"\n',
}


class CheckerTest(unittest.TestCase):
    def faults(self, check, changes=None, **options):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for name, text in {**GOOD, **(changes or {})}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            return list(checker.CHECKS[check](root, **options))

    def assert_one_fault(self, faults, *words):
        self.assertEqual(len(faults), 1, faults)
        for word in words:
            self.assertIn(word, faults[0])

    def test_good_tree_has_no_faults(self):
        for check in ("arrows", "page", "core", "headers", "face", "tests", "sizes"):
            self.assertEqual(self.faults(check), [], check)

    def test_undeclared_arrow(self):
        changes = {"src/scantet/base/point.cpp": '\n#include "scantet/image/field.h"\n'}
        self.assert_one_fault(self.faults("arrows", changes), "base/point.cpp:2", "module image;")

    def test_arrow_between_modules_of_one_folder(self):
        changes = {"src/scantet/image/field.cpp": '#include "scantet/image/reader.h"\n'}
        self.assert_one_fault(self.faults("arrows", changes), "image/field.cpp:1", "module image_itk;")

    def test_module_includes_a_program(self):
        changes = {"src/scantet/base/point.cpp": '#include "scantet/cli/help.h"\n'}
        self.assert_one_fault(self.faults("arrows", changes), "base/point.cpp:1", "in no module")

    def test_unused_and_unknown_needs(self):
        changes = {"src/scantet/base/CMakeLists.txt": "scantet_module(base SOURCES point.cpp NEEDS geometry)"}
        self.assert_one_fault(self.faults("arrows", changes), "geometry, which is no module")
        changes = {"src/scantet/image/field.h": ""}
        self.assert_one_fault(self.faults("arrows", changes), "includes nothing of it")

    def test_circle(self):
        changes = {"src/scantet/base/CMakeLists.txt": "scantet_module(base SOURCES point.cpp NEEDS image)",
                   "src/scantet/base/point.cpp": '#include "scantet/image/field.h"\n'}
        faults = self.faults("arrows", changes)
        self.assertEqual(len(faults), 2, faults)
        self.assertTrue(all("needs itself" in fault for fault in faults), faults)

    def test_page_and_code_differ(self):
        page = GOOD["docs/architecture.md"]
        changes = {"docs/architecture.md": page.replace("  image --> base\n", "")}
        self.assert_one_fault(self.faults("page", changes), "the diagram lacks image --> base")
        changes = {"docs/architecture.md": page.replace("image_itk --> image", "image_itk --> image & base")}
        self.assert_one_fault(self.faults("page", changes), "has image_itk --> base")
        changes = {"docs/architecture.md": page.replace("| rules | base |", "| rules | base, image |")}
        self.assert_one_fault(self.faults("page", changes), "row of refine")

    def test_refine_names_an_image_library(self):
        changes = {"src/scantet/refine/mesher.cpp": "\nvtkPoints* points;\n"}
        self.assert_one_fault(self.faults("core", changes), "mesher.cpp:2", "vtk")
        changes = {"src/scantet/refine/CMakeLists.txt": "find_package(ITK)\n"}
        self.assert_one_fault(self.faults("core", changes), "CMakeLists.txt:1", "ITK")

    def test_public_header(self):
        header = "src/scantet/base/point.h"
        self.assert_one_fault(self.faults("headers", {header: "#include <CGAL/Point_3.h>\n"}), "point.h:1", "CGAL")
        self.assert_one_fault(self.faults("headers", {header: "#include <vtkPoints.h>\n"}), "vtkPoints.h")
        self.assert_one_fault(self.faults("headers", {header: '#include "vec.h"\n'}), "the path from src/")
        changes = {header: '#include "scantet/refine/mesher_impl.h"\n'}
        self.assert_one_fault(self.faults("headers", changes), "may show third parties")

    def test_face(self):
        user = "src/scantet/base/point.h"
        reader = '#include "scantet/image/reader.h"\n'
        shown = "namespace SCANTET_API scantet {}\n"
        self.assert_one_fault(self.faults("face", {user: reader + shown}), "point.h:1", "image/reader.h, which is not public")
        self.assert_one_fault(self.faults("face", {"plugins/vdb/plugin.cpp": reader}), "plugin.cpp:1", "not public")
        self.assert_one_fault(self.faults("face", {"examples/own_domain.cpp": reader}), "own_domain.cpp:1", "not public")
        self.assert_one_fault(self.faults("face", {user: "#include <CGAL/Point_3.h>\n" + shown}), "point.h:1", "CGAL")
        self.assert_one_fault(self.faults("face", {user: "namespace scantet {}\n"}), "point.h: a public header has no")
        self.assert_one_fault(self.faults("face", {"src/scantet/image/reader.h": shown}), "reader.h: shows", "not public")
        changes = {user: '#include "scantet/adapters/from_itk.h"\n' + shown}
        self.assert_one_fault(self.faults("face", changes), "point.h:1", "to all who include this")
        lists = GOOD["cmake/PublicHeaders.cmake"]
        changes = {"cmake/PublicHeaders.cmake": lists.replace("image/field.h", "image/field.h image/fields.h")}
        self.assert_one_fault(self.faults("face", changes), "image/fields.h is listed")
        changes = {"cmake/PublicHeaders.cmake": lists.replace(" base/point.h", "").replace("image/", "base/point.h image/")}
        self.assert_one_fault(self.faults("face", changes), "scantet.h: includes scantet/base/point.h")
        page = GOOD["docs/architecture.md"]
        changes = {"docs/architecture.md": page.replace("`refine/mesher.h`, ", "")}
        self.assert_one_fault(self.faults("face", changes), "does not say what scantet/refine/mesher.h is public for")
        changes = {"src/scantet/scantet.h": '#include "scantet/refine/mesher.h"\n'}
        self.assert_one_fault(self.faults("face", changes), "scantet.h: lacks scantet/base/point.h")

    def test_algorithm_without_a_test(self):
        changes = {"src/scantet/refine/rules.cpp": ""}
        self.assert_one_fault(self.faults("tests", changes), "refine/rules.cpp", "tests/unit/refine/rules_test.cpp")
        changes["tests/unit/refine/CMakeLists.txt"] = "scantet_test(test_refine SOURCES mesher_test.cpp rules_test.cpp\n)\n"
        self.assertEqual(self.faults("tests", changes), [])
        changes = {"src/scantet/topology/joins.cpp": "", "src/scantet/image/other.cpp": ""}
        self.assert_one_fault(self.faults("tests", changes), "topology/joins.cpp")

    def test_sizes(self):
        long_header = "// a comment\n" * 201
        changes = {"src/scantet/base/point.h": long_header}
        self.assert_one_fault(self.faults("sizes", changes), "point.h: 201 lines, limit 200")
        changes = {"tests/unit/point_test.cpp": "// a comment\n" * 401}
        self.assert_one_fault(self.faults("sizes", changes), "point_test.cpp: 401 lines, limit 400")
        changes = {"src/scantet/base/point.h": "// Long; reason: a table.\n" + long_header}
        self.assertEqual(self.faults("sizes", changes), [])
        changes = {"scripts/tidy.py": "# a comment\n" * 401}
        self.assert_one_fault(self.faults("sizes", changes), "tidy.py: 401 lines, limit 400")

    def test_sizes_of_functions(self):
        def source(lines, head="int Point::sum(int more) const", before=""):
            return f"namespace scantet {{\n{before}\n{head} {{\n" + "  ++more;\n" * (lines - 2) + "}\n\n}  // namespace scantet\n"
        name = "src/scantet/base/point.cpp"
        self.assertEqual(self.faults("sizes", {name: source(60)}), [])
        self.assert_one_fault(self.faults("sizes", {name: source(61)}), "point.cpp:3: a function of 61 lines, limit 60")
        self.assert_one_fault(self.faults("sizes", {name: source(61, "Point::Point(int more) : x_{more}, y_(more)")}), "of 61 lines")
        self.assert_one_fault(self.faults("sizes", {name: source(61, "TEST(Point, Sum)", "const char kBrace[] = \"}{\";")}), "of 61 lines")
        in_class = "struct Point {\n public:\n" + source(61, "int sum(int more)") + "};\n"
        self.assert_one_fault(self.faults("sizes", {name: in_class}), "of 61 lines")
        table = "const int kTable[] = {\n" + "  at(1),\n" * 100 + "};\n"
        self.assertEqual(self.faults("sizes", {name: table + "struct Values {\n" + "  int x{};\n" * 100 + "};\n"}), [])
        self.assertEqual(self.faults("sizes", {name: "// reason: a table of cases\n" + source(61)}), [])

    def test_format(self):
        style = {".clang-format": "BasedOnStyle: Google\n"}
        self.assertEqual(self.faults("format", style, program=FORMATTER), [])
        changes = {**style, "src/scantet/base/point.h": "int  x ;\n"}
        self.assert_one_fault(self.faults("format", changes, program=FORMATTER), "point.h: not formatted")
        self.assert_one_fault(self.faults("format", style, program="no-such-program"), "install clang-format")


if __name__ == "__main__":
    FORMATTER = sys.argv.pop() if len(sys.argv) > 1 else "clang-format"
    unittest.main()
