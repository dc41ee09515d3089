// Euler numbers of level sets: shapes with a known answer, single cells by hand, noise against a fine triangulation,
// and either side of a level against the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "scantet/base/union_find.h"
#include "scantet/field/padded_grid.h"
#include "scantet/topology/level_ties.h"
#include "scantet/topology/level_topology.h"
#include "unit/image/sampled_flood.h"
#include "unit/image/test_scan.h"
#include "unit/topology/side_shares.h"

namespace scantet {
namespace {

using namespace test;

/// Of the boundary of each component, in the order of components(); a number that is none if not known.
std::vector<std::int64_t> eulers(const Scan& scan, const LevelSetSettings& settings) {
  std::vector<std::int64_t> found;
  const LevelTopology topology(scan, settings);
  for (const Component& component : topology.components()) {
    found.push_back(component.euler.value_or(-9999));
  }
  return found;
}

/// A random scan, smoothed so often by a kernel of 1 2 1 along each axis.
Scan smooth_noise(const Size& size, unsigned seed, int times) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(-1, 1);
  std::vector<float> values(static_cast<std::size_t>(size[0]) * size[1] * size[2]);
  for (float& v : values) v = value(random);
  int stride = 1;
  for (int axis = 0; axis < 3; stride *= size[axis++]) {
    for (int n = 0; n < times; ++n) {
      const std::vector<float> before = values;
      for (int i = 0; i < static_cast<int>(values.size()); ++i) {
        const int at = i / stride % size[axis];
        const float low = before[at > 0 ? i - stride : i];
        const float high = before[at + 1 < size[axis] ? i + stride : i];
        values[i] = (low + 2 * before[i] + high) / 4;
      }
    }
  }
  return scan_of(size, std::move(values));
}

/// Samples of a scan, n to a voxel, as vertices of a triangulation whose cubes are cut in six. The simplices that have
/// all their vertices above the level have the Euler number of what is above it, if n is large enough.
class FineTriangulation {
 public:
  FineTriangulation(const Scan& scan, const LevelSetSettings& settings, int n) {
    const PaddedGrid<float> grid = padded_grid(scan, std::get<const float*>(scan.voxels), settings);
    Size cells;
    for (int axis = 0; axis < 3; ++axis) {
      cells[axis] = scan.size[axis] + 1;
      size_[axis] = cells[axis] * n + 2;  // the last is beyond the grid, outside
    }
    above_.resize(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2]);
    for (int z = 0; z + 1 < size_[2]; ++z) {
      for (int y = 0; y + 1 < size_[1]; ++y) {
        for (int x = 0; x + 1 < size_[0]; ++x) {
          const Size cell{std::min(x / n, cells[0] - 1), std::min(y / n, cells[1] - 1), std::min(z / n, cells[2] - 1)};
          const Vec u{double(x) / n - cell[0], double(y) / n - cell[1], double(z) / n - cell[2]};
          above_[at(x, y, z)] = trilinear(grid.corners(cell[0] - 1, cell[1] - 1, cell[2] - 1), u) > 0;
        }
      }
    }
  }

  /// Twice the Euler number of each piece, ascending.
  std::vector<std::int64_t> eulers() const {
    UnionFind sets(static_cast<std::uint32_t>(above_.size()));
    for_each_vertex([&](std::size_t vertex, unsigned steps) {
      for (unsigned step = 1; step < 8; ++step) {
        if (steps >> step & 1) sets.unite(vertex, vertex + at(step & 1, step >> 1 & 1, step >> 2));
      }
    });
    std::map<std::uint32_t, std::int64_t> found;
    for_each_vertex([&](std::size_t vertex, unsigned steps) {
      found[sets.find(static_cast<std::uint32_t>(vertex))] += 2 * simplices(steps);
    });
    std::vector<std::int64_t> list;
    for (const auto& [set, euler] : found) list.push_back(euler);
    std::sort(list.begin(), list.end());
    return list;
  }

  /// The sum of eulers().
  std::int64_t euler() const {
    std::int64_t sum = 0;
    for_each_vertex([&](std::size_t, unsigned steps) { sum += 2 * simplices(steps); });
    return sum;
  }

 private:
  std::size_t at(int x, int y, int z) const { return (std::size_t(z) * size_[1] + y) * size_[0] + x; }

  /// Calls visit(vertex, steps) for those above: bit s of steps is set if the vertex a step s further is above, too.
  template <class Visit>
  void for_each_vertex(const Visit& visit) const {
    for (std::size_t vertex = 0; vertex + at(1, 1, 1) < above_.size(); ++vertex) {
      if (above_[vertex] == 0) continue;
      unsigned steps = 1;
      for (unsigned step = 1; step < 8; ++step) {
        steps |= unsigned{above_[vertex + at(step & 1, step >> 1 & 1, step >> 2)]} << step;
      }
      visit(vertex, steps);
    }
  }

  /// Vertices less edges plus triangles less tets, of those whose lowest vertex has such steps: their vertices are
  /// further steps, each with all of the last one's.
  static int simplices(unsigned steps) {
    static const std::array<int, 256> table = [] {
      std::array<int, 256> eulers{};
      for (unsigned s = 0; s < 256; ++s) {
        const auto follows = [s](unsigned a, unsigned b) { return a != b && (a & b) == a && (s >> b & 1) != 0; };
        eulers[s] = 1;
        for (unsigned a = 1; a < 8; ++a) {
          if (!follows(0, a)) continue;
          --eulers[s];
          for (unsigned b = 1; b < 8; ++b) {
            if (!follows(a, b)) continue;
            ++eulers[s];
            for (unsigned c = 1; c < 8; ++c) eulers[s] -= follows(b, c) ? 1 : 0;
          }
        }
      }
      return eulers;
    }();
    return table[steps];
  }

  Size size_;
  std::vector<std::uint8_t> above_;
};

/// Eight times the Euler numbers of all that is above the level and of all below it, the outside (less one) included.
std::array<std::int64_t, 2> sums_of_sides(const HeightGrid& heights) {
  std::array<std::int64_t, 2> eighths = shares_of_sides(heights);
  count_ties(heights, -1, heights.size()[2], Progress(), [&](const std::array<int, 3>& node, int share) {
    const double height = heights.height(node[0], node[1], node[2]);
    eighths[height > 0 ? 1 : 0] += share;
  });
  return {eighths[1], eighths[0]};
}

TEST(LevelEuler, Shapes) {
  const LevelSetSettings level{0, InsideSide::above, -1.0};
  const Vec c{16.2, 16.1, 15.9};
  const auto radius = [&](int i, int j, int k) { return length(Vec{i - c.x, j - c.y, k - c.z}); };
  const auto torus = [&](int i, int j, int k) { return 3 - std::hypot(std::hypot(i - c.x, j - c.y) - 9, k - c.z); };
  const auto scan = [](const auto& value) { return scan_of_function<double>({33, 33, 33}, value); };
  using List = std::vector<std::int64_t>;
  EXPECT_EQ(eulers(scan([&](int i, int j, int k) { return 8 - radius(i, j, k); }), level), (List{2}));
  EXPECT_EQ(eulers(scan(torus), level), (List{0}));
  EXPECT_EQ(eulers(scan([&](int i, int j, int k) { return 3 - std::abs(8 - radius(i, j, k)); }), level),
            (List{4, 2}));                          // two spheres around the shell, one around its cavity
  EXPECT_EQ(eulers(scan([&](int i, int j, int k) {  // a ball with a cavity of the shape of a torus
                     return std::min(14.5 - radius(i, j, k), -torus(i, j, k));
                   }),
                   level),
            (List{2, 0}));
  const auto ring = [&](double x, double y, double z) { return 2.5 - std::hypot(std::hypot(x, y) - 6, z); };
  EXPECT_EQ(eulers(scan([&](int i, int j, int k) {  // of genus two: two rings that share a stretch
                     return std::max(ring(i - 9.7, j - c.y, k - c.z), ring(i - 21.9, j - c.y, k - c.z));
                   }),
                   level),
            (List{-2}));
}

// Two nodes at the ends of a cell's body diagonal, as in TunnelThroughTheBodyOfACellJoins: a ball, or a ball with a
// tunnel through it that is no wider than a part of a cell. The scan's own border is far away from them.
TEST(LevelEuler, TunnelThroughTheBodyOfACell) {
  const auto pair = [](double sign, double q) {
    return eulers(
        scan_of_function<double>(
            {8, 8, 8}, [=](int i, int j, int k) { return sign * (i == j && j == k && (i == 3 || i == 4) ? 1 : -q); }),
        {0, InsideSide::above, -1.0});
  };
  using List = std::vector<std::int64_t>;
  EXPECT_EQ(pair(1, 0.3), (List{2}));
  EXPECT_EQ(pair(1, 0.4), (List{2, 2}));
  EXPECT_EQ(pair(-1, 0.3), (List{4, 2}));
  EXPECT_EQ(pair(-1, 0.4), (List{6, 2, 2}));
  // Channels from the two nodes to the outside: joined in the cell's body they are one, and make a ring of the block.
  const auto block = [](double q) {
    return eulers(scan_of_function<double>({6, 6, 6},
                                           [=](int i, int j, int k) {
                                             const bool low = i == 2 && j == 2 && k <= 2;
                                             const bool high = i == 3 && j == 3 && k >= 3;
                                             return low || high ? -1 : q;
                                           }),
                  {0, InsideSide::above, -1.0});
  };
  EXPECT_EQ(block(0.3), (List{0}));
  EXPECT_EQ(block(0.4), (List{2}));
}

// Nodes at the level, in a block of nodes above it: what has no width is no hole, and parts no block.
TEST(LevelEuler, NodesAtTheLevel) {
  using List = std::vector<std::int64_t>;
  const auto block = [](const auto& at_level) {
    return eulers(scan_of_function<double>({7, 7, 7},
                                           [&](int i, int j, int k) {
                                             const auto within = [](int n) { return n >= 1 && n <= 5; };
                                             if (!within(i) || !within(j) || !within(k)) return -1;
                                             return at_level(i, j, k) ? 0 : 1;
                                           }),
                  {0, InsideSide::above, -1.0});
  };
  const auto box = [&](int x, int y, int z) {
    return block(
        [=](int i, int j, int k) { return std::abs(i - 3) <= x && std::abs(j - 3) <= y && std::abs(k - 3) <= z; });
  };
  EXPECT_EQ(box(0, 0, 0), (List{2}));     // a node
  EXPECT_EQ(box(1, 0, 0), (List{2}));     // edges
  EXPECT_EQ(box(0, 2, 0), (List{2}));     // through the block from side to side
  EXPECT_EQ(box(1, 1, 0), (List{2}));     // faces
  EXPECT_EQ(box(0, 2, 2), (List{2}));     // a wall that would part the block
  EXPECT_EQ(box(1, 1, 1), (List{4, 2}));  // eight cells: a cavity
  EXPECT_EQ(box(2, 1, 1), (List{0}));     // a channel
  EXPECT_EQ(block([](int i, int j, int k) { return i == 3 || j == 3 || k == 3; }), (List{2}));
  EXPECT_EQ(block([](int i, int j, int k) { return i == j && j == k; }), (List{2}));
}

// Blocks of a mask that touch: at a corner, along an edge, both ways around.
TEST(LevelEuler, BlocksThatTouch) {
  using List = std::vector<std::int64_t>;
  const auto mask = [](bool negated, const auto& in) {
    return eulers(scan_of_function<std::uint8_t>({8, 8, 8},
                                                 [&](int i, int j, int k) {
                                                   const auto within = [](int n) { return n >= 1 && n <= 6; };
                                                   if (!within(i) || !within(j) || !within(k)) return 0;
                                                   return in(i, j, k) != negated ? 1 : 0;
                                                 }),
                  {0.5, InsideSide::above, {}});
  };
  const auto block = [](int i, int j, int k) { return i >= 2 && i <= 3 && j >= 2 && j <= 3 && k >= 2 && k <= 4; };
  const auto beside = [&](int i, int j, int k) { return block(i, j, k) || block(i - 2, j - 2, k); };
  const auto beyond = [&](int i, int j, int k) { return block(i, j, k) || block(i - 2, j - 2, k - 2); };
  EXPECT_EQ(mask(false, beside), (List{2, 2}));  // along an edge those above are apart
  EXPECT_EQ(mask(true, beside), (List{4, 2}));   // and those below are one
  EXPECT_EQ(mask(false, beyond), mask(false, beside));
  EXPECT_EQ(mask(true, beyond), mask(true, beside));
}

TEST(LevelEuler, NoiseAsInAFineTriangulation) {
  int compared = 0;
  int listed = 0;
  std::int64_t handles = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const int times = static_cast<int>(seed) % 3;
    const Scan scan = smooth_noise({6, 5, 7}, 100 + seed, times);
    const LevelSetSettings settings{(0.4 - 0.02 * seed) / (1 << 2 * times), {}, {}};
    const std::int64_t fine = FineTriangulation(scan, settings, 36).euler();
    if (fine != FineTriangulation(scan, settings, 24).euler()) continue;
    ++compared;
    std::vector<std::int64_t> found;
    std::int64_t sum = 0;
    const LevelTopology topology(scan, settings);
    for (const Component& component : topology.components()) {
      if (component.region == kOutside) continue;
      ASSERT_TRUE(component.euler.has_value());
      found.push_back(*component.euler);
      sum += found.back();
      handles += std::max<std::int64_t>(0, 2 - found.back()) / 2;
    }
    EXPECT_EQ(sum, fine);
    const FineTriangulation coarser(scan, settings, 10);
    if (coarser.euler() != fine) continue;
    ++listed;
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, coarser.eulers());
  }
  EXPECT_GT(compared, 30);
  EXPECT_GT(listed, 20);
  EXPECT_GT(handles, 50);
}

// Two cells in a block that is above the level, with a face at the level between them: the nodes across it, row by row.
TEST(LevelEuler, PartsBelowThatTouchAlongLinesInAFaceAreOne) {
  using List = std::vector<std::int64_t>;
  using Nodes = std::array<std::array<int, 2>, 2>;
  const auto block = [](const Nodes& low, const Nodes& high) {
    return eulers(scan_of_function<std::int16_t>({8, 8, 7},
                                                 [&](int i, int j, int k) {
                                                   const auto at_border = [](int n, int last) {
                                                     return n == 0 || n == last;
                                                   };
                                                   if (at_border(i, 7) || at_border(j, 7) || at_border(k, 6)) return -1;
                                                   if (i < 3 || i > 4 || j < 3 || j > 4 || k < 2 || k > 4) return 9;
                                                   return k == 3 ? 0 : (k == 2 ? low : high)[j - 3][i - 3];
                                                 }),
                  {0, InsideSide::above, -1.0});
  };
  const Nodes half{{{-2, -2}, {2, 2}}};
  const Nodes other_half{{{2, 2}, {-2, -2}}};
  const Nodes cross{{{-2, 2}, {2, -2}}};
  const Nodes other_cross{{{2, -2}, {-2, 2}}};
  const Nodes row_of_half{{{0, 0}, {-1, 1}}};
  const Nodes row_of_other{{{1, -1}, {0, 0}}};
  EXPECT_EQ(block(half, half), (List{4, 2}));
  EXPECT_EQ(block(half, other_half), (List{4, 2})) << "along one line";
  EXPECT_EQ(block(row_of_half, row_of_other), (List{4, 2})) << "along one line, each by its own slope";
  EXPECT_EQ(block(cross, cross), (List{4, 2}));
  EXPECT_EQ(block(cross, other_cross), (List{4, 2})) << "along four arms";
}

/// Whether all nodes of some cell are at the level.
bool has_void(const HeightGrid& heights) {
  const Size& size = heights.size();
  for (int k = 0; k + 1 < size[2]; ++k) {
    for (int j = 0; j + 1 < size[1]; ++j) {
      for (int i = 0; i + 1 < size[0]; ++i) {
        const CellHeights corners = heights.corners(i, j, k);
        if (std::all_of(corners.begin(), corners.end(), [](double h) { return h == 0; })) return true;
      }
    }
  }
  return false;
}

// Few whole numbers, but smooth: neighbours are often equal, and saddles at the level.
TEST(LevelEuler, IsKnownWhereSmoothNoiseIsOfWholeNumbers) {
  int compared = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Scan smooth = smooth_noise({16, 15, 17}, seed, 1 + static_cast<int>(seed) % 2);
    const auto* values = std::get<const float*>(smooth.voxels);
    const double scale = seed % 4 < 2 ? 10 : 25;
    const auto at = [&](int i, int j, int k) {
      return static_cast<int>(std::lround(scale * values[(static_cast<std::size_t>(k) * 15 + j) * 16 + i]));
    };
    const Scan scan = scan_of_function<std::int16_t>({16, 15, 17}, at);
    const LevelSetSettings settings{0, InsideSide::above, -1.0};
    if (has_void(*make_height_grid(scan, settings))) continue;
    ++compared;
    const LevelTopology topology(scan, settings);
    for (const Component& component : topology.components()) EXPECT_TRUE(component.euler.has_value());
  }
  EXPECT_GT(compared, 120);
}

// A closed surface has one Euler number, from whichever side it is counted.
TEST(LevelEuler, BothSidesOfALevelAgree) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const Scan scan = smooth_noise({14, 15, 13}, seed, static_cast<int>(seed) % 3);
    const auto sums = sums_of_sides(*make_height_grid(scan, {0.1, InsideSide::above, -1.0}));
    EXPECT_EQ(sums[0], sums[1]);
  }
}

// In a mask every ambiguous face has its saddle at the level; in noise of few whole numbers many nodes are at it, and
// seldom in such a way that the sides do not agree.
TEST(LevelEuler, BothSidesOfALevelAgreeWhereItIsTouched) {
  const std::vector<std::array<int, 2>> cases{{2, 0}, {4, 0}, {5, 0}, {7, 0}, {12, 0}, {40, 0}, {200, 0}};
  for (const auto& [numbers, most_wrong] : cases) {
    int wrong = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
      std::mt19937 random(seed);
      std::uniform_int_distribution<int> value(0, numbers - 1);
      const Scan scan = scan_of_function<std::int16_t>({12, 13, 11}, [&](int, int, int) { return value(random); });
      const double level = numbers == 2 ? 0.5 : numbers / 2;
      const auto sums = sums_of_sides(*make_height_grid(scan, {level, InsideSide::above, -1.0}));
      wrong += sums[0] != sums[1] ? 1 : 0;
    }
    EXPECT_LE(wrong, most_wrong) << numbers;
  }
}

}  // namespace
}  // namespace scantet
