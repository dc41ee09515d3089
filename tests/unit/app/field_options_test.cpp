#include "scantet/app/field_options.h"

#include <gtest/gtest.h>

#include <memory>

#include "scantet/base/error.h"

namespace scantet {
namespace {

TEST(FieldScans, AScanThatIsKnownIsNotReadAgain) {
  const auto values = std::make_shared<const std::vector<double>>(8, 5.0);
  Scan scan;
  scan.size = {2, 2, 2};
  scan.voxels = VoxelPointer{values->data()};
  scan.owner = values;
  ScanTable known;
  known.emplace("nowhere.nrrd", ScanValues(scan));
  Progress progress;
  const Box object{{0, 0, 0}, {1, 1, 1}};
  const FieldScans fields({"a=nowhere.nrrd", "b=nowhere.nrrd:max"}, object, known, progress);
  TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{0, 1, 2, 3}};
  Report report;
  std::vector<std::string> notes;
  fields.add_to(mesh, report, notes);
  ASSERT_EQ(mesh.fields.size(), 2U);
  EXPECT_NEAR(mesh.fields[0].values.at(0), 5, 1e-12);
  EXPECT_THROW(FieldScans({"a=nowhere.nrrd"}, object, {}, progress), Error);
}

}  // namespace
}  // namespace scantet
