"""The plugin in ParaView's own Python: pvpython plugin_test.py SCANTET PLUGIN PAGE"""
import inspect
import io
import os
import re
import subprocess
import sys
import tempfile
import threading
import time

program, plugin, page = sys.argv[1:4]
if not hasattr(inspect, "getargspec"):  # Debian's ParaView 5.11 with its Python 3.11 (docs/vtk.md)
    inspect.getargspec = inspect.getfullargspec

import numpy as np
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader

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


def test_page():
    """The lines of docs/vtk.md that are for pvpython, as written."""
    blocks = re.findall(r"```python\n(.*?)```", open(page, encoding="utf-8").read(), re.DOTALL)
    blocks = [block for block in blocks if "paraview.simple" in block]
    assert blocks
    for block in blocks:
        exec(compile(block, page, "exec"), {})
    print(f"{len(blocks)} block of {os.path.basename(page)}")


for name, test in list(globals().items()):
    if name.startswith("test_"):
        print(name, flush=True)
        test()
print("passed")
