/// A filter of VTK's that measures tets.
#ifndef vtkTetQualityHistogram_h
#define vtkTetQualityHistogram_h

#include <vtkTableAlgorithm.h>

#include <string>

#include "vtkScantetModule.h"

/// Tets in, their quality as tables out: what `scantet report` says of a mesh, with the same bins and numbers.
///
/// Input: vtkUnstructuredGrid. Tets are measured, those of second order by their corners; other cells are not.
/// Output 0: the histogram of one measure, columns `bin_low`, `bin_high` (doubles) and `count` (64-bit integer), a row
/// a bin. Output 1: a row a measure, columns `measure` (text), `count`, `infinite` (integers), `min`, `max`, `mean`,
/// `p1`, `p5`, `p25`, `p50`, `p75`, `p95`, `p99` (doubles). docs/reports.md says what the measures are. A grid without
/// tets, a measure that there is not, or a coordinate that is not finite is an error (ErrorEvent), and leaves empty
/// tables.
class VTKSCANTET_EXPORT vtkTetQualityHistogram : public vtkTableAlgorithm {
 public:
  static vtkTetQualityHistogram* New();
  vtkTypeMacro(vtkTetQualityHistogram, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Of output 0: "dihedral_deg" (the default, six a tet), "radius_edge", "inverse_aspect", "scaled_jacobian" …; those
  /// of the column `measure` of output 1.
  vtkSetMacro(Measure, std::string);
  vtkGetMacro(Measure, std::string);

  /// Output 1.
  vtkTable* GetStatistics();

 protected:
  vtkTetQualityHistogram();
  ~vtkTetQualityHistogram() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

 private:
  vtkTetQualityHistogram(const vtkTetQualityHistogram&) = delete;
  void operator=(const vtkTetQualityHistogram&) = delete;

  std::string Measure = "dihedral_deg";
};

#endif
