#include "scantet/base/trilinear.h"

#include <gtest/gtest.h>

#include <random>

namespace scantet {
namespace {

struct Random {
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator); }
  CellHeights heights() {
    CellHeights h;
    for (double& height : h) height = between(-10, 10);
    return h;
  }
  Vec place() { return {between(0, 1), between(0, 1), between(0, 1)}; }

  std::mt19937 generator{7};
};

TEST(Trilinear, MeetsTheCorners) {
  const CellHeights h = Random().heights();
  for (unsigned c = 0; c < 8; ++c) EXPECT_EQ(trilinear(h, {double(c & 1), double(c >> 1 & 1), double(c >> 2)}), h[c]);
}

TEST(Trilinear, OfAPartIsTheSameFunction) {
  Random random;
  for (int n = 0; n < 1000; ++n) {
    const CellHeights h = random.heights();
    const Vec low = 0.5 * random.place();
    const Vec high = low + 0.5 * random.place();
    const Vec u = random.place();
    const Vec size = high - low;
    const Vec in_box = low + Vec{u.x * size.x, u.y * size.y, u.z * size.z};
    EXPECT_NEAR(trilinear(heights_between(h, low, high), u), trilinear(h, in_box), 1e-12);
  }
}

TEST(Trilinear, BothSignsAreToldFromOne) {
  CellHeights h{};
  EXPECT_FALSE(has_both_signs(h));
  h[5] = 1;
  EXPECT_TRUE(has_both_signs(h));
  h.fill(1);
  EXPECT_FALSE(has_both_signs(h));
}

TEST(AffineBounds, HoldEverywhereAndAreReachedByTheProductOfAll) {
  Random random;
  for (int n = 0; n < 1000; ++n) {
    const CellHeights h = random.heights();
    const AffineBounds bounds(h);
    EXPECT_NEAR(bounds.mean(), trilinear(h, {0.5, 0.5, 0.5}), 1e-12);
    for (int i = 0; i < 20; ++i) {
      const Vec u = random.place();
      EXPECT_LE(std::abs(trilinear(h, u) - bounds.affine_at(u)), bounds.bent() + 1e-12);
    }
  }
  const AffineBounds product(CellHeights{-1, 1, 1, -1, 1, -1, -1, 1});
  EXPECT_EQ(product.bent(), 1);
  EXPECT_EQ(product.slope(), Vec{});
}

TEST(AffineBounds, OfAnAffineFunctionAreTheFunction) {
  const AffineBounds bounds(CellHeights{0, 2, 4, 6, 8, 10, 12, 14});
  EXPECT_EQ(bounds.bent(), 0);
  EXPECT_EQ(bounds.slope(), (Vec{1, 2, 4}));
  EXPECT_EQ(bounds.affine_at({1, 0, 1}), 10);
  EXPECT_EQ(bounds.affine_at({2, 2, 2}), 28) << "beyond the box, too";
}

}  // namespace
}  // namespace scantet
