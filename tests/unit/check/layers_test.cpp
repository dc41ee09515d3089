// Slabs and rods of known numbers of layers.
#include "scantet/check/layers.h"

#include <gtest/gtest.h>

#include "boundary_flags.h"
#include "unit/quality/grid_mesh.h"

namespace scantet {
namespace {

TetMesh slab(int layers) {
  return test::grid_mesh(6, [&](int, int, int k) { return k < layers ? 1 : kOutside; });
}

TEST(Layers, SlabsHaveAsManyAsTheirCubes) {
  for (int layers = 1; layers <= 4; ++layers) {
    const TetMesh mesh = slab(layers);
    for (int asked = 2; asked <= 5; ++asked) {
      const LayerCheck check = check_layers(mesh, {1}, asked, 0.25);
      EXPECT_GT(check.vertices, 90U);
      ASSERT_EQ(check.broken > 0, layers < asked) << layers << " of " << asked;
      if (check.broken == 0) continue;
      EXPECT_EQ(check.places.front().layers, layers);
      EXPECT_NEAR(check.places.front().place.z, layers / 2.0, 1e-9);
      EXPECT_LE(check.places.size(), kMostThinPlaces);
    }
  }
}

TEST(Layers, OtherRegionsAndTheThinnestPartsAreNotLookedAt) {
  EXPECT_EQ(check_layers(slab(1), {2}, 2, 0.25).vertices, 0U);
  EXPECT_EQ(check_layers(slab(1), {1}, 2, 5).broken, 0U);
}

TEST(Layers, SidesMayBeOfSeveralRegions) {
  const TetMesh mesh = test::grid_mesh(6, [](int, int, int k) { return k < 2 ? 1 : k < 3 ? 2 : 3; });
  EXPECT_EQ(check_layers(mesh, {1}, 2, 0.25).broken, 0U);
  EXPECT_GT(check_layers(mesh, {2}, 2, 0.25).broken, 0U);
  EXPECT_EQ(check_layers(mesh, {3}, 3, 0.25).broken, 0U);
  const LayerCheck all = check_layers(mesh, {1, 2, 3}, 2, 0.25);
  EXPECT_EQ(all.broken, check_layers(mesh, {2}, 2, 0.25).broken);
}

TEST(Layers, RodsHaveTheirSidesAllAround) {
  const TetMesh rod = test::grid_mesh(6, [](int, int j, int k) { return j == 2 && k == 2 ? 1 : kOutside; });
  EXPECT_GT(check_layers(rod, {1}, 2, 0.25).broken, 0U);
}

}  // namespace
}  // namespace scantet
