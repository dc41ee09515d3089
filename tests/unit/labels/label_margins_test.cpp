#include "scantet/labels/label_margins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "label_scan.h"
#include "scantet/labels/label_domain.h"
#include "scantet/labels/label_field.h"

namespace scantet {
namespace {

using test::smooth_field;

/// Calls act(node, next) for all nodes of the image that are beside each other along an axis.
template <class Act>
void for_each_edge(const LabelField& field, const Act& act) {
  const std::array<int, 3>& size = field.size();
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const std::array<int, 3> node{i, j, k};
          std::array<int, 3> next = node;
          if (++next[axis] < size[axis]) act(node, next);
        }
      }
    }
  }
}

Region region_of(const LabelField& field, const std::array<int, 3>& node) {
  return field.region_of_node(node[0], node[1], node[2]);
}

Point place_of(const std::array<int, 3>& node) {
  return {double(node[0]), double(node[1]), double(node[2])};
}

std::size_t place_of(const LabelCell& cell, Region region) {
  return static_cast<std::size_t>(std::find(cell.regions.begin(), cell.regions.end(), region) - cell.regions.begin());
}

/// Where the labels of an edge's ends are equal, by how much a third one is less at the least.
double least_gap(const Scan& scan) {
  const auto field = smooth_field(scan);
  double least = std::numeric_limits<double>::infinity();
  LabelCell cell;
  for_each_edge(*field, [&](const std::array<int, 3>& node, const std::array<int, 3>& next) {
    const Region own = region_of(*field, node);
    const Region other = region_of(*field, next);
    if (own == other) return;
    field->cell(node[0], node[1], node[2], cell);
    const std::size_t end = next[0] > node[0] ? 1 : next[1] > node[1] ? 2 : 4;
    const CellHeights& a = cell.values[place_of(cell, own)];
    const CellHeights& b = cell.values[place_of(cell, other)];
    const double at = (a[0] - b[0]) / (a[0] - b[0] + b[end] - a[end]);
    for (std::size_t n = 0; n < cell.count; ++n) {
      if (cell.regions[n] == own || cell.regions[n] == other) continue;
      least = std::min(least, mix(a[0] - cell.values[n][0], a[end] - cell.values[n][end], at));
    }
  });
  return least;
}

TEST(LabelMargins, ThirdLabelsKeepAwayFromEdges) {
  EXPECT_GE(least_gap(test::label_cells({40, 35, 30}, 25)), 0.29);
  EXPECT_GE(least_gap(test::label_noise({20, 20, 20}, 6)), 0.29);
}

TEST(LabelMargins, RegionsOfOneNodeAreThickerThanThat) {
  const Scan specks = test::label_scan({24, 24, 24}, [](int i, int j, int k) {
    if (i % 6 == 3 && j % 6 == 3 && k % 6 == 3) return 3;  // some in between, some where two labels meet
    return i + j / 2 < 13 ? 1 : 2;
  });
  const auto field = smooth_field(specks);
  const auto domain = make_label_domain(field);
  Crossings crossings;
  int count = 0;
  for_each_edge(*field, [&](const std::array<int, 3>& node, const std::array<int, 3>& next) {
    if (region_of(*field, node) != 3) return;
    const Vec step = place_of(next) - place_of(node);
    domain->crossings({place_of(node) - step, place_of(next)}, crossings);
    ASSERT_EQ(crossings.size(), 2U);
    EXPECT_GE(distance(crossings[0].point, crossings[1].point), 0.79);
    ++count;
  });
  EXPECT_EQ(count, 4 * 4 * 4 * 3);
}

/// On faces whose diagonals have one label each, by how little one of these meets at least.
double least_pass(const LabelField& field) {
  double least = 1e300;
  LabelCell cell;
  for (int k = -1; k < field.size()[2]; ++k) {
    for (int j = -1; j < field.size()[1]; ++j) {
      for (int i = -1; i < field.size()[0]; ++i) {
        const Region a = field.region_of_node(i, j, k);
        const Region c = field.region_of_node(i + 1, j, k);
        if (a == c || field.region_of_node(i, j + 1, k) != c || field.region_of_node(i + 1, j + 1, k) != a) continue;
        field.cell(i, j, k, cell);
        std::array<double, 4> d;
        for (std::size_t n = 0; n < 4; ++n)
          d[n] = cell.values[place_of(cell, a)][n] - cell.values[place_of(cell, c)][n];
        least = std::min(least, std::abs((d[0] * d[3] - d[1] * d[2]) / (d[0] + d[3] - d[1] - d[2])));
      }
    }
  }
  return least;
}

TEST(LabelMargins, LabelsMeetAcrossDiagonalsOrNot) {
  // Columns that meet at edges only: by symmetry as much for one label as for the other.
  const Scan columns = test::label_scan({16, 16, 6}, [](int i, int j, int) { return (i / 4 + j / 4) % 2 + 1; });
  EXPECT_GE(least_pass(*smooth_field(columns)), 0.29);
  const Scan torn =
      test::label_scan({30, 30, 30}, [](int i, int j, int k) { return (i * j + k * k / 7) % 11 < 5 ? 1 : 0; });
  EXPECT_GE(least_pass(*smooth_field(torn)), 0.25);
}

}  // namespace
}  // namespace scantet
