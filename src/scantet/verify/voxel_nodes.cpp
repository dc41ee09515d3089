#include "scantet/verify/voxel_nodes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scantet/base/error.h"
#include "scantet/verify/middles.h"

namespace scantet::verify {
namespace {

constexpr double kLargest = 1e50;  // products of eight such numbers do not overflow

Interval mix(const Interval& a, const Interval& b, const Interval& t) {
  return a + t * (b - a);
}

/// The part of a box within a cell, in the cell's own coordinates.
std::array<Interval, 3> local(const Box& box, const Cell& cell) {
  std::array<Interval, 3> range;
  for (int axis = 0; axis < 3; ++axis) {
    const double base = cell[static_cast<std::size_t>(axis)];
    range[static_cast<std::size_t>(axis)] = {std::clamp(below(box.min[axis] - base), 0.0, 1.0),
                                             std::clamp(above(box.max[axis] - base), 0.0, 1.0)};
  }
  return range;
}

/// Least and largest of a function that is linear along both directions, from its corners.
std::pair<double, double> bilinear_extremes(const std::array<double, 4>& f, const Interval& u, const Interval& v) {
  std::array<double, 4> value{};
  for (std::size_t n = 0; n < 2; ++n) {
    const double at = n == 0 ? u.lo : u.hi;
    const double low = plain_mix(f[0], f[1], at);
    const double high = plain_mix(f[2], f[3], at);
    value[2 * n] = plain_mix(low, high, v.lo);
    value[2 * n + 1] = plain_mix(low, high, v.hi);
  }
  return std::minmax({value[0], value[1], value[2], value[3]});
}

/// What the extremes bound for sure: they are of the middles, by mixes in [0, 1], each of which rounds by 9·ε·most at
/// the most; the errors before are not enlarged by it.
template <std::size_t N>
Interval with_errors(const std::pair<double, double>& extremes, const Middles<N>& of, int mixes) {
  const double error = of.off + (9 * mixes + 3) * kUnitRoundoff * of.most + 0x1p-1000;
  return {extremes.first - error, extremes.second + error};
}

}  // namespace

VoxelNodes::VoxelNodes(const Scan& scan, const LevelSetSettings& settings, bool is_capped)
    : scan_(scan),
      level_(settings.level),
      side_(settings.inside == InsideSide::above ? 1 : -1),
      tied_(std::numeric_limits<double>::quiet_NaN()),
      shift_(std::max(0x1p-30 * (scan.max_value - scan.min_value), 0x1p-46 * std::abs(settings.level))) {
  check_level(scan.min_value, scan.max_value, settings);
  outside_ = settings.outside.value_or(side_ > 0 ? scan.min_value : scan.max_value);
  if (is_capped) outside_ = level_ - side_ * 1e6 * (scan.max_value - scan.min_value);
  double largest = std::max({std::abs(scan.min_value), std::abs(scan.max_value), std::abs(level_), std::abs(outside_)});
  for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, length(scan.frame.column(axis)));
  if (!(largest < kLargest) || !(length(scan.frame.origin()) < kLargest)) {
    throw Error(Fault::input, "input.range", "the scan has values or places beyond 1e50, which cannot be verified",
                "scale its values");
  }
  const bool is_wide = std::holds_alternative<const std::int64_t*>(scan.voxels) ||
                       std::holds_alternative<const std::uint64_t*>(scan.voxels);
  if (is_wide && std::max(std::abs(scan.min_value), std::abs(scan.max_value)) >= 0x1p53) {
    throw Error(Fault::input, "input.range", "the scan has whole numbers beyond 2^53, which cannot be verified",
                "scale its values");
  }
}

Cell VoxelNodes::node(NodeNumber number) const {
  const auto width = static_cast<NodeNumber>(scan_.size[0]);
  const auto height = static_cast<NodeNumber>(scan_.size[1]);
  return {static_cast<int>(number % width), static_cast<int>(number / width % height),
          static_cast<int>(number / width / height)};
}

void VoxelNodes::break_ties(std::vector<NodeNumber> inside, int way) {
  tied_ = level_;
  tied_inside_ = std::move(inside);
  level_ += 0.25 * way * side_ * shift_;
}

double VoxelNodes::value(int i, int j, int k) const {
  const auto& n = scan_.size;
  const bool is_outside = i < 0 || j < 0 || k < 0 || i >= n[0] || j >= n[1] || k >= n[2];
  const double v =
      is_outside ? outside_
                 : std::visit([at = number(i, j, k)](const auto* voxels) { return static_cast<double>(voxels[at]); },
                              scan_.voxels);
  if (v != tied_) return v;
  const bool is_inside = !is_outside && std::binary_search(tied_inside_.begin(), tied_inside_.end(), number(i, j, k));
  return tied_ + (is_inside ? side_ : -side_) * shift_;
}

bool VoxelNodes::has_cell(const Cell& cell) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (cell[axis] < -1 || cell[axis] >= scan_.size[axis]) return false;
  }
  return true;
}

std::array<double, 8> VoxelNodes::values(const Cell& cell) const {
  std::array<double, 8> corners;
  const auto& n = scan_.size;
  const bool is_within =
      cell[0] >= 0 && cell[1] >= 0 && cell[2] >= 0 && cell[0] + 1 < n[0] && cell[1] + 1 < n[1] && cell[2] + 1 < n[2];
  if (!is_within) {
    for (int c = 0; c < 8; ++c) {
      corners[static_cast<std::size_t>(c)] = value(cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2));
    }
    return corners;
  }
  const std::int64_t row = n[0];
  const std::int64_t layer = row * n[1];
  const std::int64_t at = cell[2] * layer + cell[1] * row + cell[0];
  std::visit(
      [&](const auto* voxels) {
        for (std::size_t c = 0; c < 8; ++c) {
          corners[c] = static_cast<double>(voxels[at + (c & 1 ? 1 : 0) + (c & 2 ? row : 0) + (c & 4 ? layer : 0)]);
        }
      },
      scan_.voxels);
  for (int c = 0; c < 8; ++c) {
    double& v = corners[static_cast<std::size_t>(c)];
    if (v == tied_) v = value(cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2));
  }
  return corners;
}

CellValues VoxelNodes::cell(const Cell& cell) const {
  const std::array<double, 8> values = this->values(cell);
  CellValues corners;
  for (std::size_t c = 0; c < 8; ++c) {
    const Interval height = values[c] == level_ ? Interval(0) : Interval(values[c]) - level_;
    corners[c] = side_ > 0 ? height : -height;
  }
  return corners;
}

IndexMap::IndexMap(const Frame& frame) : origin_(frame.origin()) {
  for (int axis = 0; axis < 3; ++axis) columns_[static_cast<std::size_t>(axis)] = IntervalVec(frame.column(axis));
  const Interval volume = det(columns_[0], columns_[1], columns_[2]);
  if (!volume.is_positive() && !volume.is_negative()) {
    throw Error(Fault::input, "input.frame", "the image's axes do not span space to rounding", "correct its header");
  }
  hand_ = volume.is_positive() ? 1 : -1;
  const Interval inverse = quotient(1, volume);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    rows_[axis] = inverse * cross(columns_[(axis + 1) % 3], columns_[(axis + 2) % 3]);
  }
}

IntervalVec IndexMap::to_index(const Point& world) const {
  const IntervalVec d = IntervalVec(world) - origin_;
  return {dot(rows_[0], d), dot(rows_[1], d), dot(rows_[2], d)};
}

IntervalVec IndexMap::to_world(const IntervalVec& index) const {
  return index[0] * columns_[0] + (index[1] * columns_[1] + index[2] * columns_[2]);
}

Vec IndexMap::index_direction(const Vec& world) const {
  const IntervalVec d(world);
  return {dot(rows_[0], d).middle(), dot(rows_[1], d).middle(), dot(rows_[2], d).middle()};
}

Interval value_range(const CellValues& corners, const Cell& cell, const Box& box) {
  const std::array<Interval, 3> at = local(box, cell);
  const Middles<8> middles(corners);
  std::pair<double, double> all{HUGE_VAL, -HUGE_VAL};
  for (const double z : {at[2].lo, at[2].hi}) {
    std::array<double, 4> slice{};
    for (std::size_t c = 0; c < 4; ++c) slice[c] = plain_mix(middles.value[c], middles.value[c + 4], z);
    const std::pair<double, double> range = bilinear_extremes(slice, at[0], at[1]);
    all = {std::min(all.first, range.first), std::max(all.second, range.second)};
  }
  return with_errors(all, middles, 3);
}

IntervalVec gradient_range(const CellValues& corners, const Cell& cell, const Box& box) {
  const std::array<Interval, 3> at = local(box, cell);
  IntervalVec gradient;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t step = std::size_t{1} << axis;
    const std::size_t u = std::size_t{1} << (axis + 1) % 3;
    const std::size_t v = std::size_t{1} << (axis + 2) % 3;
    const auto rise = [&](std::size_t corner) { return corners[corner + step] - corners[corner]; };
    const Middles<4> middles({rise(0), rise(u), rise(v), rise(u + v)});
    gradient[static_cast<int>(axis)] =
        with_errors(bilinear_extremes(middles.value, at[(axis + 1) % 3], at[(axis + 2) % 3]), middles, 2);
  }
  return gradient;
}

Interval value_at(const CellValues& corners, const Cell& cell, const Interval& x, const Interval& y,
                  const Interval& z) {
  const Interval u = x - cell[0];
  const Interval v = y - cell[1];
  const Interval w = z - cell[2];
  const Interval low = mix(mix(corners[0], corners[1], u), mix(corners[2], corners[3], u), v);
  const Interval high = mix(mix(corners[4], corners[5], u), mix(corners[6], corners[7], u), v);
  return mix(low, high, w);
}

double sampled_value(const VoxelNodes& nodes, const Vec& place) {
  Cell cell{};
  Vec u;
  for (int axis = 0; axis < 3; ++axis) {
    const int end = nodes.size()[static_cast<std::size_t>(axis)];
    const double x = std::clamp(place[axis], -1.0, double(end));
    cell[static_cast<std::size_t>(axis)] = std::min(static_cast<int>(std::floor(x)), end - 1);
    u[axis] = x - cell[static_cast<std::size_t>(axis)];
  }
  const std::array<double, 8> f = nodes.values(cell);
  const auto mix = [](double a, double b, double t) { return (1 - t) * a + t * b; };
  const double low = mix(mix(f[0], f[1], u.x), mix(f[2], f[3], u.x), u.y);
  const double high = mix(mix(f[4], f[5], u.x), mix(f[6], f[7], u.x), u.y);
  return nodes.side() * (mix(low, high, u.z) - nodes.level());
}

bool cells_of(const VoxelNodes& nodes, const Box& box, Cell& first, Cell& last) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const int end = nodes.size()[a];
    if (!(box.min[axis] >= -1) || !(box.max[axis] <= end)) return false;
    // A box that ends on a cell's side touches the cell beyond it, too.
    first[a] = std::max(-1, static_cast<int>(std::ceil(box.min[axis])) - 1);
    last[a] = std::min(end - 1, static_cast<int>(std::floor(box.max[axis])));
  }
  return true;
}

Box within(const Box& box, const Cell& cell) {
  Box part;
  for (int axis = 0; axis < 3; ++axis) {
    const double base = cell[static_cast<std::size_t>(axis)];
    part.min[axis] = std::max(box.min[axis], base);
    part.max[axis] = std::min(box.max[axis], base + 1);
  }
  return part;
}

}  // namespace scantet::verify
