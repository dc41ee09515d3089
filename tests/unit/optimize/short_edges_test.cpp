#include <gtest/gtest.h>

#include "scantet/optimize/short_edges_impl.h"

namespace scantet::optimize {
namespace {

TEST(ShortEdges, AreListedOnceTheWorstFirst) {
  TetMesh mesh;  // two tets share the face (1, 2, 3)
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {4, 4, 4}};
  mesh.tets = {{0, 1, 2, 3}, {4, 1, 3, 2}};
  const auto found = short_edges(mesh, {2.5, 0, nullptr, true});
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].vertex, (std::array<VertexId, 2>{0, 1}));
  EXPECT_DOUBLE_EQ(found[0].share, 0.4);
  EXPECT_EQ(found[1].vertex, (std::array<VertexId, 2>{0, 2}));
  EXPECT_EQ(found[2].vertex, (std::array<VertexId, 2>{1, 2}));
  const UniformSize size(10);
  EXPECT_EQ(short_edges(mesh, {0, 0.25, &size, true}).size(), 3U) << "a quarter of 10 mm";
  EXPECT_EQ(short_edges(mesh, {1.5, 0.25, &size, true}).size(), 3U) << "the larger one counts";
  EXPECT_TRUE(short_edges(mesh, {1, 0, nullptr, true}).empty()) << "as long as asked for is long enough";
}

}  // namespace
}  // namespace scantet::optimize
