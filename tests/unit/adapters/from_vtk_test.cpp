#include "scantet/adapters/from_vtk.h"

#include <gtest/gtest.h>
#include <vtkBitArray.h>
#include <vtkFloatArray.h>
#include <vtkSOADataArrayTemplate.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "error_code.h"
#include "scantet/image/level_set.h"

namespace scantet {
namespace {

/// Values i + 10 j + 100 k; the extent does not begin at 0, the axes are turned and of different steps.
vtkSmartPointer<vtkImageData> make_image(int type, int components = 1) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(5, 8, -2, 0, 1, 2);
  image->SetOrigin(-7, 8, 9);
  image->SetSpacing(0.5, 2, 3);
  const double c = std::sqrt(0.75);
  image->SetDirectionMatrix(c, -0.5, 0, 0.5, c, 0, 0, 0, -1);
  image->AllocateScalars(type, components);
  for (int k = 0; k < 2; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 4; ++i) image->SetScalarComponentFromDouble(i + 5, j - 2, k + 1, 0, i + 10 * j + 100 * k);
    }
  }
  return image;
}

TEST(FromVtk, PutsEveryVoxelWhereVtkHasIt) {
  const auto image = make_image(VTK_SHORT);
  const Scan scan = scan_from_vtk(image);
  EXPECT_EQ(scan.size, (std::array<int, 3>{4, 3, 2}));
  EXPECT_EQ(scan.format, "VTK image");
  EXPECT_EQ(scan.max_value, 123);
  const auto* voxels = std::get<const std::int16_t*>(scan.voxels);
  EXPECT_EQ(voxels, image->GetScalarPointer());
  for (const vtkIdType at : {vtkIdType{0}, vtkIdType{3}, vtkIdType{8}, vtkIdType{23}}) {
    const Vec index{double(at % 4), double(at / 4 % 3), double(at / 12)};
    const double* const world = image->GetPoint(at);
    EXPECT_LT(distance(scan.frame.to_world(index), {world[0], world[1], world[2]}), 1e-12);
    EXPECT_EQ(voxels[at], index.x + 10 * index.y + 100 * index.z);
  }
  EXPECT_LT(scan.frame.determinant_mm3(), 0);
}

TEST(FromVtk, TurnsRasAxesToLps) {
  const auto image = make_image(VTK_SHORT);
  const Frame frame = scan_from_vtk(image, VtkAxes::ras).frame;
  const double* const world = image->GetPoint(23);
  EXPECT_LT(distance(frame.to_world({3, 2, 1}), {-world[0], -world[1], world[2]}), 1e-12);
}

TEST(FromVtk, TakesEveryTypeThatIsANumber) {
  const auto type_of = [](int type) { return scan_from_vtk(make_image(type)).pixel_type; };
  EXPECT_EQ(type_of(VTK_CHAR), VTK_TYPE_CHAR_IS_SIGNED ? "int8" : "uint8");
  EXPECT_EQ(type_of(VTK_SIGNED_CHAR), "int8");
  EXPECT_EQ(type_of(VTK_UNSIGNED_CHAR), "uint8");
  EXPECT_EQ(type_of(VTK_UNSIGNED_SHORT), "uint16");
  EXPECT_EQ(type_of(VTK_INT), "int32");
  EXPECT_EQ(type_of(VTK_UNSIGNED_INT), "uint32");
  EXPECT_EQ(type_of(VTK_LONG), "int64");
  EXPECT_EQ(type_of(VTK_LONG_LONG), "int64");
  EXPECT_EQ(type_of(VTK_UNSIGNED_LONG_LONG), "uint64");
  EXPECT_EQ(type_of(VTK_ID_TYPE), "int64");
  EXPECT_EQ(type_of(VTK_FLOAT), "float");
  EXPECT_EQ(type_of(VTK_DOUBLE), "double");
}

TEST(FromVtk, KeepsTheVoxelsAfterTheImageIsGone) {
  std::unique_ptr<Domain> domain;
  {
    const auto image = make_image(VTK_FLOAT);
    domain = make_level_set(scan_from_vtk(image), {.level = 50});
    image->AllocateScalars(VTK_SHORT, 1);  // an array of its own, in place of the one in use
  }
  const Frame frame = scan_from_vtk(make_image(VTK_FLOAT)).frame;
  EXPECT_EQ(domain->region_at(frame.to_world({2, 1, 1})), 1);
  EXPECT_EQ(domain->region_at(frame.to_world({2, 1, 0})), kOutside);
}

TEST(FromVtk, RefusesWhatIsNoScan) {
  EXPECT_EQ(test::error_code([] { scan_from_vtk(nullptr); }), "input.format");
  EXPECT_EQ(test::error_code([] { scan_from_vtk(vtkSmartPointer<vtkImageData>::New()); }), "input.pixel_type");
  EXPECT_EQ(test::error_code([] { scan_from_vtk(make_image(VTK_UNSIGNED_CHAR, 3)); }), "input.pixel_type");

  const auto bits = make_image(VTK_SHORT);
  auto array = vtkSmartPointer<vtkBitArray>::New();
  array->SetNumberOfTuples(24);
  for (int i = 0; i < 24; ++i) array->SetValue(i, i % 2);
  bits->GetPointData()->SetScalars(array);
  EXPECT_EQ(test::error_code([&] { scan_from_vtk(bits); }), "input.pixel_type");

  const auto few = make_image(VTK_SHORT);
  auto values = vtkSmartPointer<vtkFloatArray>::New();
  values->SetNumberOfTuples(23);
  values->FillValue(1);
  few->GetPointData()->SetScalars(values);
  EXPECT_EQ(test::error_code([&] { scan_from_vtk(few); }), "input.dimension");

  const auto apart = make_image(VTK_SHORT);
  auto of_components = vtkSmartPointer<vtkSOADataArrayTemplate<float>>::New();
  of_components->SetNumberOfComponents(1);
  of_components->SetNumberOfTuples(24);
  of_components->FillValue(1);
  apart->GetPointData()->SetScalars(of_components);
  EXPECT_EQ(test::error_code([&] { scan_from_vtk(apart); }), "input.pixel_type");

  const auto holey = make_image(VTK_DOUBLE);
  holey->SetScalarComponentFromDouble(5, -2, 1, 0, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(test::error_code([&] { scan_from_vtk(holey); }), "input.nan");

  const auto flat = vtkSmartPointer<vtkImageData>::New();
  flat->SetDimensions(4, 6, 1);
  flat->AllocateScalars(VTK_SHORT, 1);
  EXPECT_EQ(test::error_code([&] { scan_from_vtk(flat); }), "input.dimension");
}

}  // namespace
}  // namespace scantet
