// The predicates against determinants of whole numbers, which 64 bits hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>

#include "scantet/delaunay/predicates_impl.h"

namespace scantet::engine {
namespace {

using Whole = std::array<std::int64_t, 3>;

Point as_point(const Whole& p) {
  return {double(p[0]), double(p[1]), double(p[2])};
}

Whole plus(const Whole& a, const Whole& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

Whole minus(const Whole& a, const Whole& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

std::int64_t determinant(const Whole& a, const Whole& b, const Whole& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

int sign_of(std::int64_t n) {
  return n > 0 ? 1 : n < 0 ? -1 : 0;
}

int whole_orientation(const std::array<Whole, 4>& p) {
  return sign_of(determinant(minus(p[1], p[0]), minus(p[2], p[0]), minus(p[3], p[0])));
}

/// Of the five points lifted by these heights into a fourth dimension: positive if q lies below the others' hyperplane,
/// for a tet that is positively oriented.
std::int64_t lifted(const std::array<Whole, 5>& p, const std::array<std::int64_t, 5>& height) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {  // the barycentric coordinates of q = p[4], times the tet's volume
    std::array<Whole, 4> replaced{p[0], p[1], p[2], p[3]};
    replaced[i] = p[4];
    const std::int64_t share =
        determinant(minus(replaced[1], replaced[0]), minus(replaced[2], replaced[0]), minus(replaced[3], replaced[0]));
    sum += share * (height[i] - height[4]);
  }
  return sum;
}

/// What exact_in_sphere() is to say: with squares for heights and, if that does not decide, with small lifts.
bool whole_in_sphere(const std::array<Whole, 5>& p) {
  std::array<std::int64_t, 5> squares{};
  std::array<std::int64_t, 5> lifts{};
  for (std::size_t i = 0; i < 5; ++i) {
    squares[i] = p[i][0] * p[i][0] + p[i][1] * p[i][1] + p[i][2] * p[i][2];
    const auto earlier = std::count_if(p.begin(), p.end(), [&](const Whole& other) { return other < p[i]; });
    lifts[i] = std::int64_t{1} << (10 * earlier);  // determinants of such points are far below 1024
  }
  const std::int64_t certain = lifted(p, squares);
  return certain != 0 ? certain > 0 : lifted(p, lifts) > 0;
}

class Predicates : public testing::Test {
 protected:
  Whole whole(std::int64_t least, std::int64_t most) {
    std::uniform_int_distribution<std::int64_t> number(least, most);
    return {number(random_), number(random_), number(random_)};
  }
  /// Positively oriented, of small numbers.
  std::array<Whole, 4> tet() {
    while (true) {
      const std::array<Whole, 4> p{whole(0, 3), whole(0, 3), whole(0, 3), whole(0, 3)};
      if (whole_orientation(p) > 0) return p;
    }
  }

  std::mt19937 random_{1};
};

TEST_F(Predicates, OrientationOfSmallNumbersIsExact) {
  int flat = 0;
  for (int i = 0; i < 5000; ++i) {
    const std::array<Whole, 4> p{whole(0, 3), whole(0, 3), whole(0, 3), whole(0, 3)};
    const int expected = whole_orientation(p);
    flat += expected == 0 ? 1 : 0;
    EXPECT_EQ(exact_orientation(as_point(p[0]), as_point(p[1]), as_point(p[2]), as_point(p[3])), expected);
    EXPECT_EQ(orientation(as_point(p[0]), as_point(p[1]), as_point(p[2]), as_point(p[3])), expected);
  }
  EXPECT_GT(flat, 100);
}

TEST_F(Predicates, OrientationOfNearlyFlatTetsIsExact) {
  // Determinants from -2 to 2, of products so large that doubles do not hold their last digits.
  constexpr double kTiny = 0x1p-365;  // such products of three underflow
  const auto tiny = [](const Whole& p) { return Point{} + kTiny * (as_point(p) - Point{}); };
  for (int i = 0; i < 5000; ++i) {
    Whole b{1, 0, 0};
    Whole c{0, 1, 0};
    while (std::max({b[0], b[1], c[0], c[1]}) < 1 << 18) {  // b and c keep a determinant of 1 in the first two
      Whole& longer = random_() % 2 == 0 ? b : c;
      longer = plus(b, c);
    }
    b[2] = whole(0, 1 << 18)[0];
    c[2] = whole(0, 1 << 18)[0];
    Whole d = plus(b, plus(c, i % 7 < 3 ? b : c));
    const int expected = sign_of(i % 5 - 2);
    d[2] += i % 5 - 2;
    const Whole a = whole(0, 1 << 17);
    for (Whole* p : {&b, &c, &d}) *p = plus(a, *p);
    ASSERT_EQ(whole_orientation({a, b, c, d}), expected);
    EXPECT_EQ(orientation(as_point(a), as_point(b), as_point(c), as_point(d)), expected);
    EXPECT_EQ(orientation(as_point(b), as_point(a), as_point(c), as_point(d)), -expected);
    EXPECT_EQ(orientation(tiny(a), tiny(b), tiny(c), tiny(d)), expected);
  }
}

TEST_F(Predicates, InSphereIsThatOfLiftedPoints) {
  int on_sphere = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::array<Whole, 4> t = tet();
    const Whole q = whole(0, 3);
    if (std::find(t.begin(), t.end(), q) != t.end()) continue;
    const std::array<Whole, 5> five{t[0], t[1], t[2], t[3], q};
    std::array<std::int64_t, 5> squares{};
    for (std::size_t k = 0; k < 5; ++k) {
      squares[k] = five[k][0] * five[k][0] + five[k][1] * five[k][1] + five[k][2] * five[k][2];
    }
    on_sphere += lifted(five, squares) == 0 ? 1 : 0;
    EXPECT_EQ(exact_in_sphere({as_point(t[0]), as_point(t[1]), as_point(t[2]), as_point(t[3])}, as_point(q)),
              whole_in_sphere(five));
  }
  EXPECT_GT(on_sphere, 500);
}

TEST_F(Predicates, InSphereOfACubeIsConsistent) {
  // Of two neighbouring tets with all points on one sphere, each contains the other's far vertex or neither does.
  const Point o{0, 0, 0};
  const Point x{1, 0, 0};
  const Point y{0, 1, 0};
  const Point z{0, 0, 1};
  const Point xyz{1, 1, 1};
  ASSERT_GT(exact_orientation(o, x, y, z), 0);
  ASSERT_GT(exact_orientation(x, xyz, y, z), 0);
  EXPECT_EQ(exact_in_sphere({o, x, y, z}, xyz), exact_in_sphere({x, xyz, y, z}, o));
}

}  // namespace
}  // namespace scantet::engine
