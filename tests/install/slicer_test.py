"""The module of 3D Slicer, driven as Slicer drives one: slicer_test.py MODULE PROGRAM ROOT, of the source tree.

Slicer asks the module for its XML, then runs it with every parameter on the command line (defaults and empty texts
too), its own libraries in LD_LIBRARY_PATH, and reads progress from standard output and results from a file.
SCANTET_SLICER_SCHEMAS may name schema files, colons between, that the XML is held against as well.
"""
import gzip
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ET

MODULE, PROGRAM, ROOT = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
SAMPLES = ROOT / "sample_volumes"
sys.path.insert(0, str(ROOT / "tests" / "docs"))
from blocks import blocks_of
from example_inputs import write_inputs

# What the execution model documents: the elements of the head in their order, and of each kind of parameter.
HEAD = ["category", "title", "description", "version", "documentation-url", "license", "contributor"]
COMMON = ["name", "longflag", "description", "label", "default"]
PLACED = ["name", "index", "description", "label", "channel"]
RESULT = ["name", "index", "description", "label", "default", "channel"]
KINDS = {"boolean", "integer", "double", "string", "double-vector", "string-enumeration", "image", "geometry"}


def run(*words, status=0):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=120,
                          env={**os.environ, "LD_LIBRARY_PATH": "/nowhere"})
    assert done.returncode == status, (words, done.returncode, done.stdout, done.stderr)
    return done


def described():
    return ET.fromstring(run(MODULE, "--xml").stdout)


def parameters(root):
    for group in root.findall("parameters"):
        for parameter in group:
            if parameter.tag not in ("label", "description"):
                yield group.find("label").text, parameter


def as_slicer(values, inputs):
    """The command line: values by name, else defaults; then what has an index, in that order."""
    words = []
    for _, parameter in parameters(described()):
        if parameter.find("index") is not None:
            continue
        name = parameter.find("name").text
        value = values.get(name, parameter.find("default").text or "")
        flag = "--" + parameter.find("longflag").text
        if parameter.tag == "boolean":
            words += [flag] if value == "true" else []
        else:
            words += [flag, value]
    return words + list(inputs)


class NodeOfScene:
    """What stands for a node of Slicer's: a file."""

    def __init__(self, path):
        self.path = path


class SlicerStandIn:
    """Of Slicer's Python what README's lines call. A node is a file; the module is run with every parameter that it has, and
    is known by its file's name in small letters."""

    def __init__(self, folder):
        self.folder = folder
        self.util = self.mrmlScene = self.cli = self.modules = self
        setattr(self, pathlib.Path(MODULE).name.lower(), MODULE)

    def loadVolume(self, name):
        return NodeOfScene(self.folder / name)

    def AddNewNodeByClass(self, kind, name):
        assert kind == "vtkMRMLModelNode", kind
        return NodeOfScene(self.folder / f"of_the_scene_{name}.vtk")

    def runSync(self, module, node, given):
        places = [(parameter.find("name").text, parameter) for _, parameter in parameters(described())]
        assert set(given) <= {name for name, _ in places}, given
        files = sorted((int(parameter.find("index").text), given[name].path) for name, parameter in places
                       if parameter.tag in ("image", "geometry"))
        values = {name: str(value) for name, value in given.items() if not isinstance(value, NodeOfScene)}
        run(module, *as_slicer(values, [path for _, path in files]))

    def saveNode(self, node, name):
        (self.folder / name).write_bytes(node.path.read_bytes())


class Module(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def test_description_is_as_documented(self):
        root = described()
        self.assertEqual([child.tag for child in root if child.tag != "parameters"], HEAD)
        names = set()
        for group in root.findall("parameters"):
            self.assertEqual([child.tag for child in group][:2], ["label", "description"])
        for title, parameter in parameters(root):
            name = parameter.find("name").text
            self.assertIn(parameter.tag, KINDS)
            self.assertRegex(name, r"^[_a-zA-Z][_a-zA-Z0-9]*$")
            self.assertNotIn(name, names)
            names.add(name)
            tags = [child.tag for child in parameter]
            if title == "Results":
                self.assertEqual(tags, RESULT)
            elif parameter.tag in ("image", "geometry"):
                self.assertEqual(tags, PLACED)
            else:
                self.assertEqual(tags[:5], COMMON)
                self.assertLessEqual(set(tags[5:]), {"element", "constraints"})
            choices = [element.text for element in parameter.findall("element")]
            self.assertEqual(parameter.tag == "string-enumeration", len(choices) > 1)
            if choices:
                self.assertIn(parameter.find("default").text, choices)
            if parameter.tag in ("integer", "double"):
                float(parameter.find("default").text)
            limits = parameter.find("constraints")
            if limits is not None:
                self.assertEqual([child.tag for child in limits], ["minimum", "maximum", "step"])
                self.assertLess(float(limits.find("minimum").text), float(limits.find("maximum").text))
        channels = [(p.tag, p.find("index").text, p.find("channel").text) for _, p in parameters(root)
                    if p.tag in ("image", "geometry")]
        self.assertEqual(channels, [("image", "0", "input"), ("geometry", "1", "output")])

    def test_description_keeps_to_the_schemas(self):
        schemas = os.environ.get("SCANTET_SLICER_SCHEMAS", "")
        if not schemas:
            self.skipTest("SCANTET_SLICER_SCHEMAS names none")
        from lxml import etree
        for schema in schemas.split(":"):
            tree = etree.fromstring(run(MODULE, "--xml").stdout.encode())
            if "executable" in schema or "ModuleDescription" in schema:  # does not know of results
                for group in tree.findall("parameters"):
                    if group.find("label").text == "Results":
                        tree.remove(group)
            etree.XMLSchema(etree.parse(schema)).assertValid(tree)

    def test_every_option_of_images_is_a_parameter(self):
        names = {parameter.find("name").text for _, parameter in parameters(described())}
        page, options = run(PROGRAM, "man", "mesh").stdout.replace("\\-", "-"), set()
        of_others = False
        for line in page.splitlines():
            if line.startswith(".SS "):
                of_others = line[4:] in ("Formula", "Points", "Surface", "OpenVDB grid", "Input", "Polyhedron", "Help")
            found = re.match(r"(?:\\fB-\w\\fR, )?\\fB--([a-z-]+)\\fR", line)
            if found and not of_others:
                options.add(found.group(1).replace("-", "_"))
        missing = options - names - {"output", "space", "plan", "config", "quiet", "help", "plugin"}
        declared_by_plugins = {option for option in missing
                               if run_refuses(SAMPLES / "sphere.nrrd", option.replace("_", "-"))}
        self.assertEqual(missing - declared_by_plugins, set())
        self.assertGreater(len(names), 40)

    def mesh(self, values, scan, model):
        returned = self.folder / "returned.params"
        done = run(MODULE, "--returnparameterfile", returned, *as_slicer(values, [scan, model]))
        results = dict(line.split(" = ") for line in returned.read_text().splitlines())
        self.assertEqual(set(results), {parameter.find("name").text for title, parameter in parameters(described())
                                        if title == "Results"})
        shares = [float(x) for x in re.findall(r"<filter-progress>([0-9.e-]+)</filter-progress>", done.stdout)]
        self.assertEqual(shares, sorted(shares))
        self.assertTrue(all(0 <= share <= 1 for share in shares))
        fragments = "".join(re.findall(r"<filter-.*?</filter-(?:start|progress|end)>", done.stdout, re.DOTALL))
        report = ET.fromstring(f"<out>{fragments}</out>")
        self.assertEqual(report[0].tag, "filter-start")
        self.assertEqual(report[-1].tag, "filter-end")
        self.assertEqual(report[0].find("filter-name").text, "ScantetMesh")
        self.assertGreaterEqual(float(report[-1].find("filter-time").text), 0)
        return results

    def test_the_lines_of_the_readme_for_slicer(self):
        write_inputs(self.folder)
        blocks = [block for block in blocks_of(ROOT, "README.md") if block.kind == "python" and block.host() == "slicer"]
        self.assertEqual(len(blocks), 1)
        exec(compile(blocks[0].text(), blocks[0].place(), "exec"), {"slicer": SlicerStandIn(self.folder)})
        run(PROGRAM, "mesh", self.folder / "ct.nrrd", "--level", "300", "--size", "2", "-o", self.folder / "ours.vtk")
        run(PROGRAM, "diff", self.folder / "bone.vtk", self.folder / "ours.vtk")

    def test_a_grey_scan_is_meshed_as_by_the_program(self):
        scan = SAMPLES / "ellipsoid_oblique.nrrd"
        results = self.mesh({"level": "127.5", "size": "4"}, scan, self.folder / "model.vtk")
        run(PROGRAM, "mesh", scan, "--level", "127.5", "--size", "4", "-o", self.folder / "ours.vtu")
        run(PROGRAM, "diff", self.folder / "model.vtk", self.folder / "ours.vtu")
        head = (self.folder / "model.vtk").read_bytes()[:200]
        self.assertIn(b"SPACE=LPS", head)
        self.assertIn(b"# vtk DataFile", head)
        self.assertGreater(int(results["tets"]), 100)
        self.assertEqual(results["unmet"], "0")

    def test_results_replace_nothing_that_is_read(self):
        scan = self.folder / "scan.nrrd"
        before = (SAMPLES / "sphere.nrrd").read_bytes()
        scan.write_bytes(before)
        model = self.folder / "model.vtk"
        for returned in (scan, model):
            run(MODULE, "--returnparameterfile", returned, "--level", "127.5", "--size", "4", scan, model, status=2)
            self.assertEqual(scan.read_bytes(), before)

    def test_several_levels_are_a_vector(self):
        self.mesh({"level": "60,127.5", "size": "4"}, SAMPLES / "sphere.nrrd", self.folder / "model.vtu")
        run(PROGRAM, "mesh", SAMPLES / "sphere.nrrd", "--level", "60", "--level", "127.5", "--size", "4", "-o",
            self.folder / "ours.vtu")
        run(PROGRAM, "diff", self.folder / "model.vtu", self.folder / "ours.vtu")

    def test_a_label_map_has_its_labels_as_regions(self):
        scan = SAMPLES / "labels_octants.nrrd"
        self.mesh({"size": "4"}, scan, self.folder / "model.vtu")
        run(PROGRAM, "mesh", scan, "--size", "4", "-o", self.folder / "ours.msh")
        run(PROGRAM, "diff", self.folder / "model.vtu", self.folder / "ours.msh")
        report = run(PROGRAM, "report", self.folder / "model.vtu").stdout
        self.assertIn("region", report)

    # The same object in both spaces that a NRRD can name: the mesh is in LPS, at the same place.
    def test_ras_and_lps_scans_give_the_same_model(self):
        side, values = 12, []
        for k in range(side):
            for j in range(side):
                for i in range(side):
                    values.append(20 - ((i - 4) ** 2 + (j - 5) ** 2 + 1.5 * (k - 6) ** 2))
        for space, sign in (("left-posterior-superior", 1), ("right-anterior-superior", -1)):
            header = (f"NRRD0005\ntype: float\ndimension: 3\nspace: {space}\nsizes: {side} {side} {side}\n"
                      f"space directions: ({sign},0,0) (0,{sign},0) (0,0,1)\nspace origin: ({sign * 100},{sign * 50},7)\n"
                      "endian: little\nencoding: gzip\n\n")
            data = gzip.compress(struct.pack(f"<{len(values)}f", *values))
            (self.folder / f"{space}.nrrd").write_bytes(header.encode() + data)
            self.mesh({"level": "0", "size": "2"}, self.folder / f"{space}.nrrd", self.folder / f"{space}.vtk")
        run(PROGRAM, "diff", self.folder / "left-posterior-superior.vtk", self.folder / "right-anterior-superior.vtk")
        run(PROGRAM, "convert", self.folder / "left-posterior-superior.vtk", self.folder / "a.mesh")
        lines = (self.folder / "a.mesh").read_text().split("Vertices\n")[1].splitlines()
        points = [[float(x) for x in line.split()[:3]] for line in lines[1:1 + int(lines[0])]]
        middle = [sum(p[axis] for p in points) / len(points) for axis in range(3)]
        for at, expected in zip(middle, (104, 55, 13)):
            self.assertAlmostEqual(at, expected, delta=0.5)

    def test_what_goes_wrong_is_said_and_a_missed_bound_is_no_failure(self):
        done = run(MODULE, SAMPLES / "sphere.nrrd", self.folder / "a.vtk", status=2)
        self.assertIn("--level is missing", done.stderr)
        run(MODULE, "/nowhere.nrrd", self.folder / "a.vtk", "--level", "1", status=3)
        run(MODULE, SAMPLES / "sphere.nrrd", self.folder / "a.vtk", "--level", "1", "--space", "ras", status=2)
        run(PROGRAM, "mesh", SAMPLES / "sphere.nrrd", "--level", "127.5", "--size", "4", "--max-vertices", "120", status=4)
        results = self.mesh({"level": "127.5", "size": "4", "max_vertices": "120"}, SAMPLES / "sphere.nrrd",
                            self.folder / "a.vtk")
        self.assertNotEqual(results["unmet"], "0")
        run(MODULE, "--processinformationaddress", "0x7f00", "--echo", "--level", "127.5", SAMPLES / "sphere.nrrd",
            self.folder / "b.vtk")


def run_refuses(scan, option):
    """Whether an option of the program is none of images."""
    done = subprocess.run([PROGRAM, "info", str(scan), f"--{option}", "1"], capture_output=True, text=True, timeout=60)
    return "option of other inputs" in done.stderr


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
