#include "scantet/quality/orientation.h"

#include <gtest/gtest.h>

#include <random>

namespace scantet {
namespace {

__extension__ typedef __int128 Int128;

// Coordinates are integers below 2^38: the determinant fits in 128 bits.
int integer_sign(const Point& a, const Point& b, const Point& c, const Point& d) {
  Int128 m[3][3];
  const Point ends[3] = {b, c, d};
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      m[i][axis] = static_cast<Int128>(ends[i][axis]) - static_cast<Int128>(a[axis]);
    }
  }
  const Int128 det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) +
                     m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
                     m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return det > 0 ? 1 : det < 0 ? -1 : 0;
}

TEST(Orientation, AgreesWithIntegersNearAPlane) {
  std::mt19937_64 random(11);
  std::uniform_int_distribution<std::int64_t> coordinate(0, std::int64_t{1} << 34);
  std::uniform_int_distribution<int> small(-3, 3);
  const auto point = [&] {
    return Point{static_cast<double>(coordinate(random)), static_cast<double>(coordinate(random)),
                 static_cast<double>(coordinate(random))};
  };
  int signs[3] = {0, 0, 0};
  for (int i = 0; i < 20000; ++i) {
    const Point a = point();
    const Point b = point();
    const Point c = point();
    Point d = a + small(random) * (b - a) + small(random) * (c - a);
    if (i % 3 != 0) d = d + Vec{small(random) / 3 * 1.0, small(random) / 3 * 1.0, small(random) / 3 * 1.0};
    const int expected = integer_sign(a, b, c, d);
    ++signs[expected + 1];
    ASSERT_EQ(orientation_sign(a, b, c, d), expected) << i;
    ASSERT_EQ(orientation_sign(b, a, c, d), -expected) << i;
  }
  for (int count : signs) EXPECT_GT(count, 1000);
}

TEST(Orientation, OneUlpOffAPlaneCounts) {
  const Point a{0.1, 0.7, 0.3};
  const Point b{1.1, 0.9, 0.3};
  const Point c{0.4, 1.7, 0.3};
  const Point d{13.7, 12.9, 0.3};
  EXPECT_EQ(orientation_sign(a, b, c, d), 0);
  EXPECT_EQ(orientation_sign(a, b, c, {d.x, d.y, std::nextafter(0.3, 1)}), 1);
  EXPECT_EQ(orientation_sign(a, b, c, {d.x, d.y, std::nextafter(0.3, 0)}), -1);
}

TEST(Orientation, PositiveIsAsTetMeshDefinesIt) {
  EXPECT_EQ(orientation_sign({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
  EXPECT_EQ(orientation_sign({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}), -1);
}

}  // namespace
}  // namespace scantet
