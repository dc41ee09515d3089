// A difference of two trilinear functions is trilinear, so that on a box it lies between its values at the corners.
#include "scantet/verify/label_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "scantet/verify/cell_boxes.h"

namespace scantet::verify {
namespace {

constexpr double kTie = 1e-6;  // smoothed fields are given as floats

/// Of field a less field b.
Interval range_of_difference(const LabelCellValues& fields, std::size_t a, std::size_t b, const Cell& cell,
                             const Box& box) {
  CellValues corners;
  for (std::size_t c = 0; c < 8; ++c) corners[c] = Interval(fields.values[a][c]) - fields.values[b][c];
  return value_range(corners, cell, box);
}

/// The least upper bound, of some weights tried, of field n less a mean of fields a and b: where both are as large as n
/// somewhere, neither alone is above it all around. It is convex in the weight.
double least_above_mean(const LabelCellValues& fields, std::size_t n, std::size_t a, std::size_t b, const Cell& cell,
                        const Box& box) {
  const auto above_mean = [&](double weight) {
    CellValues corners;
    for (std::size_t c = 0; c < 8; ++c) {
      corners[c] = weight * (Interval(fields.values[n][c]) - fields.values[a][c]) +
                   (1 - weight) * (Interval(fields.values[n][c]) - fields.values[b][c]);
    }
    return value_range(corners, cell, box).hi;
  };
  double low = 0;
  double high = 1;
  for (int step = 0; step < 32; ++step) {
    const double third = (high - low) / 3;
    const double left = low + third;
    const double right = high - third;
    if (above_mean(left) < above_mean(right)) {
      high = right;
    } else {
      low = left;
    }
  }
  return above_mean(0.5 * (low + high));
}

}  // namespace

Candidates candidates(const LabelCellValues& fields, const Cell& cell, const Box& box) {
  Candidates all = 0;
  for (std::size_t a = 0; a < fields.count; ++a) {
    bool may_win = true;
    for (std::size_t b = 0; b < fields.count && may_win; ++b) {
      may_win = a == b || range_of_difference(fields, a, b, cell, box).hi >= -kTie;
    }
    if (may_win) all = static_cast<Candidates>(all | 1 << a);
  }
  return all;
}

bool surely_wins(const LabelCellValues& fields, std::size_t n, const Cell& cell, const Box& box) {
  for (std::size_t b = 0; b < fields.count; ++b) {
    if (b != n && range_of_difference(fields, n, b, cell, box).lo <= kTie) return false;
  }
  return true;
}

bool surely_not_above(const LabelCellValues& fields, std::size_t n, const Cell& cell, const Box& box, int depth) {
  for (std::size_t b = 0; b < fields.count; ++b) {
    if (b != n && range_of_difference(fields, n, b, cell, box).hi <= kTie) return true;
  }
  for (std::size_t a = 0; a < fields.count; ++a) {
    for (std::size_t b = a + 1; b < fields.count; ++b) {
      if (a != n && b != n && least_above_mean(fields, n, a, b, cell, box) <= kTie) return true;
    }
  }
  if (depth == 0) return false;
  for (int part = 0; part < 8; ++part) {
    const Box of = eighth(box, part);
    bool is_same = false;  // a flat box has each of its parts twice
    for (int axis = 0; axis < 3; ++axis) {
      is_same = is_same || ((part >> axis & 1) != 0 && box.min[axis] == box.max[axis]);
    }
    if (!is_same && !surely_not_above(fields, n, cell, of, depth - 1)) return false;
  }
  return true;
}

std::optional<Region> only_region(const LabelSource& labels, const Cell& cell) {
  const Region first = labels.region_of(cell[0], cell[1], cell[2]);
  for (int c = 1; c < 8; ++c) {
    if (labels.region_of(cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2)) != first) return std::nullopt;
  }
  return first;
}

std::optional<Region> sure_region(const LabelSource& labels, const IntervalVec& place) {
  Box box;
  extend(box, place);
  Cell first;
  Cell last;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const int end = labels.size()[a];
    if (!(box.max[axis] >= -1) || !(box.min[axis] <= end)) return kOutside;
    first[a] = std::max(-1, static_cast<int>(std::ceil(std::max(-1.0, box.min[axis]))) - 1);
    last[a] = std::min(end - 1, static_cast<int>(std::floor(std::min<double>(end, box.max[axis]))));
  }
  std::optional<Region> region;
  LabelCellValues fields;
  for (int k = first[2]; k <= last[2]; ++k) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int i = first[0]; i <= last[0]; ++i) {
        const Cell cell{i, j, k};
        std::optional<Region> here = only_region(labels, cell);
        if (!here) {
          labels.cell(i, j, k, fields);
          const Candidates sure = candidates(fields, cell, within(box, cell));
          if (!is_one(sure)) return std::nullopt;
          here = fields.regions[static_cast<std::size_t>(std::countr_zero(sure))];
        }
        if (region && *region != *here) return std::nullopt;
        region = here;
      }
    }
  }
  return region;
}

}  // namespace scantet::verify
