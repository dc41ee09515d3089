// Slabs and rods of known numbers of layers.
#include "scantet/check/layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <random>

#include "boundary_flags.h"
#include "cancelled_after.h"
#include "unit/quality/grid_mesh.h"

namespace scantet {
namespace {

LayerCheck check_layers(const TetMesh& mesh, const std::set<Region>& regions, int layers, double thinnest_mm) {
  return scantet::check_layers(mesh, regions, layers, thinnest_mm, Progress()).value();
}

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

/// A grid whose cubes have regions at random, and points that are moved.
TetMesh rough_mesh(unsigned seed, int solid) {
  std::mt19937 random(seed);
  TetMesh mesh = test::grid_mesh(8, [&](int, int, int) {
    return static_cast<int>(random() % 100) < solid ? 1 : static_cast<Region>(random() % 3);
  });
  for (Point& p : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) p[axis] += 1e-3 * static_cast<double>(random() % 200);
  }
  return mesh;
}

/// The neighbours of each vertex, and the outward normals of the boundary.
struct PlainRegion {
  PlainRegion(const TetMesh& mesh, Region region) {
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      if (mesh.tet_regions[t] != region) continue;
      for (const VertexId a : mesh.tets[t]) {
        for (const VertexId b : mesh.tets[t]) {
          if (a != b) edges[a].insert(b);
        }
      }
    }
    for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
      const Triangle& f = mesh.boundary_facets[i];
      const Vec normal = cross(mesh.vertices[f[1]] - mesh.vertices[f[0]], mesh.vertices[f[2]] - mesh.vertices[f[0]]);
      for (const VertexId v : f) {
        if (mesh.facet_regions[i][0] == region) normals[v] = normals[v] + normal;
        if (mesh.facet_regions[i][1] == region) normals[v] = normals[v] - normal;
      }
    }
    for (auto& [v, normal] : normals) normal = (1 / length(normal)) * normal;
  }
  std::map<VertexId, std::set<VertexId>> edges;
  std::map<VertexId, Vec> normals;
};

/// How many edges it is from the vertex to the other side; `layers` if that is too far. Looks everywhere.
int edges_across(const TetMesh& mesh, const PlainRegion& region, VertexId from, int layers, double thinnest_mm) {
  std::set<VertexId> seen{from};
  std::set<VertexId> front{from};
  const Vec normal = region.normals.at(from);
  for (int depth = 1; depth < layers; ++depth) {
    std::set<VertexId> beyond;
    for (const VertexId at : front) {
      for (const VertexId next : region.edges.at(at)) {
        if (!seen.insert(next).second) continue;
        const auto side = region.normals.find(next);
        if (side == region.normals.end()) {
          beyond.insert(next);
          continue;
        }
        const Vec way = mesh.vertices[next] - mesh.vertices[from];
        if (dot(side->second, normal) <= -0.7 && length(way) >= thinnest_mm && -dot(way, normal) >= 0.5 * length(way)) {
          return depth;
        }
      }
    }
    front = beyond;
  }
  return layers;
}

TEST(Layers, AreThoseOfASearchThatLooksEverywhere) {
  for (const auto& [seed, solid] :
       std::vector<std::pair<unsigned, int>>{{1, 50}, {2, 90}, {3, 97}, {4, 99}, {5, 100}}) {
    const TetMesh mesh = rough_mesh(seed, solid);
    const PlainRegion region(mesh, 1);
    for (const int layers : {2, 3, 5, 9, 300}) {
      std::vector<int> counts;
      for (const auto& [v, normal] : region.normals) {
        const int count = edges_across(mesh, region, v, layers, 0.25);
        if (count < layers) counts.push_back(count);
      }
      const LayerCheck check = check_layers(mesh, {1}, layers, 0.25);
      EXPECT_EQ(check.vertices, region.normals.size());
      EXPECT_EQ(check.broken, counts.size()) << layers << " layers, seed " << seed;
      std::sort(counts.begin(), counts.end());
      counts.resize(std::min(counts.size(), kMostThinPlaces));
      std::vector<int> listed;
      for (const ThinPlace& place : check.places) listed.push_back(place.layers);
      EXPECT_EQ(listed, counts) << layers << " layers, seed " << seed;
    }
  }
}

/// Cancelled when what takes a second at most has taken a hundred.
class Deadline final : public Progress {
 public:
  bool cancelled() const override { return std::chrono::steady_clock::now() > end_; }

 private:
  std::chrono::steady_clock::time_point end_ = std::chrono::steady_clock::now() + std::chrono::seconds(100);
};

TEST(Layers, ManyAcrossWhatIsThickAreSoonCounted) {
  const TetMesh thick = test::grid_mesh(30);
  const auto check = scantet::check_layers(thick, {1}, 20, 0.25, Deadline());
  ASSERT_TRUE(check);
  EXPECT_EQ(check->broken, 0U);
  EXPECT_EQ(check->vertices, 5402U);
}

TEST(Layers, CountingThemCanBeCancelled) {
  const TetMesh mesh = test::grid_mesh(12, [](int i, int, int) { return i < 6 ? 1 : 2; });
  test::expect_cancellable(4, [&](const Progress& progress) {
    return scantet::check_layers(mesh, {1, 2}, 4, 0.25, progress).has_value();
  });
}

}  // namespace
}  // namespace scantet
