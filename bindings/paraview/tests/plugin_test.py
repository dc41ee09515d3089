"""The plugin in ParaView's own Python: pvpython plugin_test.py SCANTET PLUGIN ROOT

ROOT: a folder with README.md, docs/vtk.md and tests/docs as the source tree has them."""
import inspect
import io
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import time

program, plugin, root = sys.argv[1:4]
if not hasattr(inspect, "getargspec"):  # Debian's ParaView 5.11 with its Python 3.11 (docs/vtk.md)
    inspect.getargspec = inspect.getfullargspec

import numpy as np
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader

sys.path.insert(0, os.path.join(root, "tests", "docs"))
from blocks import blocks_of
from example_inputs import write_inputs

LoadPlugin(plugin, ns=globals())
folder = tempfile.mkdtemp()


def clean_environment():
    return {key: value for key, value in os.environ.items() if key != "LD_LIBRARY_PATH"}


def scantet(*words):
    subprocess.run([program, *words], check=True, env=clean_environment(), stdout=subprocess.DEVNULL)


def arrays_of(grid):
    data = grid.GetCellData()
    arrays = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
    return vtk_to_numpy(grid.GetPoints().GetData()), vtk_to_numpy(grid.GetCells().GetConnectivityArray()), arrays


def read(path):
    reader = vtkUnstructuredGridReader()
    reader.SetFileName(path)
    reader.ReadAllScalarsOn()
    reader.Update()
    return reader.GetOutput()


def same(ours, theirs):
    for a, b in zip(arrays_of(ours)[:2], arrays_of(theirs)[:2]):
        assert np.array_equal(a, b)
    ours, theirs = arrays_of(ours)[2], arrays_of(theirs)[2]
    assert ours.keys() == theirs.keys(), (ours.keys(), theirs.keys())
    for name, values in theirs.items():
        assert np.array_equal(ours[name], values), name
    return len(theirs["region"])


def ball(is_turned):
    """An image whose extent does not begin at 0, on turned axes."""
    source = ProgrammableSource(OutputDataSetType="vtkImageData")
    source.ScriptRequestInformation = """
from paraview import util
util.SetOutputWholeExtent(self, (3, 23, -4, 16, 0, 20))
"""
    source.Script = f"""
import math
from vtkmodules.vtkCommonCore import vtkFloatArray
image = self.GetImageDataOutput() if hasattr(self, "GetImageDataOutput") else output.VTKObject
image.SetExtent(3, 23, -4, 16, 0, 20)
image.SetOrigin(-7, 80, 9)
image.SetSpacing(1, 1.25, 0.75)
if {is_turned}:
    c = math.sqrt(0.75)
    image.SetDirectionMatrix(c, -0.5, 0, 0.5, c, 0, 0, 0, -1)
heights = vtkFloatArray()
heights.SetName("height")
for k in range(21):
    for j in range(21):
        for i in range(21):
            heights.InsertNextValue(8 - math.sqrt((i - 10) ** 2 + (j - 10) ** 2 + (k - 10) ** 2))
image.GetPointData().SetScalars(heights)
"""
    return source


def nrrd_of(source, space, path):
    image = servermanager.Fetch(source)
    matrix, steps = image.GetDirectionMatrix(), image.GetSpacing()
    directions = " ".join("(" + ",".join(repr(matrix.GetElement(row, axis) * steps[axis]) for row in range(3)) + ")"
                          for axis in range(3))
    origin = ",".join(repr(x) for x in image.GetPoint(0))
    with open(path, "wb") as file:
        file.write(f"NRRD0004\ntype: float\ndimension: 3\nspace: {space}\nsizes: 21 21 21\nspace directions: {directions}\n"
                   f"space origin: ({origin})\nencoding: raw\nendian: little\n\n".encode())
        file.write(vtk_to_numpy(image.GetPointData().GetArray("height")).tobytes())


def test_same_mesh_as_the_command():
    for axes, space in (("LPS", "left-posterior-superior"), ("RAS", "right-anterior-superior")):
        source = ball(is_turned=True)
        scan, mesh = os.path.join(folder, axes + ".nrrd"), os.path.join(folder, axes + ".vtk")
        nrrd_of(source, space, scan)
        scantet("mesh", scan, "--level", "0.5", "--size", "3", "--min-dihedral", "12", "--set", "top=z < 5", "--set",
                "low=z > 3", "--quality-fields", "--space", axes.lower(), "--quiet", "-o", mesh)
        mesher = ScantetMesher(Input=source, level=[0.5], size="3", min_dihedral="12", axes=axes,
                               set=["top=z < 5", "low=z > 3"])
        tets = same(servermanager.Fetch(mesher), read(mesh))
        print(f"{axes}: {tets} tets, as by the command")


def faces_of(ids):
    """Sorted corners of triangles, one row each, rows sorted."""
    rows = np.sort(ids, axis=1)
    return rows[np.lexsort(rows.T[::-1])]


def check_boundary(boundary, grid, axes):
    """The facets are the faces where regions change; each is in its patch, and in the sets whose places its centre is in."""
    facets = vtk_to_numpy(boundary.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    data = {name: vtk_to_numpy(boundary.GetCellData().GetArray(name)) for name in ("patch", "regions", "set_top", "set_low")}
    points = vtk_to_numpy(grid.GetPoints().GetData())
    assert np.array_equal(vtk_to_numpy(boundary.GetPoints().GetData()), points)
    tets = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    regions = vtk_to_numpy(grid.GetCellData().GetArray("region"))
    faces = np.sort(np.concatenate([np.delete(tets, i, axis=1) for i in range(4)]), axis=1)
    of_faces, at, count = np.unique(faces, axis=0, return_inverse=True, return_counts=True)
    sums, squares = (np.bincount(at, weights=np.tile(power, 4)) for power in (regions, regions.astype(float) ** 2))
    differ = (count == 1) | (squares * 2 != sums ** 2)  # one tet, or two of two regions
    assert np.array_equal(faces_of(facets), faces_of(of_faces[differ]))
    names = boundary.GetFieldData().GetAbstractArray("patch_names")
    names = [names.GetValue(i) for i in range(names.GetNumberOfValues())]
    assert set(names) == {"boundary_1_0", "clamp"} and set(data["patch"]) == {0, 1}, names
    assert np.array_equal(data["regions"], np.tile([1, 0], (len(facets), 1)))
    z = points[facets][:, :, 2]
    cut = data["patch"] == names.index("clamp")
    assert np.ptp(z[cut]) < 1e-9 and 0 < cut.sum() < len(cut)
    assert (np.ptp(z[~cut], axis=1) > 1e-9).any()
    centres = z.mean(axis=1)
    assert np.array_equal(data["set_top"] == 1, centres < 5) and np.array_equal(data["set_low"] == 1, centres > 3)
    corners = points[facets]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    volume = np.einsum("ij,ij->", corners[:, 0], normals) / 6
    edges = points[tets[:, 1:]] - points[tets[:, :1]]
    assert abs(volume - np.linalg.det(edges).sum() / 6) < 1e-6 * volume, "the normals do not point out"
    print(f"{axes}: {len(facets)} facets, {cut.sum()} of them on the cut")


def test_boundary():
    """Its patches and sets, in either space; of a second order mesh, too."""
    for axes in ("LPS", "RAS"):
        options = {"level": [0.5], "size": "3", "axes": axes, "set": ["top=z < 5", "low=z > 3"], "cut": ["clamp: z > 1"]}
        mesher = ScantetMesher(Input=ball(is_turned=True), **options)
        grid = servermanager.Fetch(mesher)
        boundary = servermanager.Fetch(OutputPort(mesher, 1), idx=1)
        check_boundary(boundary, grid, axes)
        flat = vtk_to_numpy(boundary.GetPolys().GetConnectivityArray())
        mesher = ScantetMesher(Input=ball(is_turned=True), order="2", **options)
        curved = servermanager.Fetch(OutputPort(mesher, 1), idx=1)
        assert np.array_equal(vtk_to_numpy(curved.GetPolys().GetConnectivityArray()), flat)
    plain = ScantetMesher(Input=ball(is_turned=False), level=[0.5, 4], size="3")
    boundary = servermanager.Fetch(OutputPort(plain, 1), idx=1)
    pairs = vtk_to_numpy(boundary.GetCellData().GetArray("regions"))
    patch = vtk_to_numpy(boundary.GetCellData().GetArray("patch"))
    names = boundary.GetFieldData().GetAbstractArray("patch_names")
    assert names.GetNumberOfValues() == 2
    for p in range(2):
        (pair,) = {tuple(pair) for pair in pairs[patch == p]}
        assert names.GetValue(p) == "boundary_%d_%d" % pair, (names.GetValue(p), pair)


def test_properties_are_the_options():
    text = subprocess.run([program, "--xml"], check=True, env=clean_environment(), capture_output=True, text=True).stdout
    described = text[:text.index("<label>Results</label>")]
    options = set(re.findall(r"<longflag>(\w+)</longflag>", described))
    assert len(options) > 30
    properties = set(ScantetMesher(Input=Wavelet()).ListProperties())
    assert options <= properties, options - properties
    assert properties - options <= {"Input", "axes", "array", "ReloadPythonModule"}, properties - options
    print(f"{len(options)} properties")


def test_progress_and_abort():
    mesher = ScantetMesher(Input=Wavelet(), level=[180], size="0.7")
    algorithm = mesher.GetClientSideObject()
    shares = []
    algorithm.AddObserver(vtkCommand.ProgressEvent, lambda caller, event: shares.append(caller.GetProgress()))
    mesher.UpdatePipeline()
    assert mesher.GetDataInformation().GetNumberOfCells() > 1000
    assert len(shares) > 2 and shares == sorted(shares), shares

    aborted = ScantetMesher(Input=Wavelet(), level=[180], size="0.2")
    algorithm = aborted.GetClientSideObject()
    begun = []

    def abort(caller, event):
        begun.append(time.monotonic())
        caller.SetAbortExecute(1)
    algorithm.AddObserver(vtkCommand.ProgressEvent, abort)
    aborted.UpdatePipeline()
    assert begun and aborted.GetDataInformation().GetNumberOfCells() == 0
    print(f"aborted after {time.monotonic() - begun[0]:.2f} s")
    assert not [name for name in os.listdir(tempfile.gettempdir()) if name.startswith("scantet-paraview-")]


def test_histogram():
    mesher = ScantetMesher(Input=ball(is_turned=False), level=[0], size="2")
    grid = servermanager.Fetch(mesher)
    values = vtk_to_numpy(grid.GetCellData().GetArray("scaled_jacobian"))
    histogram = TetQualityHistogram(Input=mesher, measure="scaled_jacobian")
    table = servermanager.Fetch(histogram, idx=0)
    counts = vtk_to_numpy(table.GetColumnByName("count"))
    edges = np.append(vtk_to_numpy(table.GetColumnByName("bin_low")), 1.0)
    assert np.array_equal(counts, np.histogram(values, edges)[0])
    statistics = servermanager.Fetch(OutputPort(histogram, 1), idx=1)
    rows = {statistics.GetValueByName(i, "measure").ToString(): i for i in range(statistics.GetNumberOfRows())}
    assert statistics.GetValueByName(rows["scaled_jacobian"], "min").ToDouble() == values.min()
    words = histogram.GetProperty("measure").Available
    assert set(words) == set(rows), set(words) ^ set(rows)
    print(f"{counts.sum()} tets counted, {len(rows)} measures")


def test_errors():
    wrong = ScantetMesher(Input=Wavelet(), level=[100000], size="3")
    said, sys.stderr = sys.stderr, io.StringIO()
    try:
        wrong.UpdatePipeline()
    finally:
        said, sys.stderr = sys.stderr, said
    assert "leaves nothing inside" in said.getvalue() and "hint: choose a level between" in said.getvalue(), said.getvalue()
    assert wrong.GetDataInformation().GetNumberOfCells() == 0


def test_pages():
    """The lines of README.md and docs/vtk.md that are for pvpython, as written. README's mesh is the command's."""
    write_inputs(pathlib.Path(folder))
    os.chdir(folder)
    for page in ("README.md", "docs/vtk.md"):
        blocks = [block for block in blocks_of(root, page) if block.kind == "python" and block.host() == "paraview"]
        assert blocks, page
        for block in blocks:
            exec(compile("\n" * block.line + block.text(), page, "exec"), {})
        print(f"{len(blocks)} block of {page}")
    scantet("mesh", "ct.nrrd", "--level", "300", "--size", "2", "--quiet", "-o", "theirs.vtk")
    scantet("diff", "bone.vtk", "theirs.vtk")


for name, test in list(globals().items()):
    if name.startswith("test_"):
        print(name, flush=True)
        test()
print("passed")
