#include "scantet/topology/tie_signs.h"

#include <gtest/gtest.h>

#include <vector>

namespace scantet {
namespace {

/// Eight times the Euler number of each part with the sign q.
template <class Place>
std::vector<int> parts(const Place& place, int q) {
  std::vector<int> found;
  place.pieces(q).for_each([&](int, int eighths) { found.push_back(eighths); });
  return found;
}

/// sign_at(x, y, z): of each neighbour.
template <class SignAt>
Signs signs_of(const SignAt& sign_at) {
  Signs signs;
  for (int n = 0; n < 27; ++n) {
    const Signs::Step step{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
    signs.at(step) = n == 13 ? 0 : sign_at(step[0], step[1], step[2]);
  }
  return signs;
}

TEST(TieSigns, AroundAnEdge) {
  using List = std::vector<int>;
  const Around all{{1, 1, 1, 1}, {1, 1, 1, 1}};
  EXPECT_EQ(parts(all, 1), (List{0})) << "a circle";
  EXPECT_EQ(parts(all, -1), List{});
  const Around half{{1, 1, -1, -1}, {1, 1, -1, -1}};
  EXPECT_EQ(parts(half, 1), (List{8}));
  EXPECT_EQ(parts(half, -1), (List{8}));
  const Around crossed{{1, -1, 1, -1}, {1, 1, 1, 1}};
  EXPECT_EQ(parts(crossed, 1), (List{8, 8})) << "those above are apart";
  EXPECT_EQ(parts(crossed, -1), (List{16})) << "those below are joined";
  const Around wall{{0, 1, 0, 1}, {1, 1, 1, 1}};
  EXPECT_EQ(parts(wall, 1), (List{16})) << "two that are one through the faces between";
}

TEST(TieSigns, AroundANode) {
  using List = std::vector<int>;
  const Signs all = signs_of([](int, int, int) { return 1; });
  EXPECT_EQ(parts(all, 1), (List{16})) << "a sphere";
  const Signs half = signs_of([](int, int, int z) { return z; });
  EXPECT_EQ(parts(half, 1), (List{8})) << "two cells deep: a disk";
  EXPECT_EQ(parts(half, -1), (List{8}));
  const Signs axis = signs_of([](int x, int y, int) { return x == 0 && y == 0 ? -1 : 1; });
  EXPECT_EQ(parts(axis, 1), (List{0})) << "a ring around the two caps";
  EXPECT_EQ(parts(axis, -1), (List{8, 8})) << "they touch at the node";
}

TEST(TieSigns, FacesAtTheLevel) {
  using List = std::vector<int>;
  const Signs wall = signs_of([](int, int, int z) { return z == 0 ? 0 : 1; });
  EXPECT_EQ(parts(wall, 1), (List{16})) << "both sides are one";
  const Signs surface = signs_of([](int, int, int z) { return z; });
  EXPECT_EQ(parts(surface, 1), (List{8}));
  const Signs line = signs_of([](int x, int y, int) { return x * y; });
  EXPECT_EQ(parts(line, 1), (List{8, 8})) << "along an edge those above are apart";
  EXPECT_EQ(parts(line, -1), (List{16})) << "and those below joined";
}

}  // namespace
}  // namespace scantet
