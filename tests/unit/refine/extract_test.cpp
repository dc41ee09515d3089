// The mesh against the cells that it is of, and against what its tets alone say of their boundary.
#include <set>

#include "scantet/base/mesh_topology.h"
#include "scantet/refine/extract_impl.h"
#include "unit/nested_balls.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

class Extraction : public testing::Test {
 protected:
  Extraction() {
    std::vector<SamplePoint> sample = sparse_sample(balls_, 1, 1);
    for (int i = 0; i < 1000; ++i) {
      const Point p{1.13 * (i % 10 - 4.5), 1.17 * (i / 10 % 10 - 4.5), 1.19 * (i / 100 - 4.5)};
      if (length(p) < 6 && std::abs(length(p) - 3) > 0.5) sample.push_back({p, 3});
    }
    restricted_.emplace(triangulated(balls_, sample));
    mesh_ = extract_mesh(*restricted_);
  }
  std::array<Point, 4> points_of(const Tet& tet) const {
    return {mesh_.vertices[tet[0]], mesh_.vertices[tet[1]], mesh_.vertices[tet[2]], mesh_.vertices[tet[3]]};
  }

  const test::NestedBalls balls_{3, 6};
  std::optional<RestrictedTriangulation> restricted_;
  TetMesh mesh_;
};

TEST_F(Extraction, TetsAreTheCellsInsideInTheirOrder) {
  const Triangulation& t = restricted_->triangulation();
  std::size_t n = 0;
  for (CellId c = 0; c < t.cell_slots(); ++c) {
    if (!t.is_cell(c) || t.info(c).region == kOutside) continue;
    ASSERT_LT(n, mesh_.tets.size());
    EXPECT_EQ(points_of(mesh_.tets[n]), t.points_of(c));
    EXPECT_EQ(mesh_.tet_regions[n], t.info(c).region);
    ++n;
  }
  EXPECT_EQ(mesh_.tets.size(), n);
  EXPECT_GT(n, 1000U);
}

TEST_F(Extraction, VerticesAreThoseOfTetsAndNeighborsAreNear) {
  std::vector<int> used(mesh_.vertices.size(), 0);
  for (const Tet& tet : mesh_.tets) {
    for (const VertexId v : tet) ++used[v];
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
  const std::set<std::array<double, 3>> places = [&] {
    std::set<std::array<double, 3>> all;
    for (const Point& p : mesh_.vertices) all.insert({p.x, p.y, p.z});
    return all;
  }();
  EXPECT_EQ(places.size(), mesh_.vertices.size());
  double step = 0;
  for (std::size_t i = 1; i < mesh_.vertices.size(); ++i) step += distance(mesh_.vertices[i - 1], mesh_.vertices[i]);
  EXPECT_LT(step / static_cast<double>(mesh_.vertices.size()), 2.5) << "along a curve; at random it would be 6";
}

TEST_F(Extraction, BoundaryIsWhatTheTetsSay) {
  TetMesh again;
  again.vertices = mesh_.vertices;
  again.tets = mesh_.tets;
  again.tet_regions = mesh_.tet_regions;
  build_boundary(again);
  EXPECT_EQ(mesh_.boundary_facets, again.boundary_facets);
  EXPECT_EQ(mesh_.facet_regions, again.facet_regions);
  EXPECT_EQ(mesh_.strata, again.strata);
  EXPECT_EQ(mesh_.facet_patches, again.facet_patches);
  std::set<std::array<Region, 2>> pairs(mesh_.facet_regions.begin(), mesh_.facet_regions.end());
  EXPECT_EQ(pairs, (std::set<std::array<Region, 2>>{{1, 0}, {1, 2}}));
}

TEST_F(Extraction, FillsTheBalls) {
  std::array<double, 3> volume{};
  for (std::size_t i = 0; i < mesh_.tets.size(); ++i) {
    const auto p = points_of(mesh_.tets[i]);
    const double own = orientation_mm3(p[0], p[1], p[2], p[3]) / 6;
    EXPECT_GT(own, 0);
    volume[static_cast<std::size_t>(mesh_.tet_regions[i])] += own;
  }
  const double inner = 4.0 / 3 * M_PI * 27;
  EXPECT_NEAR(volume[2], inner, 0.1 * inner);
  EXPECT_NEAR(volume[1] + volume[2], 8 * inner, 0.05 * 8 * inner);
}

}  // namespace
}  // namespace scantet::engine
