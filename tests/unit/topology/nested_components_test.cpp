// A figure whose components are known: a large ball at the lower level, in it two at the upper one, one with a core
// between the levels and one with a core below both.
#include "scantet/topology/nested_components.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "scantet/base/union_find.h"
#include "scantet/image/level_set.h"
#include "scantet/image/nested_level_sets.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

constexpr int kSide = 33;
constexpr double kLower = 20;
constexpr double kUpper = 40;

double value_at(double x, double y, double z) {
  const auto step = [](double depth) { return std::clamp(0.5 + 0.5 * depth, 0.0, 1.0); };  // two voxels wide
  const double in_a = step(4.5 - std::hypot(x + 6.1, y, z)) - 0.9 * step(2 - std::hypot(x + 6.1, y, z));
  const double in_b =
      step(5 - std::hypot(x - 5.9, y + 0.2, z)) * (60 - 30) - 60 * step(2.6 - std::hypot(x - 5.9, y + 0.2, z));
  return 30 * step(14 - std::hypot(x, y, z)) + 30 * in_a + in_b;
}

class NestedComponents : public testing::Test {
 protected:
  NestedComponents()
      : scan_(test::scan_of_function<float>(
            {kSide, kSide, kSide}, [](int i, int j, int k) { return value_at(i - 16, j - 16, k - 16); },
            Frame({Vec{0.5, 0, 0}, Vec{0, 0.5, 0}, Vec{0, 0, 0.5}}, {-8, -8, -8}))),
        nested_(make_nested_level_sets(scan_, {{kLower, kUpper}, InsideSide::above, {}})) {
    for (const double level : {kLower, kUpper})
      levels_.push_back(make_level_set(scan_, {level, InsideSide::above, {}}));
    components_ = nested_components(*nested_, levels_);
  }
  Region region_of(int i, int j, int k) const {
    const double value = value_at(i - 16, j - 16, k - 16);
    return value > kUpper ? 2 : value > kLower ? 1 : 0;
  }
  /// Nodes of the component of nodes that has the one nearest to p.
  std::size_t nodes_around(const Point& p) const {
    const auto id = [](int i, int j, int k) { return static_cast<std::uint32_t>((k * kSide + j) * kSide + i); };
    UnionFind sets(std::size_t{kSide} * kSide * kSide);
    const auto join = [&](std::array<int, 3> a, int axis) {
      std::array<int, 3> b = a;
      if (--b[static_cast<std::size_t>(axis)] < 0 || region_of(a[0], a[1], a[2]) != region_of(b[0], b[1], b[2])) return;
      sets.unite(id(a[0], a[1], a[2]), id(b[0], b[1], b[2]));
    };
    for (std::uint32_t n = 0; n < sets.size(); ++n) {
      for (int axis = 0; axis < 3; ++axis) {
        join({static_cast<int>(n % kSide), static_cast<int>(n / kSide % kSide), static_cast<int>(n / kSide / kSide)},
             axis);
      }
    }
    const Vec index = scan_.frame.to_index(p);
    const std::uint32_t own = id(int(std::lround(index.x)), int(std::lround(index.y)), int(std::lround(index.z)));
    std::size_t count = 0;
    for (std::uint32_t n = 0; n < sets.size(); ++n) count += sets.find(n) == sets.find(own) ? 1 : 0;
    return count;
  }

  Scan scan_;
  std::unique_ptr<Domain> nested_;
  std::vector<std::unique_ptr<Domain>> levels_;
  std::vector<Component> components_;
};

TEST_F(NestedComponents, AreAllListedRegionByRegion) {
  std::vector<Region> regions;
  for (const Component& component : components_) regions.push_back(component.region);
  // The space between, the core of the one ball, the wall around the core of the other; the balls; the cavity.
  EXPECT_EQ(regions, (std::vector<Region>{1, 1, 1, 2, 2, kOutside}));
}

TEST_F(NestedComponents, WitnessesAreInTheirComponents) {
  const Point middle_a{-3.05, 0, 0};
  const Point middle_b{2.95, -0.1, 0};
  std::multiset<std::string> places;
  for (const Component& component : components_) {
    EXPECT_EQ(nested_->region_at(component.witness), component.region);
    const double to_a = distance(component.witness, middle_a);
    const double to_b = distance(component.witness, middle_b);
    const std::string around = to_a < 2.3 ? "a" : to_b < 2.6 ? "b" : "both";
    places.insert(std::to_string(component.region) + (std::min(to_a, to_b) < 1.6 ? " in " : " of ") + around);
  }
  EXPECT_EQ(places, (std::multiset<std::string>{"0 in b", "1 in a", "1 in b", "1 of both", "2 of a", "2 of b"}));
}

TEST_F(NestedComponents, VolumesAreThoseOfTheirNodes) {
  const double voxel_mm3 = 0.125;
  std::array<double, 3> nodes{};
  for (int n = 0; n < kSide * kSide * kSide; ++n) {
    ++nodes[static_cast<std::size_t>(region_of(n % kSide, n / kSide % kSide, n / kSide / kSide))];
  }
  std::array<double, 3> volume{};
  for (const Component& component : components_) {
    volume[static_cast<std::size_t>(component.region)] += component.volume_mm3;
    if (component.region != kOutside && component.volume_mm3 > 1e3 * voxel_mm3) {
      const double own = voxel_mm3 * static_cast<double>(nodes_around(component.witness));
      EXPECT_NEAR(component.volume_mm3, own, 1e-9);
    }
  }
  EXPECT_NEAR(volume[1], voxel_mm3 * nodes[1], 1e-9);
  EXPECT_NEAR(volume[2], voxel_mm3 * nodes[2], 1e-9);
}

TEST_F(NestedComponents, OfOneLevelAreItsOwn) {
  const std::span<const std::unique_ptr<Domain>> outermost(levels_.data(), 1);
  const std::vector<Component> listed = nested_components(*levels_[0], outermost);
  const std::vector<Component> own = levels_[0]->components();
  ASSERT_EQ(listed.size(), own.size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    EXPECT_EQ(listed[i].region, own[i].region);
    EXPECT_EQ(listed[i].witness, own[i].witness);
    EXPECT_EQ(listed[i].volume_mm3, own[i].volume_mm3);
  }
}

}  // namespace
}  // namespace scantet
