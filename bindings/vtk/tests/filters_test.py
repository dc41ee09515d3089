"""The filters from Python: filters_test.py PAGE, docs/vtk.md, whose lines for Python are run as written."""
import re
import sys

from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource

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
blocks = re.findall(r"```python\n(.*?)```", open(sys.argv[1], encoding="utf-8").read(), re.DOTALL)
blocks = [block for block in blocks if "vtkscantet" in block]
assert blocks
for block in blocks:
    session = {}
    exec(compile(block, sys.argv[1], "exec"), session)
    assert session["histogram"].GetOutput().GetNumberOfRows() > 0
print("passed")
