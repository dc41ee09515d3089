#include "scantet/domain/cone_tree.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace scantet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class ConeTreeTest : public ::testing::Test {
 protected:
  Point point() { return {place_(random_), place_(random_), place_(random_)}; }
  std::vector<Cone> cones(std::size_t count) {
    std::vector<Cone> all;
    for (std::size_t i = 0; i < count; ++i) all.push_back({point(), height_(random_)});
    return all;
  }
  static double least(const std::vector<Cone>& cones, const Point& p, double flat_mm) {
    double value = kInfinity;
    for (const Cone& c : cones) value = std::min(value, c.height_mm + std::max(distance(p, c.apex) - flat_mm, 0.0));
    return value;
  }
  std::mt19937 random_{3};
  std::uniform_real_distribution<double> place_{-10, 10};
  std::uniform_real_distribution<double> height_{0, 8};
};

TEST_F(ConeTreeTest, FindsTheLowestToTheLastBit) {
  for (const double flat_mm : {0.0, 1.5}) {
    const std::vector<Cone> all = cones(500);
    const ConeTree tree(all, flat_mm);
    for (int i = 0; i < 2000; ++i) {
      const Point p = 1.5 * point();
      const ConeTree::Lowest lowest = tree.lowest_at(p, kInfinity);
      ASSERT_NE(lowest.cone, nullptr);
      EXPECT_EQ(lowest.value_mm, least(all, p, flat_mm));
    }
  }
}

TEST_F(ConeTreeTest, IsBoundedByTheBound) {
  const ConeTree tree({{{0, 0, 0}, 1}});
  EXPECT_EQ(tree.lowest_at({2, 0, 0}, 2.5).value_mm, 2.5);
  EXPECT_EQ(tree.lowest_at({2, 0, 0}, 2.5).cone, nullptr);
  EXPECT_EQ(tree.lowest_at({2, 0, 0}, 3.5).value_mm, 3);
  EXPECT_EQ(ConeTree().lowest_at({0, 0, 0}, 7).value_mm, 7);
}

TEST_F(ConeTreeTest, SlackIsAllThatTheAnswerIsTooHigh) {
  const std::vector<Cone> all = cones(500);
  const ConeTree tree(all);
  for (int i = 0; i < 2000; ++i) {
    const Point p = point();
    const double exact = least(all, p, 0);
    const double found = tree.lowest_at(p, kInfinity, 0.1).value_mm;
    EXPECT_GE(found, exact);
    EXPECT_LE(found, 1.1 * exact * (1 + 1e-12));
  }
}

}  // namespace
}  // namespace scantet
