#include "scantet/quality/tet_stars.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "scantet/quality/mesh_edges.h"
#include "unit/quality/grid_mesh.h"

namespace scantet {
namespace {

TEST(TetStars, HaveTheTetsOfEachVertexThatIsNotTheLargest) {
  const TetMesh mesh = test::grid_mesh(3);
  const TetStars stars(mesh);
  for (VertexId v = 0; v < mesh.vertices.size(); ++v) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < mesh.tets.size(); ++i) {
      const Tet& t = mesh.tets[i];
      const bool has_larger = std::any_of(t.begin(), t.end(), [&](VertexId w) { return w > v; });
      if (has_larger && std::find(t.begin(), t.end(), v) != t.end()) expected.push_back(i);
    }
    std::vector<std::uint32_t> found(stars.of(v).begin(), stars.of(v).end());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected) << v;
  }
}

TEST(TetStars, EachEdgeComesUpOnceInOrder) {
  const TetMesh mesh = test::grid_mesh(3);
  std::set<std::pair<VertexId, VertexId>> expected;
  for (const Tet& t : mesh.tets) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = i + 1; k < 4; ++k) expected.insert(std::minmax(t[i], t[k]));
    }
  }
  std::vector<std::pair<VertexId, VertexId>> edges;
  const TetStars stars(mesh);
  for_each_edge_star(mesh, stars, 0, mesh.vertices.size(), [&](VertexId v, const std::vector<VertexId>& neighbours) {
    for (const VertexId w : neighbours) edges.push_back({v, w});
  });
  EXPECT_TRUE(std::equal(edges.begin(), edges.end(), expected.begin(), expected.end()));
}

}  // namespace
}  // namespace scantet
