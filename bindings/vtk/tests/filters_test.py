"""The filters from Python: filters_test.py ROOT PROGRAM. README's and docs/vtk.md's lines for VTK in Python are run as written,
and README's mesh is the program's."""
import os
import pathlib
import subprocess
import sys
import tempfile

from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from vtkscantet.vtkScantet import vtkScantetMesher, vtkTetQualityHistogram

shares = []


def make_mesher():
    source = vtkRTAnalyticSource()
    mesher = vtkScantetMesher()
    mesher.SetInputConnection(source.GetOutputPort())
    mesher.SetLevel(180)
    mesher.SetSize(3)
    return mesher


mesher = make_mesher()
mesher.AddObserver("ProgressEvent", lambda filter, event: shares.append(filter.GetProgress()))
histogram = vtkTetQualityHistogram()
histogram.SetInputConnection(mesher.GetOutputPort())
histogram.SetMeasure("dihedral_deg")
histogram.Update()
assert mesher.GetOutput().GetNumberOfCells() > 100, mesher.GetErrorText()
assert mesher.GetOutput().GetCellData().GetArray("min_dihedral_deg").GetRange()[0] >= 10
assert mesher.GetBoundary().GetNumberOfCells() > 100
assert histogram.GetOutput().GetNumberOfRows() == 36
assert shares == sorted(shares) and shares[-1] == 1, shares

names = [vtkScantetMesher.GetOptionName(i) for i in range(vtkScantetMesher.GetNumberOfOptions())]
assert "min-dihedral" in names and "level" in names

aborted = make_mesher()
aborted.SetSize(0.5)
aborted.AddObserver("ProgressEvent", lambda filter, event: filter.SetAbortExecute(1))
aborted.Update()
assert aborted.GetOutput().GetNumberOfCells() == 0

wrong = make_mesher()
wrong.SetInputDataObject(vtkImageData())
said = []
wrong.AddObserver("ErrorEvent", lambda filter, event: said.append(filter.GetErrorText()))
wrong.Update()
assert said and said[0].startswith("input.pixel_type"), said

root, program = pathlib.Path(sys.argv[1]), sys.argv[2]
sys.path.insert(0, str(root / "tests" / "docs"))
from blocks import blocks_of
from example_inputs import write_inputs


def run_page(page):
    """Return: what is left of its last block."""
    session = None
    for block in blocks_of(root, page):
        if block.kind == "python" and block.host() == "vtk":
            session = {}
            exec(compile("\n" * block.line + block.text(), page, "exec"), session)
    assert session is not None, page
    return session


assert run_page("docs/vtk.md")["histogram"].GetOutput().GetNumberOfRows() > 0
with tempfile.TemporaryDirectory(prefix="scantet_vtk_") as folder:
    write_inputs(pathlib.Path(folder))
    os.chdir(folder)
    mesher = run_page("README.md")["mesher"]
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputConnection(mesher.GetOutputPort())
    writer.SetFileName("ours.vtu")
    assert writer.Write() == 1
    subprocess.run([program, "mesh", "ct.nrrd", "--level", "300", "--size", "2", "--quality-fields", "--quiet", "-o",
                    "theirs.vtu"], check=True)
    subprocess.run([program, "diff", "ours.vtu", "theirs.vtu"], check=True)
print("passed")
