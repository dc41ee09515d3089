// Joins in a cell against flood fills of ever finer samples of it, and against cells whose answer is known.
#include "scantet/topology/trilinear_saddles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace scantet {
namespace {

/// For each corner the smallest corner of its group.
using Groups = std::array<int, 8>;

void merge(Groups& groups, int a, int b) {
  const int low = std::min(groups[a], groups[b]);
  const int high = std::max(groups[a], groups[b]);
  std::replace(groups.begin(), groups.end(), high, low);
}

Groups groups_by_edges(const CellHeights& h) {
  Groups groups;
  std::iota(groups.begin(), groups.end(), 0);
  for (int c = 0; c < 8; ++c) {
    for (int bit : {1, 2, 4}) {
      if ((h[c] > 0) == (h[c ^ bit] > 0)) merge(groups, c, c ^ bit);
    }
  }
  return groups;
}

Groups groups_without_body(const CellHeights& h) {
  Groups groups = groups_by_edges(h);
  for (int axis = 0; axis < 3; ++axis) {
    for (int side : {0, 1 << axis}) {
      CellHeights turned;  // with that face for its low one
      for (int c = 0; c < 8; ++c) turned[c] = h[c ^ side];
      const std::array<int, 4> f = low_face(axis);
      const std::array<double, 4> g{turned[f[0]], turned[f[1]], turned[f[2]], turned[f[3]]};
      if ((g[0] > 0) != (g[3] > 0) || (g[1] > 0) != (g[2] > 0) || (g[0] > 0) == (g[1] > 0)) continue;
      if (const auto joined = low_face_join(turned, axis)) merge(groups, (*joined)[0] ^ side, (*joined)[1] ^ side);
    }
  }
  std::array<std::array<int, 2>, 6> joins;
  for (int n = line_joins(h, joins) - 1; n >= 0; --n) merge(groups, joins[n][0], joins[n][1]);
  return groups;
}

Groups groups_of(const CellHeights& h) {
  Groups groups = groups_without_body(h);
  if (const auto joined = body_join(h)) {
    EXPECT_EQ(h[(*joined)[0]] > 0, h[(*joined)[1]] > 0);
    merge(groups, (*joined)[0], (*joined)[1]);
  }
  return groups;
}

/// Corners joined by samples of one sign, n to an edge. Every join is real, as the function is linear between
/// neighbours along an axis; thin ones need a large n.
Groups groups_by_flood(const CellHeights& h, int n) {
  const int m = n + 1;
  const auto at = [m](int i, int j, int k) { return (k * m + j) * m + i; };
  std::vector<char> inside(m * m * m);
  for (int k = 0; k < m; ++k) {
    for (int j = 0; j < m; ++j) {
      for (int i = 0; i < m; ++i)
        inside[at(i, j, k)] = trilinear(h, (1.0 / n) * Vec{double(i), double(j), double(k)}) > 0;
    }
  }
  Groups groups;
  groups.fill(-1);
  std::vector<char> seen(inside.size());
  for (int c = 0; c < 8; ++c) {
    if (groups[c] >= 0) continue;
    std::vector<std::array<int, 3>> stack{{n * (c & 1), n * (c >> 1 & 1), n * (c >> 2)}};
    seen[at(stack[0][0], stack[0][1], stack[0][2])] = 1;
    while (!stack.empty()) {
      const std::array<int, 3> p = stack.back();
      stack.pop_back();
      if (p[0] % n == 0 && p[1] % n == 0 && p[2] % n == 0) groups[(p[0] > 0) | (p[1] > 0) << 1 | (p[2] > 0) << 2] = c;
      for (int axis = 0; axis < 3; ++axis) {
        for (int step : {-1, 1}) {
          std::array<int, 3> q = p;
          q[axis] += step;
          if (q[axis] < 0 || q[axis] > n) continue;
          const int to = at(q[0], q[1], q[2]);
          if (seen[to] || inside[to] != inside[at(p[0], p[1], p[2])]) continue;
          seen[to] = 1;
          stack.push_back(q);
        }
      }
    }
  }
  return groups;
}

/// True if corners that `fine` joins are joined by `coarse` too.
bool refines(const Groups& fine, const Groups& coarse) {
  for (int c = 0; c < 8; ++c) {
    if (coarse[c] != coarse[fine[c]]) return false;
  }
  return true;
}

int count_groups(const CellHeights& h, const Groups& groups, bool inside) {
  int count = 0;
  for (int c = 0; c < 8; ++c) count += groups[c] == c && (h[c] > 0) == inside;
  return count;
}

void expect_counts(const CellHeights& h, int inside, int outside) {
  const Groups groups = groups_of(h);
  EXPECT_EQ(count_groups(h, groups, true), inside);
  EXPECT_EQ(count_groups(h, groups, false), outside);
}

CellHeights random_cell(std::mt19937& random) {
  CellHeights h;
  for (double& value : h) value = std::uniform_real_distribution<double>(-1, 1)(random);
  return h;
}

CellHeights integer_cell(std::mt19937& random) {
  CellHeights h;
  for (double& value : h) value = std::uniform_int_distribution<int>(-3, 3)(random);
  return h;
}

/// Inside at the two ends of a body diagonal, with heights about `thin` times those of the others: the tunnel between
/// them decides.
CellHeights tunnel_cell(std::mt19937& random, double thin) {
  CellHeights h;
  for (double& value : h) value = -std::uniform_real_distribution<double>(0.01, 1)(random) * thin;
  h[0] = std::uniform_real_distribution<double>(0.5, 1)(random);
  h[7] = std::uniform_real_distribution<double>(0.5, 1)(random);
  return h;
}

CellHeights permuted(const CellHeights& h, const std::array<int, 3>& axes) {
  CellHeights out;
  for (int c = 0; c < 8; ++c) {
    int to = 0;
    for (int axis = 0; axis < 3; ++axis) to |= (c >> axis & 1) << axes[axis];
    out[to] = h[c];
  }
  return out;
}

CellHeights negated(CellHeights h) {
  for (double& value : h) value = -value;
  return h;
}

TEST(TrilinearSaddles, OpenQuestionsOfKnownPatterns) {
  EXPECT_EQ(open_questions(0b00000000), 0);
  EXPECT_EQ(open_questions(0b11111111), 0);
  EXPECT_EQ(open_questions(0b00000001), 0);
  EXPECT_EQ(open_questions(0b00001111), 0);
  EXPECT_EQ(open_questions(0b10000001), kBodyOpen);              // ends of a body diagonal
  EXPECT_EQ(open_questions(0b01111110), kBodyOpen);              // the same outside
  EXPECT_EQ(open_questions(0b00001001), 4 | kBodyOpen);          // ends of a diagonal of the low z face
  EXPECT_EQ(open_questions(0b10010000), kBodyOpen);              // of the high z face: the next cell's question
  EXPECT_EQ(open_questions(0b01101001), 1 | 2 | 4 | kBodyOpen);  // every other corner
}

TEST(TrilinearSaddles, JoinsAreThoseOfFloodFill) {
  std::mt19937 random(7);
  int body_joins = 0;
  int unresolved = 0;
  const int cells = 3000;
  for (int n = 0; n < cells; ++n) {
    CellHeights h = n % 3 == 0 ? random_cell(random) : tunnel_cell(random, n % 3 == 1 ? 0.5 : 1.0);
    if (n % 2 == 1) h = negated(h);
    const Groups groups = groups_of(h);
    body_joins += groups != groups_without_body(h);
    bool resolved = false;
    for (int samples = 8; samples <= 64 && !resolved; samples *= 2) {
      const Groups flood = groups_by_flood(h, samples);
      ASSERT_TRUE(refines(flood, groups)) << "cell " << n << ", " << samples << " samples";
      resolved = flood == groups;
    }
    unresolved += !resolved;
  }
  EXPECT_GT(body_joins, cells / 20);
  EXPECT_LE(unresolved, cells / 300) << "joins thinner than 1/64 of the cell are rare";
}

/// The groups of one side, each other corner by itself.
Groups of_side(const CellHeights& h, Groups groups, bool inside) {
  for (int c = 0; c < 8; ++c) {
    if ((h[c] > 0) != inside) groups[c] = c;
  }
  return groups;
}

TEST(TrilinearSaddles, TiesJoinWhatIsAboveAsALevelRaisedAndWhatIsBelowAsALevelLoweredButForLines) {
  std::mt19937 random(8);
  int ties = 0;
  int lines = 0;
  for (int n = 0; n < 40000; ++n) {
    const CellHeights h = integer_cell(random);
    if (std::find(h.begin(), h.end(), 0.0) != h.end()) continue;
    CellHeights raised = h;
    CellHeights lowered = h;
    for (double& value : raised) value -= 1e-7;
    for (double& value : lowered) value += 1e-7;
    const Groups groups = groups_of(h);
    ASSERT_EQ(of_side(h, groups, true), of_side(h, groups_of(raised), true)) << "cell " << n;
    ASSERT_TRUE(refines(of_side(h, groups_of(lowered), false), of_side(h, groups, false))) << "cell " << n;
    ASSERT_TRUE(refines(of_side(h, groups, false), of_side(h, groups_of(raised), false))) << "cell " << n;
    ties += groups_of(raised) != groups_of(lowered);
    lines += of_side(h, groups, false) != of_side(h, groups_of(lowered), false);
    if (n < 500) {
      const Groups flood = groups_by_flood(h, 16);
      ASSERT_TRUE(refines(of_side(h, flood, true), of_side(h, groups, true))) << "cell " << n;
    }
  }
  EXPECT_GT(ties, 1000);
  EXPECT_GT(lines, 10);
  EXPECT_LT(lines, ties / 2);
}

TEST(TrilinearSaddles, JoinsDoNotDependOnTheAxes) {
  std::mt19937 random(9);
  for (int n = 0; n < 20000; ++n) {
    const CellHeights h = n % 2 == 0 ? random_cell(random) : tunnel_cell(random, 1.0);
    const Groups groups = groups_of(h);
    std::array<int, 3> axes{0, 1, 2};
    while (std::next_permutation(axes.begin(), axes.end())) {
      const CellHeights turned = permuted(h, axes);
      const Groups other = groups_of(turned);
      for (bool inside : {false, true}) {
        ASSERT_EQ(count_groups(h, groups, inside), count_groups(turned, other, inside)) << "cell " << n;
      }
    }
    ASSERT_EQ(groups, groups_of(negated(h))) << "cell " << n;
  }
}

TEST(TrilinearSaddles, BodyJoinSurvivesAnyScale) {
  for (double scale : {1e-200, 1.0, 1e200}) {
    CellHeights h;
    h.fill(-0.2 * scale);
    h[0] = h[7] = scale;
    EXPECT_TRUE(body_join(h).has_value()) << scale;
    for (int c = 1; c < 7; ++c) h[c] = -0.5 * scale;
    EXPECT_FALSE(body_join(h).has_value()) << scale;
  }
}

TEST(TrilinearSaddles, LinesThroughACellJoinWhatIsBelow) {
  const auto joins_of = [](const CellHeights& h) {  // as masks
    std::array<std::array<int, 2>, 6> joins;
    std::set<unsigned> found;
    for (int n = line_joins(h, joins) - 1; n >= 0; --n) found.insert(1U << joins[n][0] | 1U << joins[n][1]);
    return found;
  };
  using Joins = std::set<unsigned>;
  EXPECT_EQ(joins_of({1, -1, -1, 1, 1, -1, -1, 1}), (Joins{0x06})) << "straight through";
  EXPECT_EQ(joins_of({0, 0, 1, -1, -1, 1, 1, -1}), (Joins{0x18})) << "from a face to an edge at the level";
  EXPECT_EQ(joins_of({1, -3, -1, 3, 3, -1, -3, 1}), (Joins{0x06, 0x42})) << "beside an edge that joins 2 and 6";
  EXPECT_EQ(joins_of({2, -1, -1, 2, 2, -1, -1, 2}), Joins{}) << "the saddles are above";
  EXPECT_EQ(joins_of({1, -1, -1, 1, 2, -1, -1, 1}), Joins{}) << "only one of them is at the level";
}

// The cases of the extended marching-cubes table whose answer can be worked out by hand.

TEST(TrilinearSaddles, BodyDiagonalWithAndWithoutTunnel) {
  // On the diagonal f = (1-t)³p + t³p - 3t(1-t)q, least in the middle: (p - 3q)/4.
  const auto cell = [](double p, double q) { return CellHeights{p, -q, -q, -q, -q, -q, -q, p}; };
  expect_counts(cell(1, 0.3), 1, 1);
  expect_counts(cell(1, 0.4), 2, 1);
  expect_counts(cell(3, 1), 2, 1);  // the saddle is at the level: apart
  expect_counts(negated(cell(1, 0.3)), 1, 1);
  expect_counts(negated(cell(1, 0.4)), 1, 2);
  expect_counts(negated(cell(3, 1)), 1, 2);  // apart, too
}

TEST(TrilinearSaddles, FaceDiagonalOfEitherKind) {
  const auto cell = [](double p, double q) { return CellHeights{p, -q, -q, p, -9, -9, -9, -9}; };
  expect_counts(cell(2, 1), 1, 1);
  expect_counts(cell(1, 2), 2, 1);
  expect_counts(cell(1, 1), 2, 1);
}

TEST(TrilinearSaddles, OppositeEdges) {
  const auto cell = [](double p, double q) { return CellHeights{p, p, -q, -q, -q, -q, p, p}; };
  expect_counts(cell(2, 1), 1, 2);
  expect_counts(cell(1, 2), 2, 1);
  expect_counts(cell(1, 1), 2, 1);
  // Neither end face joins the inside, the middle does: the product of 3 … 0.1 and 0.1 … 3 is largest there.
  const CellHeights waist{3, 0.1, -1, -1, -1, -1, 0.1, 3};
  EXPECT_EQ(count_groups(waist, groups_without_body(waist), true), 2);
  expect_counts(waist, 1, 1);
}

TEST(TrilinearSaddles, EveryOtherCorner) {
  const auto cell = [](double p, double q) { return CellHeights{p, -q, -q, p, -q, p, p, -q}; };
  expect_counts(cell(2, 1), 1, 4);
  expect_counts(cell(1, 2), 4, 1);
  expect_counts(cell(1, 1), 4, 1);
}

TEST(TrilinearSaddles, FaceSaddleIsWhereTheBilinearFunctionIsFlat) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> high(0.1, 1);
  for (int n = 0; n < 100; ++n) {
    const std::array<double, 4> h{high(random), -high(random), -high(random), high(random)};
    const FaceSaddle saddle = face_saddle(h);
    EXPECT_NEAR(saddle.at_its_place(h), saddle.value, 1e-12);
    EXPECT_NEAR(mix(h[0], h[1], saddle.u), mix(h[2], h[3], saddle.u), 1e-12) << "flat along the second axis";
    EXPECT_NEAR(mix(h[0], h[2], saddle.v), mix(h[1], h[3], saddle.v), 1e-12) << "flat along the first axis";
    EXPECT_GT(saddle.twist, 0);
    const Vec place = saddle.index({5, 6, 7}, 1);
    EXPECT_EQ(place.y, 6);
    EXPECT_EQ(place.x, 5 + saddle.u);
    EXPECT_EQ(place.z, 7 + saddle.v);
  }
}

TEST(TrilinearSaddles, NodesOfTheLowFaceAreThoseOfItsCorners) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int n = 0; n < 4; ++n) {
      const int corner = low_face(axis)[static_cast<std::size_t>(n)];
      std::array<int, 3> node{1 + (corner & 1), 2 + (corner >> 1 & 1), 3 + (corner >> 2)};
      EXPECT_EQ(low_face_node({1, 2, 3}, axis, n, 0), node);
      --node[static_cast<std::size_t>(axis)];
      EXPECT_EQ(low_face_node({1, 2, 3}, axis, n, -1), node);
    }
  }
}

TEST(TrilinearSaddles, BodySaddlesOfKnownFunctions) {
  const auto sample = [](auto f) {
    CellHeights h;
    for (int c = 0; c < 8; ++c) h[c] = f(double(c & 1), double(c >> 1 & 1), double(c >> 2));
    return h;
  };
  std::array<Saddle, 2> found;
  const auto one = [](double x, double y, double z) {
    const double u = x - 0.3;
    const double v = y - 0.4;
    const double w = z - 0.6;
    return 0.25 + 2 * u * v - 3 * v * w + u * w;
  };
  ASSERT_EQ(body_saddles(sample(one), found), 1);
  EXPECT_NEAR(distance(found[0].position, {0.3, 0.4, 0.6}), 0, 1e-12);
  EXPECT_NEAR(found[0].value, 0.25, 1e-12);
  EXPECT_NEAR(found[0].mixed[0], -3, 1e-12);
  EXPECT_NEAR(found[0].mixed[1], 1, 1e-12);
  EXPECT_NEAR(found[0].mixed[2], 2, 1e-12);

  const auto two = [](double x, double y, double z) {
    const double u = x - 0.5;
    const double v = y - 0.5;
    const double w = z - 0.5;
    return 100 * u * v * w - (u + v + w);
  };
  ASSERT_EQ(body_saddles(sample(two), found), 2);
  for (const Saddle& saddle : found) {
    const double side = saddle.position.x < 0.5 ? 0.4 : 0.6;
    EXPECT_NEAR(distance(saddle.position, {side, side, side}), 0, 1e-12);
  }
  EXPECT_GT(distance(found[0].position, found[1].position), 0.3);

  EXPECT_EQ(body_saddles(sample([](double x, double y, double z) { return x + 2 * y - z; }), found), 0);
  EXPECT_EQ(body_saddles(sample([](double, double, double) { return 1.0; }), found), 0);
}

TEST(TrilinearSaddles, BodySaddlesAreCriticalAndAllFoundWhateverTheAxes) {
  std::mt19937 random(10);
  int total = 0;
  for (int n = 0; n < 20000; ++n) {
    const CellHeights h = random_cell(random);
    std::array<Saddle, 2> found;
    const int count = body_saddles(h, found);
    total += count;
    for (int s = 0; s < count; ++s) {
      for (int axis = 0; axis < 3; ++axis) {
        Vec low = found[s].position;
        Vec high = low;
        low[axis] = 0;
        high[axis] = 1;
        ASSERT_NEAR(trilinear(h, high) - trilinear(h, low), 0, 1e-9);
      }
    }
    std::array<Saddle, 2> again;
    for (const std::array<int, 3>& axes : {std::array<int, 3>{1, 2, 0}, std::array<int, 3>{0, 2, 1}}) {
      ASSERT_EQ(body_saddles(permuted(h, axes), again), count);
    }
  }
  EXPECT_GT(total, 1000);
}

}  // namespace
}  // namespace scantet
