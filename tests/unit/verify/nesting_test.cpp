// Cubes within cubes.
#include "scantet/verify/nesting.h"

#include <gtest/gtest.h>

#include <vector>

#include "block_mesh.h"

namespace scantet::verify {
namespace {

TEST(Nesting, CubesInCubesAreCounted) {
  // All coordinates are integers, so that rays from vertices would meet edges.
  TetMesh mesh;
  add_block(mesh, {0, 0, 0}, 16, 1);
  add_block(mesh, {2, 2, 2}, 12, 2);
  add_block(mesh, {4, 4, 4}, 8, 4);
  add_block(mesh, {20, 0, 0}, 4, 1);
  add_block(mesh, {6, 6, 6}, 2, 1);
  std::vector<VerifyFinding> found;
  const Shell shell = make_shell(mesh, found);
  const BoundaryRays rays(mesh, shell);
  const auto around = nesting(mesh, shell, rays);
  ASSERT_TRUE(around);
  EXPECT_EQ(*around, (std::vector<std::uint32_t>{0, 1, 2, 0, 3}));
}

TEST(Nesting, SurfacesThatTouchAreNotDecided) {
  TetMesh mesh;
  add_block(mesh, {0, 0, 0}, 4, 1);
  add_block(mesh, {0, 0, 0}, 4, 1);  // the same again
  std::vector<VerifyFinding> found;
  const Shell shell = make_shell(mesh, found);
  const BoundaryRays rays(mesh, shell);
  EXPECT_FALSE(nesting(mesh, shell, rays));
}

}  // namespace
}  // namespace scantet::verify
