// The measures beside VTK's own, and their histograms.
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkMeshQuality.h>
#include <vtkTable.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>

#include "support.h"
#include "vtkTetQualityHistogram.h"

namespace {

// docs/vtk.md, Definitions.
TEST(TetQuality, IsThatOfVtk) {
  const auto mesher = make_mesher(make_ball(), 0.5, 2);
  mesher->Update();
  vtkUnstructuredGrid& grid = *mesher->GetOutput();
  const auto compare = [&](const char* ours, void (vtkMeshQuality::*choose)(), double (*as_theirs)(double),
                           double share) {
    vtkNew<vtkMeshQuality> quality;
    quality->SetInputData(&grid);
    (quality.Get()->*choose)();
    quality->Update();
    vtkDataArray* const theirs = quality->GetOutput()->GetCellData()->GetArray("Quality");
    vtkDataArray* const values = grid.GetCellData()->GetArray(ours);
    for (vtkIdType t = 0; t < grid.GetNumberOfCells(); ++t) {
      ASSERT_NEAR(as_theirs(values->GetTuple1(t)) / theirs->GetTuple1(t), 1, share) << ours << " of " << t;
    }
  };
  const auto same = [](double value) { return value; };
  compare("scaled_jacobian", &vtkMeshQuality::SetTetQualityMeasureToScaledJacobian, same, 1e-12);
  compare("volume_mm3", &vtkMeshQuality::SetTetQualityMeasureToVolume, same, 1e-10);
  compare(
      "inverse_aspect", &vtkMeshQuality::SetTetQualityMeasureToRadiusRatio, [](double q) { return 1 / (3 * q); },
      1e-10);
}

TEST(TetQualityHistogram, CountsWhatTheArraysHold) {
  const auto mesher = make_mesher(make_ball(), 0.5, 2);
  vtkNew<vtkTetQualityHistogram> filter;
  filter->SetInputConnection(mesher->GetOutputPort());
  filter->Update();
  const vtkIdType tets = mesher->GetOutput()->GetNumberOfCells();
  const auto total = [&] {
    auto* const counts = vtkTypeInt64Array::SafeDownCast(filter->GetOutput()->GetColumnByName("count"));
    vtkTypeInt64 sum = 0;
    for (vtkIdType i = 0; i < counts->GetNumberOfValues(); ++i) sum += counts->GetValue(i);
    return sum;
  };
  EXPECT_EQ(filter->GetOutput()->GetNumberOfRows(), 36);
  EXPECT_EQ(total(), 6 * tets);
  filter->SetMeasure("scaled_jacobian");
  filter->Update();
  EXPECT_EQ(total(), tets);
  double range[2];
  mesher->GetOutput()->GetCellData()->GetArray("scaled_jacobian")->GetRange(range);
  vtkTable& statistics = *filter->GetStatistics();
  bool is_there = false;
  for (vtkIdType row = 0; row < statistics.GetNumberOfRows(); ++row) {
    if (statistics.GetValueByName(row, "measure").ToString() != "scaled_jacobian") continue;
    is_there = true;
    EXPECT_EQ(statistics.GetValueByName(row, "count").ToInt(), tets);
    EXPECT_EQ(statistics.GetValueByName(row, "min").ToDouble(), range[0]);
    EXPECT_EQ(statistics.GetValueByName(row, "max").ToDouble(), range[1]);
    EXPECT_LE(statistics.GetValueByName(row, "p5").ToDouble(), statistics.GetValueByName(row, "p50").ToDouble());
  }
  EXPECT_TRUE(is_there);
}

TEST(TetQualityHistogram, SaysWhatIsWrong) {
  vtkNew<vtkTetQualityHistogram> filter;
  Errors errors(*filter);
  errors.watch(*filter);
  vtkNew<vtkUnstructuredGrid> nothing;
  filter->SetInputData(nothing);
  filter->Update();
  EXPECT_NE(errors.text().find("input.empty_mesh"), std::string::npos) << errors.text();
  const auto mesher = make_mesher(make_ball(), 0.5, 4);
  mesher->Update();
  filter->SetInputData(mesher->GetOutput());
  filter->SetMeasure("scaled_jacobi");
  filter->Update();
  EXPECT_NE(errors.text().find("usage.measure"), std::string::npos) << errors.text();
  EXPECT_NE(errors.text().find("did you mean \"scaled_jacobian\"?"), std::string::npos) << errors.text();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfRows(), 0);
}

}  // namespace
