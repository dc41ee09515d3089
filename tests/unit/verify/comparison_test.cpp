// Parts of fields whose nodes or saddles are at the level itself, and components too small to reach their own voxels.
#include "scantet/verify/comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "block_mesh.h"
#include "scantet/field/scan_from_memory.h"

namespace scantet::verify {
namespace {

/// 12³ voxels of -1, but for a cube of 1 from 2 to 8 and what is set in it afterwards.
struct Field {
  std::vector<float> values = std::vector<float>(12 * 12 * 12, -1.0F);
  float& at(int i, int j, int k) { return values[static_cast<std::size_t>((k * 12 + j) * 12 + i)]; }
  void fill(int from, int to) {
    for (int k = from; k <= to; ++k) {
      for (int j = from; j <= to; ++j) {
        for (int i = from; i <= to; ++i) at(i, j, k) = 1;
      }
    }
  }
};

struct Compared {
  Comparison with;
  double level = 0;
  std::vector<VerifyFinding> wrong_in_mesh;
  bool is_wrong(const std::string& code) const {
    return std::any_of(with.findings.begin(), with.findings.end(),
                       [&](const auto& f) { return f.code == code && f.is_wrong; });
  }
  bool is_any_wrong() const {
    return std::any_of(with.findings.begin(), with.findings.end(), [](const auto& f) { return f.is_wrong; });
  }
  bool has(const std::string& code) const {
    return std::any_of(with.findings.begin(), with.findings.end(), [&](const auto& f) { return f.code == code; });
  }
};

/// Of the level 0, between -2 and 2 everywhere.
Compared compare(const Field& field, const TetMesh& mesh) {
  const Scan scan = make_scan(std::vector<float>(field.values), {12, 12, 12}, Frame());
  VoxelNodes nodes(scan, LevelSetSettings{}, false);
  Compared out;
  const Shell shell = make_shell(mesh, out.wrong_in_mesh);
  const BoundaryRays rays(mesh, shell);
  out.with = compare_parts(mesh, shell, rays, nodes, MayBeLeftOut{}, Progress());
  out.level = nodes.level();
  return out;
}

TEST(CompareParts, FieldWithoutTiesIsTakenAsItIs) {
  Field field;
  field.fill(2, 8);
  TetMesh mesh;
  add_block(mesh, {1.6, 1.6, 1.6}, 6.9, 3);
  const Compared found = compare(field, mesh);
  EXPECT_TRUE(found.wrong_in_mesh.empty());
  EXPECT_TRUE(found.with.findings.empty());
  EXPECT_TRUE(found.with.matching.has_same_counts);
  EXPECT_TRUE(found.with.matching.has_same_euler);
  EXPECT_EQ(found.level, 0);
}

TEST(CompareParts, NodeAtTheLevelIsWhereTheMeshHasIt) {
  Field field;
  field.fill(2, 8);
  field.at(5, 5, 5) = 0;
  TetMesh whole;
  add_block(whole, {1.6, 1.6, 1.6}, 6.9, 3);
  const Compared filled = compare(field, whole);
  ASSERT_EQ(filled.with.findings.size(), 1U);
  EXPECT_EQ(filled.with.findings[0].code, "level.tie");
  EXPECT_TRUE(filled.with.findings[0].is_found);
  EXPECT_EQ(filled.with.matching.field.cavities, 0);
  EXPECT_NE(filled.level, 0);
  TetMesh hollow;
  add_block(hollow, {1.6, 1.6, 1.6}, 6.9, 3, {{1, 1, 1}});
  const Compared open = compare(field, hollow);
  ASSERT_EQ(open.with.findings.size(), 1U);
  EXPECT_EQ(open.with.findings[0].code, "level.tie");
  EXPECT_EQ(open.with.matching.field.cavities, 1);
  EXPECT_EQ(open.with.matching.mesh.cavities, 1);
}

TEST(CompareParts, TiesDoNotHideWhatTheMeshLacks) {
  Field field;
  field.fill(2, 8);
  field.at(5, 5, 5) = 0;
  field.at(10, 10, 10) = 1;
  TetMesh mesh;
  add_block(mesh, {1.6, 1.6, 1.6}, 6.9, 3);
  const Compared found = compare(field, mesh);
  EXPECT_TRUE(found.has("level.tie"));
  EXPECT_TRUE(found.has("component.missing"));
  EXPECT_TRUE(found.is_wrong("topology.counts")) << "there are two components on whichever side the tie is";
}

TEST(CompareParts, WhatDependsOnHowTiesAreBrokenIsNotWrong) {
  Field field;  // two pairs of voxels, each with a saddle at the level between them: two to four components
  for (const int n : {3, 8}) field.at(n, n, 3) = field.at(n + 1, n + 1, 3) = 1;
  TetMesh three;  // one pair joined, the other not: neither way of breaking both alike
  add_block(three, {2.8, 2.8, 2.8}, 1.4, 1);
  add_block(three, {7.8, 7.8, 2.8}, 0.4, 1);
  add_block(three, {8.8, 8.8, 2.8}, 0.4, 1);
  const Compared some = compare(field, three);
  EXPECT_TRUE(some.has("topology.counts"));
  EXPECT_FALSE(some.is_any_wrong());
  TetMesh one;
  add_block(one, {2.8, 2.8, 2.8}, 1.4, 1);
  EXPECT_TRUE(compare(field, one).is_wrong("topology.counts")) << "a pair is not there, joined or not";
  TetMesh five = three;
  add_block(five, {2.8, 8.8, 2.8}, 0.4, 1);
  add_block(five, {2.8, 2.8, 8.8}, 0.4, 1);
  EXPECT_TRUE(compare(field, five).is_wrong("topology.counts"));
}

TEST(CompareParts, EachNodeAtTheLevelMayBeACavityOrNot) {
  Field field;
  field.fill(2, 8);
  for (const int n : {3, 5, 7}) field.at(n, n, n) = 0;
  const auto with_cavities = [](const std::vector<std::array<int, 3>>& holes) {
    TetMesh mesh;
    add_block(mesh, {1.6, 1.6, 1.6}, 6.9, 7, holes);
    return mesh;
  };
  const std::vector<std::array<int, 3>> elsewhere{{2, 2, 2}, {4, 2, 2}, {2, 4, 2}, {2, 2, 4}};
  const Compared three = compare(field, with_cavities({elsewhere.begin(), elsewhere.begin() + 3}));
  EXPECT_TRUE(three.has("cavity.extra"));
  EXPECT_FALSE(three.is_any_wrong()) << "there may be three";
  EXPECT_TRUE(compare(field, with_cavities(elsewhere)).is_wrong("topology.counts"));
}

TEST(CompareParts, PartsThatMeetAtASaddleAreOneOrTwoAsTheMeshHasThem) {
  Field field;
  field.at(4, 4, 4) = 1;
  field.at(5, 5, 4) = 1;  // the face between has its saddle at the level
  TetMesh two;
  add_block(two, {3.8, 3.8, 3.8}, 0.4, 1);
  add_block(two, {4.8, 4.8, 3.8}, 0.4, 1);
  const Compared apart = compare(field, two);
  EXPECT_TRUE(apart.with.findings.empty());
  EXPECT_EQ(apart.with.matching.field.components, 2);
  TetMesh one;
  add_block(one, {3.8, 3.8, 3.8}, 1.4, 1);
  const Compared joined = compare(field, one);
  ASSERT_EQ(joined.with.findings.size(), 1U);
  EXPECT_EQ(joined.with.findings[0].code, "level.tie");
  EXPECT_EQ(joined.with.matching.field.components, 1);
  EXPECT_TRUE(joined.with.matching.has_same_euler);
}

TEST(CompareParts, ComponentWhoseVoxelIsNotCoveredIsFoundByItsTets) {
  Field field;
  field.at(3, 3, 3) = 1;
  field.at(8, 8, 8) = 1;
  TetMesh beside;
  add_block(beside, {2.9, 2.9, 2.9}, 0.2, 1);
  add_block(beside, {8.05, 8.05, 8.05}, 0.1, 1);  // within the component, beside its voxel
  const Compared found = compare(field, beside);
  EXPECT_TRUE(found.with.findings.empty());
  TetMesh elsewhere;
  add_block(elsewhere, {2.9, 2.9, 2.9}, 0.2, 1);
  add_block(elsewhere, {9, 9, 9}, 0.5, 1);
  EXPECT_TRUE(compare(field, elsewhere).has("component.unmatched"));
  TetMesh twice;  // two parts of the mesh cannot be one of the field
  add_block(twice, {3.05, 3.05, 3.05}, 0.1, 1);
  add_block(twice, {2.85, 2.85, 2.85}, 0.1, 1);
  EXPECT_TRUE(compare(field, twice).has("component.unmatched"));
}

TEST(CompareParts, ComponentsInOneCellAreToldApart) {
  Field field;
  field.at(4, 4, 4) = 1;
  field.at(5, 5, 5) = 1;
  TetMesh mesh;  // in the cell that has both, beside their voxels
  add_block(mesh, {4.05, 4.05, 4.05}, 0.1, 1);
  add_block(mesh, {4.85, 4.85, 4.85}, 0.1, 1);
  EXPECT_TRUE(compare(field, mesh).with.findings.empty());
}

TEST(CompareParts, ComponentWhoseVoxelIsInTheMeshOfAnotherIsFoundByItsTets) {
  Field field;
  field.fill(2, 5);
  field.at(8, 8, 8) = 1;
  TetMesh mesh;
  add_block(mesh, {1.5, 1.5, 1.5}, 6.52, 3);
  TetMesh with_another = mesh;
  add_block(mesh, {8.05, 8.05, 8.05}, 0.1, 1);
  EXPECT_FALSE(compare(field, mesh).has("component.unmatched"));
  add_block(with_another, {10, 10, 10}, 0.5, 1);
  EXPECT_TRUE(compare(field, with_another).has("component.unmatched"));
}

TEST(CompareParts, IslandInACavityIsFound) {
  Field field;
  field.fill(2, 8);
  std::vector<std::array<int, 3>> cavity;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        field.at(4 + i, 4 + j, 4 + k) = -1;
        cavity.push_back({2 + i, 2 + j, 2 + k});
      }
    }
  }
  field.at(5, 5, 5) = 1;
  TetMesh mesh;
  add_block(mesh, {1.5, 1.5, 1.5}, 7, 7, cavity);
  add_block(mesh, {4.88, 4.88, 4.88}, 0.2, 1);
  EXPECT_TRUE(compare(field, mesh).with.findings.empty());
}

TEST(CompareParts, NothingIsCalledMissingWhereTheMeshHasAsManyComponents) {
  Field field;
  field.at(3, 3, 3) = 1;
  TetMesh mesh;  // one component, beside the voxel, with a cavity that the field has not
  add_block(mesh, {3.02, 3.02, 3.02}, 0.3, 3, {{1, 1, 1}});
  const Compared found = compare(field, mesh);
  EXPECT_TRUE(found.has("cavity.extra"));
  EXPECT_FALSE(found.has("component.missing"));
  EXPECT_FALSE(found.has("component.unmatched"));
}

}  // namespace
}  // namespace scantet::verify
