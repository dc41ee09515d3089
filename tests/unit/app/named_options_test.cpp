#include "scantet/app/named_options.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "error_code.h"
#include "scantet/field/scan_from_memory.h"
#include "scantet/quality/quality_fields.h"

namespace scantet {
namespace {

Scan ball() {
  constexpr int kWidth = 15;
  std::vector<float> heights;
  for (int k = 0; k < kWidth; ++k) {
    for (int j = 0; j < kWidth; ++j) {
      for (int i = 0; i < kWidth; ++i) {
        heights.push_back(static_cast<float>(5 - std::hypot(i - 7.0, j - 7.0, k - 7.0)));
      }
    }
  }
  return make_scan(std::move(heights), {kWidth, kWidth, kWidth}, Frame({Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}}, {}));
}

MeshOutcome mesh(const std::vector<OptionValue>& values) {
  Progress progress;
  return mesh_scan_named(ball(), values, progress);
}

std::string code_of(const std::vector<OptionValue>& values) {
  return test::error_code([&] { mesh(values); });
}

TEST(NamedOptions, AreThoseOfTheCommandForScansAndTheJob) {
  const std::vector<Option> options = named_mesh_options();
  const auto has = [&](const std::string& name) {
    return std::any_of(options.begin(), options.end(), [&](const Option& option) { return option.name == name; });
  };
  for (const char* name : {"level", "labels", "smooth", "size", "min-dihedral", "output", "set", "threads"}) {
    EXPECT_TRUE(has(name)) << name;
  }
  for (const char* name : {"config", "plugin", "plan", "quiet"}) EXPECT_FALSE(has(name)) << name;
}

TEST(NamedOptions, GiveTheMeshOfMeshScan) {
  ScanMeshOptions options;
  options.levels = {0.5};
  options.sizes.size = "2";
  Progress progress;
  const MeshOutcome expected = mesh_scan(ball(), options, progress);
  const MeshOutcome named = mesh({{"level", "0.5", "Level"}, {"size", "2", "Size"}});
  EXPECT_FALSE(named.mesh.tets.empty());
  EXPECT_EQ(named.mesh.vertices, expected.mesh.vertices);
  EXPECT_EQ(named.mesh.tets, expected.mesh.tets);
  EXPECT_TRUE(named.mesh.fields.empty());
}

TEST(NamedOptions, MeshesHaveWhatIsAskedOfThem) {
  const MeshOutcome outcome =
      mesh({{"level", "0", "x"}, {"quality-fields", "true", "x"}, {"set", "top=z > 10", "x"}, {"order", "2", "x"}});
  ASSERT_EQ(outcome.mesh.fields.size(), quality_field_names().size());
  EXPECT_EQ(outcome.mesh.fields[0].values.size(), outcome.mesh.tets.size());
  ASSERT_EQ(outcome.mesh.sets.size(), 1U);
  EXPECT_EQ(outcome.mesh.sets[0].name, "top");
  EXPECT_EQ(outcome.mesh.tet_edge_vertices.size(), outcome.mesh.tets.size());
}

TEST(NamedOptions, RefuseWhatIsNoOption) {
  EXPECT_EQ(code_of({{"levle", "0", "x"}}), "usage.unknown_option");
  EXPECT_EQ(code_of({{"level", "0", "x"}, {"quiet", "true", "x"}}), "usage.unknown_option");
  EXPECT_EQ(code_of({{"level", "0", "x"}, {"size", "small", "x"}}), "usage.formula");
  EXPECT_EQ(code_of({{"level", "0", "x"}, {"field", "volume_mm3=a.nrrd", "x"}}), "usage.field");
  EXPECT_EQ(code_of({}), "usage.level_missing");
}

}  // namespace
}  // namespace scantet
