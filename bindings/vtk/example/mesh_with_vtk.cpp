#include <vtkNew.h>
#include <vtkRTAnalyticSource.h>
#include <vtkScantetMesher.h>
#include <vtkXMLUnstructuredGridWriter.h>

int main() {
  vtkNew<vtkRTAnalyticSource> image;  // or a reader of VTK's
  vtkNew<vtkScantetMesher> mesher;
  mesher->SetInputConnection(image->GetOutputPort());
  mesher->SetLevel(180);
  mesher->SetSize(2);
  mesher->SetOption("min-dihedral", "12");
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputConnection(mesher->GetOutputPort());
  writer->SetFileName("wavelet.vtu");
  return writer->Write() == 1 ? 0 : 1;
}
