// The mesher as programs of VTK's use it, held against the installed command.
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkMatrix3x3.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <thread>
#include <vector>

#include "support.h"

namespace {

/// Labels 1 and 2, each half of a box.
vtkSmartPointer<vtkImageData> make_halves() {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(12, 12, 12);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  for (int k = 0; k < 12; ++k) {
    for (int j = 0; j < 12; ++j) {
      for (int i = 0; i < 12; ++i) {
        const bool inside = std::min({i, j, k}) > 1 && std::max({i, j, k}) < 10;
        image->SetScalarComponentFromDouble(i, j, k, 0, inside ? (i < 6 ? 1 : 2) : 0);
      }
    }
  }
  return image;
}

void write_nrrd(vtkImageData& image, const std::string& space, const std::string& path) {
  std::ofstream out(path, std::ios::binary);
  out.precision(17);
  out << "NRRD0004\ntype: float\ndimension: 3\nspace: " << space << "\nsizes: 21 21 21\nspace directions:";
  const vtkMatrix3x3& d = *image.GetDirectionMatrix();
  double first[3];  // of the first voxel
  image.GetOrigin(first);
  for (int axis = 0; axis < 3; ++axis) {
    double column[3];
    for (int row = 0; row < 3; ++row) {
      column[row] = image.GetSpacing()[axis] * d.GetElement(row, axis);
      first[row] = first[row] + image.GetExtent()[2 * axis] * column[row];
    }
    out << " (" << column[0] << "," << column[1] << "," << column[2] << ")";
  }
  out << "\nspace origin: (" << first[0] << "," << first[1] << "," << first[2]
      << ")\nencoding: raw\nendian: little\n\n";
  out.write(static_cast<const char*>(image.GetScalarPointer()), sizeof(float) * kSide * kSide * kSide);
}

void expect_same_arrays(vtkDataSetAttributes& ours, vtkDataSetAttributes& theirs) {
  ASSERT_EQ(ours.GetNumberOfArrays(), theirs.GetNumberOfArrays());
  for (int a = 0; a < theirs.GetNumberOfArrays(); ++a) {
    vtkDataArray* const expected = theirs.GetArray(a);
    vtkDataArray* const found = ours.GetArray(expected->GetName());
    ASSERT_NE(found, nullptr) << expected->GetName();
    EXPECT_EQ(found->GetDataType(), expected->GetDataType()) << expected->GetName();
    ASSERT_EQ(found->GetNumberOfTuples(), expected->GetNumberOfTuples());
    for (vtkIdType i = 0; i < expected->GetNumberOfTuples(); ++i) {
      ASSERT_EQ(found->GetTuple1(i), expected->GetTuple1(i)) << expected->GetName() << " of " << i;
    }
  }
}

void expect_same_grids(vtkUnstructuredGrid& ours, vtkUnstructuredGrid& theirs) {
  ASSERT_GT(theirs.GetNumberOfCells(), 100);
  ASSERT_EQ(ours.GetNumberOfPoints(), theirs.GetNumberOfPoints());
  ASSERT_EQ(ours.GetNumberOfCells(), theirs.GetNumberOfCells());
  for (vtkIdType v = 0; v < ours.GetNumberOfPoints(); ++v) {
    double p[3];
    double q[3];
    ours.GetPoint(v, p);
    theirs.GetPoint(v, q);
    ASSERT_TRUE(std::equal(p, p + 3, q)) << v;
  }
  for (vtkIdType c = 0; c < ours.GetNumberOfCells(); ++c) {
    ASSERT_EQ(ours.GetCellType(c), theirs.GetCellType(c));
    vtkNew<vtkIdList> a;
    vtkNew<vtkIdList> b;
    ours.GetCellPoints(c, a);
    theirs.GetCellPoints(c, b);
    ASSERT_TRUE(std::equal(a->begin(), a->end(), b->begin(), b->end())) << c;
  }
  expect_same_arrays(*ours.GetCellData(), *theirs.GetCellData());
  expect_same_arrays(*ours.GetPointData(), *theirs.GetPointData());
}

void expect_the_commands_mesh(int axes, const std::string& space, const std::string& more) {
  const auto image = make_ball();
  image->SetDirectionMatrix(0, -1, 0, 1, 0, 0, 0, 0, -1);  // a file's other directions lose their last bits in reading
  const std::string stem = "ball_" + std::to_string(axes);
  write_nrrd(*image, space, stem + ".nrrd");
  const std::string line = std::string(SCANTET_PROGRAM) + " mesh " + stem +
                           ".nrrd --level 0.5 --size 3 --quality-fields --quiet --set \"top=z < 5\" " + more + " -o " +
                           stem + ".vtu";
  ASSERT_EQ(std::system(line.c_str()), 0) << line;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((stem + ".vtu").c_str());
  reader->Update();
  const auto mesher = make_mesher(image, 0.5, 3);
  mesher->SetAxes(axes);
  mesher->SetOption("set", "top=z < 5");
  mesher->Update();
  expect_same_grids(*mesher->GetOutput(), *reader->GetOutput());
}

TEST(ScantetMesher, GivesTheMeshOfTheCommandWhereverTheImageLies) {
  expect_the_commands_mesh(vtkScantetMesher::LPS, "left-posterior-superior", "");
}

TEST(ScantetMesher, GivesTheMeshOfTheCommandInRas) {
  expect_the_commands_mesh(vtkScantetMesher::RAS, "right-anterior-superior", "--space ras");
}

TEST(ScantetMesher, RespectsTurnedAxes) {
  const auto image = make_ball();
  for (const int axes : {vtkScantetMesher::LPS, vtkScantetMesher::RAS}) {
    const auto mesher = make_mesher(image, 0, 3);
    mesher->SetAxes(axes);
    mesher->Update();
    vtkUnstructuredGrid& grid = *mesher->GetOutput();
    ASSERT_GT(grid.GetNumberOfCells(), 100);
    for (vtkIdType v = 0; v < grid.GetNumberOfPoints(); ++v) {
      double index[3];
      image->TransformPhysicalPointToContinuousIndex(grid.GetPoint(v), index);
      const double radius = std::hypot(index[0] - 13, index[1] - 6, index[2] - 10);  // the extent begins at 3, -4, 0
      const bool on_boundary = grid.GetPointData()->GetArray("on_boundary")->GetTuple1(v) != 0;
      EXPECT_NEAR(radius, on_boundary ? kRadius : kRadius / 2, on_boundary ? 0.1 : kRadius / 2) << v;
    }
  }
}

TEST(ScantetMesher, TellsItsProgressOnTheThreadThatUpdates) {
  const auto mesher = make_mesher(make_ball(), 0, 1);
  std::vector<double> shares;
  bool on_this_thread = true;
  const auto thread = std::this_thread::get_id();
  const Observer observer(*mesher, vtkCommand::ProgressEvent, [&](void* share) {
    shares.push_back(*static_cast<double*>(share));
    on_this_thread = on_this_thread && std::this_thread::get_id() == thread;
  });
  mesher->Update();
  EXPECT_TRUE(on_this_thread);
  ASSERT_GT(shares.size(), 5U);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1);
}

TEST(ScantetMesher, IsAbortedAndRunsAgain) {
  const auto mesher = make_mesher(make_ball(), 0, 0.15);
  bool aborts = true;
  std::chrono::steady_clock::time_point told;
  const Observer observer(*mesher, vtkCommand::ProgressEvent, [&](void* share) {
    if (!aborts || *static_cast<double*>(share) < 0.15) return;
    if (mesher->GetAbortExecute() == 0) told = std::chrono::steady_clock::now();
    mesher->SetAbortExecute(1);
  });
  mesher->Update();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - told).count();
  EXPECT_LT(seconds, 20) << "a second on an idle machine";
  EXPECT_EQ(mesher->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(mesher->GetBoundary()->GetNumberOfCells(), 0);
  EXPECT_STREQ(mesher->GetErrorText(), "");
  aborts = false;
  mesher->SetSize(4);
  mesher->Update();
  EXPECT_GT(mesher->GetOutput()->GetNumberOfCells(), 100);
}

TEST(ScantetMesher, RunsOnlyWhenSomethingChanged) {
  const auto mesher = make_mesher(make_ball(), 0, 4);
  int runs = 0;
  const Observer observer(*mesher, vtkCommand::StartEvent, [&](void*) { ++runs; });
  mesher->Update();
  mesher->SetSize(4);
  mesher->Update();
  EXPECT_EQ(runs, 1);
  mesher->SetSize(3);
  mesher->Update();
  EXPECT_EQ(runs, 2);
}

TEST(ScantetMesher, KnowsTheBoundaryAndTheNames) {
  vtkNew<vtkScantetMesher> mesher;
  mesher->SetInputData(make_halves());
  mesher->SetLabels("all");
  mesher->SetSize(2);
  mesher->SetThreads(1);
  mesher->Update();
  vtkFieldData& facts = *mesher->GetOutput()->GetFieldData();
  const auto* const names = vtkStringArray::SafeDownCast(facts.GetAbstractArray("region_names"));
  ASSERT_NE(names, nullptr);
  EXPECT_EQ(names->GetNumberOfValues(), 2);
  EXPECT_EQ(facts.GetArray("region_ids")->GetTuple1(1), 2);
  auto* const report = vtkStringArray::SafeDownCast(facts.GetAbstractArray("report"));
  EXPECT_NE(report->GetValue(0).find("\"quality\""), std::string::npos);
  vtkPolyData& boundary = *mesher->GetBoundary();
  auto* const patch_names = vtkStringArray::SafeDownCast(boundary.GetFieldData()->GetAbstractArray("patch_names"));
  auto* const patches = vtkIntArray::SafeDownCast(boundary.GetCellData()->GetArray("patch"));
  auto* const regions = vtkIntArray::SafeDownCast(boundary.GetCellData()->GetArray("regions"));
  ASSERT_EQ(patches->GetNumberOfTuples(), boundary.GetNumberOfPolys());
  vtkIdType between = 0;
  for (vtkIdType f = 0; f < patches->GetNumberOfTuples(); ++f) {
    const bool is_between = regions->GetTypedComponent(f, 0) == 1 && regions->GetTypedComponent(f, 1) == 2;
    between += is_between ? 1 : 0;
    EXPECT_EQ(is_between, patch_names->GetValue(patches->GetValue(f)) == "boundary_1_2");
  }
  EXPECT_GT(between, 10);
  EXPECT_LT(between, boundary.GetNumberOfPolys() / 2);
}

TEST(ScantetMesher, TakesTheArrayThatIsNamed) {
  const auto image = make_ball();
  vtkNew<vtkFloatArray> zeros;
  zeros->SetName("zeros");
  zeros->SetNumberOfValues(image->GetNumberOfPoints());
  zeros->FillValue(0);
  image->GetPointData()->AddArray(zeros);
  image->GetPointData()->SetActiveScalars("zeros");
  const auto mesher = make_mesher(image, 0.5, 4);
  mesher->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "height");
  mesher->QualityArraysOff();
  mesher->Update();
  EXPECT_GT(mesher->GetOutput()->GetNumberOfCells(), 100);
  EXPECT_EQ(mesher->GetOutput()->GetCellData()->GetNumberOfArrays(), 1);
}

TEST(ScantetMesher, HasTheOptionsOfTheCommandByName) {
  vtkNew<vtkScantetMesher> mesher;
  Errors errors(*mesher);
  ASSERT_GT(vtkScantetMesher::GetNumberOfOptions(), 30);
  for (int i = 0; i < vtkScantetMesher::GetNumberOfOptions(); ++i) {
    const char* const name = vtkScantetMesher::GetOptionName(i);
    EXPECT_TRUE(mesher->SetOption(name, "1")) << name;
    EXPECT_STREQ(mesher->GetOption(name), "1");
    EXPECT_GT(std::string(vtkScantetMesher::GetOptionHelp(name)).size(), 10U);
  }
  EXPECT_EQ(errors.text(), "");
  mesher->ClearOptions();
  EXPECT_EQ(mesher->GetOption("level"), nullptr);
  EXPECT_FALSE(mesher->SetOption("min-dihedrall", "12"));
  EXPECT_NE(errors.text().find("did you mean \"min-dihedral\"?"), std::string::npos) << errors.text();
  EXPECT_EQ(vtkScantetMesher::GetOptionName(-1), nullptr);
  EXPECT_EQ(vtkScantetMesher::GetOptionHelp(nullptr), nullptr);
  mesher->SetLevel(1);
  mesher->AddOption("level", "2");
  EXPECT_STREQ(mesher->GetOption("level"), "1");
  mesher->SetLevel(1);  // alone again
  mesher->RemoveOption("level");
  EXPECT_EQ(mesher->GetOption("level"), nullptr);
  mesher->SetOption("size", "2");
  mesher->SetOption("size", mesher->GetOption("size"));
  mesher->AddOption("size", "3");
  mesher->SetOption("size", mesher->GetOption("size"));
  EXPECT_STREQ(mesher->GetOption("size"), "2");
  EXPECT_EQ(errors.text().find("size"), std::string::npos) << errors.text();
}

/// As error_of() below, of a mesher that was told of an array.
TEST(ScantetMesher, RefusesAnArrayThatIsNotThere) {
  const auto mesher = make_mesher(make_ball(), 0.5, 4);
  mesher->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "heigth");
  Errors errors(*mesher);
  errors.watch(*mesher);
  mesher->Update();
  EXPECT_EQ(mesher->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(std::string(mesher->GetErrorText()).substr(0, 16), "input.pixel_type");
}

TEST(ScantetMesher, SaysWhatIsWrongWithItsInput) {
  const auto error_of = [](vtkImageData* image, const std::function<void(vtkScantetMesher&)>& change) {
    const auto mesher = make_mesher(image, 0, 4);
    if (change) change(*mesher);
    Errors errors(*mesher);
    errors.watch(*mesher);
    mesher->Update();
    EXPECT_EQ(mesher->GetOutput()->GetNumberOfCells(), 0);
    EXPECT_NE(errors.text().find(mesher->GetErrorText()), std::string::npos);
    const std::string text = mesher->GetErrorText();
    return text.substr(0, text.find(':'));
  };
  EXPECT_EQ(error_of(make_ball(), [](auto& mesher) { mesher.SetLevel(1000); }), "input.level");
  EXPECT_EQ(error_of(make_ball(), [](auto& mesher) { mesher.SetOption("size", "small"); }), "usage.formula");
  EXPECT_EQ(error_of(make_ball(), [](auto& mesher) { mesher.ClearOptions(); }), "usage.level_missing");
  vtkNew<vtkImageData> empty;
  empty->SetDimensions(4, 4, 4);
  EXPECT_EQ(error_of(empty, {}), "input.pixel_type");
  const auto holey = make_ball();
  vtkFloatArray::SafeDownCast(holey->GetPointData()->GetScalars())
      ->SetValue(5, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(error_of(holey, {}), "input.nan");
}

}  // namespace
