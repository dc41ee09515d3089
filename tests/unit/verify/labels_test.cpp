// Meshes of cubes around voxels against the label maps they are of, and against those they are not of.
// SCANTET_MUTATION_SEEDS: how many damaged meshes of each kind (default 2).
#include "scantet/verify/labels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <random>

#include "found.h"
#include "scantet/base/error.h"
#include "scantet/base/parallel.h"

namespace scantet {
namespace {

using test::has;

using LabelOf = std::function<Region(int, int, int)>;

/// 1 at the voxels of a label, 0 at others.
class Map final : public LabelSource {
 public:
  Map(const std::array<int, 3>& size, const LabelOf& label_of, const Frame& frame = Frame())
      : size_(size), frame_(frame) {
    for (int k = 0; k < size[2]; ++k) {
      for (int j = 0; j < size[1]; ++j) {
        for (int i = 0; i < size[0]; ++i) labels.push_back(label_of(i, j, k));
      }
    }
  }
  std::vector<Region> labels;

  Region& at(int i, int j, int k) { return labels[static_cast<std::size_t>((k * size_[1] + j) * size_[0] + i)]; }
  const std::array<int, 3>& size() const override { return size_; }
  const Frame& frame() const override { return frame_; }
  Region region_of(int i, int j, int k) const override {
    if (i < 0 || j < 0 || k < 0 || i >= size_[0] || j >= size_[1] || k >= size_[2]) return kOutside;
    return labels[static_cast<std::size_t>((k * size_[1] + j) * size_[0] + i)];
  }
  void cell(int i, int j, int k, LabelCellValues& out) const override {
    std::array<Region, 8> corners{};
    for (int c = 0; c < 8; ++c) {
      corners[static_cast<std::size_t>(c)] = region_of(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
    }
    out.regions = corners;
    std::sort(out.regions.begin(), out.regions.end());
    out.count = static_cast<std::size_t>(std::unique(out.regions.begin(), out.regions.end()) - out.regions.begin());
    for (std::size_t n = 0; n < out.count; ++n) {
      for (std::size_t c = 0; c < 8; ++c) out.values[n][c] = corners[c] == out.regions[n] ? 1 : 0;
    }
  }

 private:
  std::array<int, 3> size_;
  Frame frame_;
};

/// Six tets a voxel that has a label, around its diagonal; the cubes are a little off the voxels' centres, so that
/// these lie in tets.
TetMesh cubes(const Map& map) {
  TetMesh mesh;
  std::map<std::array<int, 3>, VertexId> vertices;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [found, is_new] = vertices.try_emplace(at, static_cast<VertexId>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(map.frame().to_world({at[0] - 0.45, at[1] - 0.4, at[2] - 0.52}));
    return found->second;
  };
  for (int k = 0; k < map.size()[2]; ++k) {
    for (int j = 0; j < map.size()[1]; ++j) {
      for (int i = 0; i < map.size()[0]; ++i) {
        if (map.region_of(i, j, k) == kOutside) continue;
        std::array<std::size_t, 3> axes{0, 1, 2};
        do {
          std::array<int, 3> at{i, j, k};
          Tet tet{vertex(at), 0, 0, 0};
          for (std::size_t n = 0; n < 3; ++n) {
            ++at[axes[n]];
            tet[n + 1] = vertex(at);
          }
          if (orientation_mm3(mesh.vertices[tet[0]], mesh.vertices[tet[1]], mesh.vertices[tet[2]],
                              mesh.vertices[tet[3]]) < 0) {
            std::swap(tet[2], tet[3]);
          }
          mesh.tets.push_back(tet);
          mesh.tet_regions.push_back(map.region_of(i, j, k));
        } while (std::next_permutation(axes.begin(), axes.end()));
      }
    }
  }
  return mesh;
}

/// A ball of two halves, 1 and 2, and one voxel of label 3 beside it.
Region halves(int i, int j, int k) {
  if (i == 2 && j == 3 && k == 4) return 3;
  if (std::hypot(i - 12.2, j - 11.7, k - 12.1) > 6.3) return kOutside;
  return i < 12 ? 1 : 2;
}

Map map_of_halves() {
  return Map({24, 24, 24}, halves);
}

Certificate verified(const TetMesh& mesh, const Map& map, VerifyOptions options = {}) {
  Progress progress;
  return verify_labels(mesh, map, options, progress);
}

std::string text_of(const Certificate& c) {
  std::string text = name_of(c.grade);
  for (const VerifyFinding& f : c.findings) text += "; " + f.code + " " + std::to_string(f.count);
  return text;
}

TEST(VerifyLabels, CubesOfVoxelsAreBounded) {
  const Map map = map_of_halves();
  const Certificate c = verified(cubes(map), map);
  ASSERT_EQ(c.grade, CertificateGrade::bounded) << text_of(c);
  ASSERT_EQ(c.regions.size(), 4U);
  for (const VerifiedRegion& r : c.regions) {
    EXPECT_EQ(r.voxels_kept, r.voxels) << r.region;
    EXPECT_EQ(r.field_components, (std::array<std::int64_t, 2>{1, 1})) << r.region;
    EXPECT_EQ(r.mesh_components, 1) << r.region;
    ASSERT_TRUE(r.mesh_to_field.upper_mm && r.field_to_mesh.upper_mm) << r.region;
    EXPECT_LT(*r.mesh_to_field.upper_mm, 2) << r.region;
    EXPECT_LT(*r.field_to_mesh.upper_mm, 1.5) << r.region;
    EXPECT_LE(r.mesh_volume_mm3[0], r.mesh_volume_mm3[1]);
    const double volume = r.region == kOutside ? 0 : static_cast<double>(r.voxels);
    EXPECT_NEAR(r.mesh_volume_mm3[0], volume, 1e-6);
    EXPECT_LE(r.field_volume_mm3[0], r.field_volume_mm3[1]);
  }
  // The corner of a cube of the lone voxel is that far from its octahedron, at the least.
  EXPECT_GT(*c.mesh_to_level.upper_mm, 0.3);
}

TEST(VerifyLabels, FramesOfAnyHandDoNotMatter) {
  const Frame left({Vec{0, 0.9, 0.1}, Vec{0.8, 0, 0}, Vec{0, 0.2, 1.3}}, {5, -3, 8});
  const Map map({24, 24, 24}, halves, left);
  const Certificate c = verified(cubes(map), map);
  EXPECT_EQ(c.grade, CertificateGrade::bounded) << text_of(c);
}

TEST(VerifyLabels, OneVoxelOfAnotherLabelIsFound) {
  const Map map = map_of_halves();
  const TetMesh mesh = cubes(map);
  Map within = map;
  within.at(9, 12, 12) = 2;  // in the midst of label 1
  const Certificate part = verified(mesh, within);
  EXPECT_EQ(part.grade, CertificateGrade::not_the_scan) << text_of(part);
  EXPECT_TRUE(has(part, "component.missing")) << text_of(part);
  EXPECT_TRUE(has(part, "voxel.changed"));
  Map hole = map;
  hole.at(9, 12, 12) = kOutside;
  EXPECT_TRUE(has(verified(mesh, hole), "component.missing"));
  Map alien = map;
  alien.at(9, 12, 12) = 7;
  EXPECT_TRUE(has(verified(mesh, alien), "region.missing"));
  Map rim = map;
  rim.at(11, 12, 12) = 2;  // it was 1, beside label 2: the same parts, and another distance
  const Certificate shown = verified(mesh, rim);
  EXPECT_TRUE(has(shown, "voxel.changed")) << text_of(shown);
  for (const VerifyFinding& f : shown.findings) EXPECT_EQ(f.is_found, f.code == "voxel.changed") << f.code;
  EXPECT_GT(*shown.mesh_to_level.upper_mm, 0.5);
  EXPECT_GT(*shown.level_to_mesh.upper_mm, 0.5);
}

TEST(VerifyLabels, MissingPartsAreFound) {
  const Map map = map_of_halves();
  Map lone = map;
  lone.at(2, 3, 4) = kOutside;
  const Certificate none = verified(cubes(lone), map);
  EXPECT_EQ(none.grade, CertificateGrade::not_the_scan);
  EXPECT_TRUE(has(none, "region.missing")) << text_of(none);
  Map second = map;
  second.at(20, 20, 20) = 3;
  const Certificate fewer = verified(cubes(map), second);
  EXPECT_EQ(fewer.grade, CertificateGrade::not_the_scan);
  EXPECT_TRUE(has(fewer, "component.missing")) << text_of(fewer);
  const Certificate more = verified(cubes(second), map);
  EXPECT_GT(more.grade, CertificateGrade::bounded);
  EXPECT_TRUE(has(more, "component.empty")) << text_of(more);
  // As many parts, but at another place.
  Map elsewhere = lone;
  elsewhere.at(20, 20, 20) = 3;
  const Certificate moved = verified(cubes(elsewhere), map);
  EXPECT_GT(moved.grade, CertificateGrade::bounded);
  EXPECT_TRUE(has(moved, "component.unmatched")) << text_of(moved);
}

TEST(VerifyLabels, OtherLabelsPlacesAndFramesAreNotBounded) {
  const Map map = map_of_halves();
  const TetMesh mesh = cubes(map);
  TetMesh permuted = mesh;
  for (Region& region : permuted.tet_regions) region = region == 1 ? 2 : region == 2 ? 1 : region;
  EXPECT_GT(verified(permuted, map).grade, CertificateGrade::bounded);
  TetMesh shifted = mesh;
  for (Point& p : shifted.vertices) p = p + Vec{9, 0, 0};
  const Certificate far = verified(shifted, map);
  EXPECT_EQ(far.grade, CertificateGrade::not_the_scan);
  EXPECT_TRUE(has(far, "voxel.far")) << text_of(far);
  const Map wider({24, 24, 24}, halves, Frame({Vec{1.5, 0, 0}, Vec{0, 1.5, 0}, Vec{0, 0, 1.5}}, {}));
  EXPECT_GT(verified(mesh, wider).grade, CertificateGrade::bounded);
  const Map mirrored({24, 24, 24}, halves, Frame({Vec{-1, 0, 0}, Vec{0, -1, 0}, Vec{0, 0, 1}}, {}));
  EXPECT_GT(verified(mesh, mirrored).grade, CertificateGrade::bounded);
  const Map another({24, 24, 24}, [](int i, int j, int k) { return i > 3 && j > 3 && k > 3 && i < 9 ? 1 : kOutside; });
  EXPECT_EQ(verified(mesh, another).grade, CertificateGrade::not_the_scan);
}

TEST(VerifyLabels, VoxelsThatOnlyTouchAreApart) {
  // Two voxels of a label beside each other across an edge: the saddle between them is a tie, and they are not joined.
  // Their cubes have that edge in common, so that the boundary is no surface.
  const auto touch = [](int i, int j, int k) {
    return (i == 3 && j == 3 && k == 3) || (i == 4 && j == 4 && k == 3) ? 1 : kOutside;
  };
  const Map map({8, 8, 8}, touch);
  const Certificate c = verified(cubes(map), map);
  EXPECT_EQ(c.grade, CertificateGrade::undecided) << text_of(c);
  EXPECT_TRUE(has(c, "boundary.edge")) << text_of(c);
  ASSERT_EQ(c.regions.size(), 2U);
  EXPECT_EQ(c.regions[1].field_components, (std::array<std::int64_t, 2>{2, 2}));
  EXPECT_EQ(c.regions[1].mesh_components, 2);
}

TEST(VerifyLabels, FourLabelsLeaveTheDiagonalToOne) {
  // The same with two other labels beside them, of which neither is as large on the diagonal. The mesh has two parts.
  const auto touch = [](int i, int j, int k) {
    if (k != 3 || i < 3 || i > 4 || j < 3 || j > 4) return kOutside;
    return i == j ? 1 : i == 3 ? 2 : 3;
  };
  const Map map({8, 8, 8}, touch);
  const Certificate c = verified(cubes(map), map);
  EXPECT_EQ(c.grade, CertificateGrade::undecided) << text_of(c);
  EXPECT_EQ(c.regions[1].field_components, (std::array<std::int64_t, 2>{1, 1}));
  EXPECT_EQ(c.regions[1].mesh_components, 2);
  EXPECT_TRUE(has(c, "component.split")) << text_of(c);
}

TEST(VerifyLabels, DamagedMeshesAreNotBounded) {
  const Map map = map_of_halves();
  const TetMesh mesh = cubes(map);
  std::mt19937 random(1);
  const char* const seeds = std::getenv("SCANTET_MUTATION_SEEDS");
  for (int seed = 0; seed < (seeds == nullptr ? 2 : std::atoi(seeds));) {
    const std::size_t t = random() % mesh.tets.size();
    // What is taken from the rim may leave a mesh that is as good.
    if (distance(mesh.vertices[mesh.tets[t][0]], {12, 12, 12}) > 4) continue;
    ++seed;
    TetMesh removed = mesh;
    removed.tets.erase(removed.tets.begin() + static_cast<std::ptrdiff_t>(t));
    removed.tet_regions.erase(removed.tet_regions.begin() + static_cast<std::ptrdiff_t>(t));
    EXPECT_GT(verified(removed, map).grade, CertificateGrade::bounded) << seed;
    TetMesh twice = mesh;
    twice.tets.push_back(mesh.tets[t]);
    twice.tet_regions.push_back(mesh.tet_regions[t]);
    EXPECT_EQ(verified(twice, map).grade, CertificateGrade::not_the_scan) << seed;
    TetMesh flipped = mesh;
    std::swap(flipped.tets[t][0], flipped.tets[t][1]);
    EXPECT_EQ(verified(flipped, map).grade, CertificateGrade::not_the_scan) << seed;
    TetMesh renamed = mesh;
    renamed.tet_regions[t] = 9;
    EXPECT_TRUE(has(verified(renamed, map), "region.unknown")) << seed;
    TetMesh moved = mesh;
    moved.vertices[moved.tets[t][0]] = moved.vertices[moved.tets[t][0]] + Vec{0, 0, 2.5};
    EXPECT_GT(verified(moved, map).grade, CertificateGrade::bounded) << seed;
  }
}

TEST(VerifyLabels, DistanceThatIsAskedForIsKept) {
  const Map map = map_of_halves();
  VerifyOptions options;
  options.max_distance_mm = 0.1;
  const Certificate c = verified(cubes(map), map, options);
  EXPECT_EQ(c.grade, CertificateGrade::undecided);
  EXPECT_TRUE(has(c, "distance.not_shown"));
  options.max_distance_mm = 3;
  EXPECT_EQ(verified(cubes(map), map, options).grade, CertificateGrade::bounded);
}

TEST(VerifyLabels, BoundsHoldTheTrueDistance) {
  // Cubes pushed along x by a known amount: planes between the halves are that far from each other.
  const Map map({16, 16, 16}, [](int i, int j, int k) {
    const bool in = std::min({i, j, k}) >= 4 && std::max({i, j, k}) < 12;
    return !in ? kOutside : i < 8 ? 1 : 2;
  });
  for (const double by : {0.0, 0.3, 0.8}) {
    TetMesh mesh = cubes(map);
    for (Point& p : mesh.vertices) p = p + Vec{by, 0, 0};
    const Certificate c = verified(mesh, map);
    // The plane between 1 and 2 is at 7.5 in the label map, and at 8 - 0.45 + by in the mesh.
    ASSERT_TRUE(c.mesh_to_level.upper_mm && c.level_to_mesh.upper_mm) << text_of(c);
    EXPECT_GE(*c.mesh_to_level.upper_mm, 0.05 + by) << text_of(c);
    EXPECT_GE(*c.level_to_mesh.upper_mm, 0.05 + by);
    EXPECT_LE(*c.mesh_to_level.upper_mm, 0.05 + by + 1.5);
    EXPECT_LE(*c.level_to_mesh.upper_mm, 0.05 + by + 1.5);
  }
}

TEST(VerifyLabels, OutcomeDoesNotDependOnThreads) {
  const Map map = map_of_halves();
  const TetMesh mesh = cubes(map);
  std::vector<double> bounds;
  for (const int threads : {1, 3}) {
    with_threads(threads, [&] {
      const Certificate c = verified(mesh, map);
      for (const VerifiedRegion& r : c.regions) {
        bounds.insert(bounds.end(), {*r.mesh_to_field.upper_mm, *r.field_to_mesh.upper_mm, r.field_volume_mm3[0]});
      }
    });
  }
  ASSERT_EQ(bounds.size() % 2, 0U);
  for (std::size_t n = 0; n < bounds.size() / 2; ++n) EXPECT_EQ(bounds[n], bounds[n + bounds.size() / 2]);
}

TEST(VerifyLabels, WhatIsNoMeshIsRefused) {
  const Map map = map_of_halves();
  EXPECT_THROW(verified({}, map), Error);
  TetMesh broken = cubes(map);
  broken.tet_regions.pop_back();
  EXPECT_THROW(verified(broken, map), Error);
}

}  // namespace
}  // namespace scantet
