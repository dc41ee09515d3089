#include "scantet/quality/quality_fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "scantet/base/parallel.h"
#include "scantet/quality/quality.h"
#include "unit/quality/grid_mesh.h"

namespace scantet {
namespace {

TetMesh stretched_grid(int n) {
  TetMesh mesh = test::grid_mesh(n);
  for (Point& p : mesh.vertices) p = {p.x, p.y * (1 + 0.1 * p.x), 2 * p.z};
  return mesh;
}

TEST(QualityFields, AreWhatTheSummaryCounts) {
  const TetMesh mesh = stretched_grid(14);  // more tets than one thread takes at once
  const std::vector<MeshField> fields = quality_fields(mesh);
  const QualitySummary summary = measure_quality(mesh);
  std::map<std::string_view, std::pair<double, double>> extremes;
  ASSERT_EQ(fields.size(), quality_field_names().size());
  for (std::size_t i = 0; i < fields.size(); ++i) {
    EXPECT_EQ(fields[i].name, quality_field_names()[i]);
    ASSERT_EQ(fields[i].values.size(), mesh.tets.size());
    const auto [least, most] = std::minmax_element(fields[i].values.begin(), fields[i].values.end());
    extremes[fields[i].name] = {*least, *most};
  }
  const auto expect = [&](std::string_view name, const Distribution& d) {
    EXPECT_EQ(extremes.at(name), (std::pair{d.min, d.max})) << name;
  };
  EXPECT_EQ(extremes.at("min_dihedral_deg").first, summary.dihedral_deg.min);
  expect("max_dihedral_deg", summary.largest_dihedral_deg);
  expect("radius_edge", summary.radius_edge);
  expect("inverse_aspect", summary.inverse_aspect);
  expect("scaled_jacobian", summary.scaled_jacobian);
  expect("stiffness_ratio", summary.stiffness_ratio);
  expect("min_height_mm", summary.min_height_mm);
  expect("circumradius_mm", summary.circumradius_mm);
  expect("volume_mm3", summary.volume_mm3);
}

TEST(QualityFields, DoNotDependOnTheNumberOfThreads) {
  const TetMesh mesh = stretched_grid(14);
  std::vector<MeshField> of_one;
  std::vector<MeshField> of_three;
  with_threads(1, [&] { of_one = quality_fields(mesh); });
  with_threads(3, [&] { of_three = quality_fields(mesh); });
  for (std::size_t i = 0; i < of_one.size(); ++i) EXPECT_EQ(of_one[i].values, of_three[i].values);
}

TEST(QualityFields, AreEmptyWithoutTets) {
  for (const MeshField& field : quality_fields({})) EXPECT_TRUE(field.values.empty());
}

}  // namespace
}  // namespace scantet
