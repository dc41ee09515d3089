// Newton's steps for the differences of the first field from all others, as short as they can be (a curve leaves one
// direction open): the least-squares solution with a little damping, which also serves where more fields meet than
// there are directions. Fields are continuous across faces of cells but bend there, so each step looks at the cell it
// has come to.
#include "scantet/labels/junction_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scantet/base/neighbors.h"
#include "scantet/base/trilinear.h"

namespace scantet {
namespace {

constexpr int kMostSteps = 20;
constexpr double kLongestStep = 0.05;  // voxels: where curves nearly meet, longer ones lead to the other curve
constexpr double kReach = 0.5;         // voxels from the guess
constexpr double kEqual = 1e-9;        // of values from 0 to 1
constexpr double kLarger = 1e-7;       // than which another field may not exceed those that meet
constexpr double kDamping = 1e-8;      // of the trace
constexpr double kOnFace = 1e-9;       // voxels
constexpr double kNearest = 0.01;      // of the reach, where the search for another region begins
constexpr double kCircle = 0.05;       // voxels
constexpr std::size_t kOnCircle = 64;  // samples

/// Solves a symmetric, positive definite system by Cramer's rule.
Vec solve(const std::array<Vec, 3>& rows, const Vec& right) {
  const Vec minors = cross(rows[1], rows[2]);
  const double det = dot(rows[0], minors);
  if (!(det > 0)) return {};
  // The inverse is symmetric, too: its columns are the cross products of rows.
  return (1 / det) * (right.x * minors + right.y * cross(rows[2], rows[0]) + right.z * cross(rows[0], rows[1]));
}

Vec gradient(const CellHeights& h, const Vec& u) {
  const auto along = [&](std::size_t bit, double v, double w, std::size_t bit_v, std::size_t bit_w) {
    const auto rise = [&](std::size_t corner) { return h[corner | bit] - h[corner]; };
    return mix(mix(rise(0), rise(bit_v), v), mix(rise(bit_w), rise(bit_v | bit_w), v), w);
  };
  return {along(1, u.y, u.z, 2, 4), along(2, u.x, u.z, 1, 4), along(4, u.x, u.y, 1, 2)};
}

Vec local(const std::array<int, 3>& cell, const Vec& place) {
  Vec u;
  for (int axis = 0; axis < 3; ++axis)
    u[axis] = std::clamp(place[axis] - cell[static_cast<std::size_t>(axis)], 0.0, 1.0);
  return u;
}

std::array<int, 3> cell_of(const Vec& place) {
  return {static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y)),
          static_cast<int>(std::floor(place.z))};
}

}  // namespace

bool JunctionPlaces::look_at(const std::array<int, 3>& cell) {
  if (cell == at_) return true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (cell[axis] < -1 || cell[axis] >= field_.size()[axis]) return false;
  }
  field_.cell(cell[0], cell[1], cell[2], cell_);
  at_ = cell;
  return true;
}

bool JunctionPlaces::evaluate_in(const std::array<int, 3>& cell, const Vec& place, std::span<const Region> regions) {
  if (!look_at(cell)) return false;
  const Vec u = local(cell, place);
  fields_.values.assign(regions.size(), 0);
  fields_.gradients.assign(regions.size(), {});
  fields_.largest_other = -std::numeric_limits<double>::infinity();
  std::size_t found = 0;
  for (std::size_t label = 0; label < cell_.count; ++label) {
    const CellHeights& heights = cell_.values[label];
    const auto region = std::find(regions.begin(), regions.end(), cell_.regions[label]);
    if (region == regions.end()) {
      fields_.largest_other = std::max(fields_.largest_other, trilinear(heights, u));
      continue;
    }
    const auto i = static_cast<std::size_t>(region - regions.begin());
    fields_.values[i] = trilinear(heights, u);
    fields_.gradients[i] = gradient(heights, u);
    ++found;
  }
  return found == regions.size();
}

bool JunctionPlaces::evaluate(const Vec& place, std::span<const Region> regions) {
  if (!is_finite(place)) return false;
  const std::array<int, 3> above = cell_of(place);
  if (evaluate_in(above, place, regions)) return true;
  // On a face it may be the cell on the other side that has all of them.
  const std::array<int, 3> below = cell_of(place - Vec{kOnFace, kOnFace, kOnFace});
  for (unsigned choice = 1; choice < 8; ++choice) {
    std::array<int, 3> cell = above;
    for (unsigned axis = 0; axis < 3; ++axis) {
      if ((choice >> axis & 1) != 0) cell[axis] = below[axis];
    }
    if (cell != above && evaluate_in(cell, place, regions)) return true;
  }
  return false;
}

Vec JunctionPlaces::step(const std::array<bool, 3>& frozen) const {
  std::array<Vec, 3> rows{};
  Vec right;
  for (std::size_t i = 1; i < fields_.values.size(); ++i) {
    Vec slope = fields_.gradients[i] - fields_.gradients[0];
    for (int axis = 0; axis < 3; ++axis) {
      if (frozen[static_cast<std::size_t>(axis)]) slope[axis] = 0;
    }
    right = right - (fields_.values[i] - fields_.values[0]) * slope;
    for (int axis = 0; axis < 3; ++axis) {
      rows[static_cast<std::size_t>(axis)] = rows[static_cast<std::size_t>(axis)] + slope[axis] * slope;
    }
  }
  const double damping = kDamping * (rows[0].x + rows[1].y + rows[2].z);
  rows[0].x += damping;
  rows[1].y += damping;
  rows[2].z += damping;
  return solve(rows, right);
}

std::optional<Vec> JunctionPlaces::newton(const Vec& guess, std::span<const Region> regions,
                                          const std::array<bool, 3>& frozen) {
  Vec place = guess;
  for (int steps = 0; steps < kMostSteps; ++steps) {
    if (!evaluate(place, regions)) return std::nullopt;
    const auto [least, most] = std::minmax_element(fields_.values.begin(), fields_.values.end());
    if (*most - *least <= kEqual) {
      if (fields_.largest_other > *most + kLarger) return std::nullopt;
      return place;
    }
    const Vec way = step(frozen);
    place = place + std::min(1.0, kLongestStep / length(way)) * way;
    if (!(squared_distance(place, guess) <= kReach * kReach)) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<Vec> JunctionPlaces::meeting_near(const Vec& guess, std::span<const Region> regions) {
  std::array<bool, 3> frozen{};
  Vec on_face = guess;
  for (int axis = 0; axis < 3; ++axis) {
    const double nearest = std::round(guess[axis]);
    if (std::abs(guess[axis] - nearest) > kOnFace) continue;
    frozen[static_cast<std::size_t>(axis)] = true;
    on_face[axis] = nearest;
  }
  if (frozen != std::array<bool, 3>{} && regions.size() == 3) {
    const std::optional<Vec> found = newton(on_face, regions, frozen);
    if (found) return found;
  }
  return newton(guess, regions, {});
}

std::optional<Vec> JunctionPlaces::boundary_near(const Vec& guess) {
  if (!is_finite(guess) || !look_at(cell_of(guess))) return std::nullopt;
  const Vec u = local(at_, guess);
  std::vector<std::pair<double, Region>> largest;
  for (std::size_t label = 0; label < cell_.count; ++label) {
    largest.emplace_back(-trilinear(cell_.values[label], u), cell_.regions[label]);
  }
  std::sort(largest.begin(), largest.end());
  std::vector<Region> regions;
  regions.reserve(largest.size());
  for (const auto& [value, region] : largest) regions.push_back(region);
  for (const std::size_t count : {3U, 2U}) {
    if (regions.size() < count) continue;
    std::vector<Region> meeting(regions.begin(), regions.begin() + static_cast<std::ptrdiff_t>(count));
    std::sort(meeting.begin(), meeting.end());
    if (const std::optional<Vec> found = meeting_near(guess, meeting)) return found;
  }
  return change_near(guess);
}

std::optional<Vec> JunctionPlaces::change_near(const Vec& guess) {
  const Region here = region_at(guess);
  std::optional<Vec> nearest;
  for (const Vec& direction : kNeighborDirections) {
    const Vec reach = (kReach / length(direction)) * direction;
    double far = 1;
    for (double share = 1; share > kNearest; share /= 2) {  // the nearest of a few places in another region
      if (region_at(guess + share * reach) != here) far = share;
    }
    if (region_at(guess + far * reach) == here) continue;
    double near = 0;
    while (true) {
      const double middle = 0.5 * (near + far);
      if (middle <= near || middle >= far) break;
      (region_at(guess + middle * reach) == here ? near : far) = middle;
    }
    const Vec found = guess + far * reach;
    if (!nearest || squared_distance(found, guess) < squared_distance(*nearest, guess)) nearest = found;
  }
  return nearest;
}

double JunctionPlaces::turn_of(const Vec& place, const Vec& direction, std::span<const Region, 3> regions) {
  if (!evaluate(place, regions)) return 0;
  const std::vector<Vec>& g = fields_.gradients;
  const Vec turn = cross(g[1] - g[0], g[2] - g[0]);
  const double size = length(turn) * length(direction);
  return size > 0 ? dot(direction, turn) / size : 0;
}

// Where curves cross, a sum of the three fields has no slope, with coefficients that add up to 0. If one of them has
// another sign than both others, that field exceeds a mean of theirs in two opposite wedges at most.
std::optional<Region> JunctionPlaces::meeting_itself(const Vec& place, std::span<const Region, 3> regions) {
  if (!evaluate(place, regions)) return std::nullopt;
  const Vec first = fields_.gradients[1] - fields_.gradients[0];
  const Vec second = fields_.gradients[2] - fields_.gradients[0];
  // The least of |b·first + c·second| for b² + c² = 1.
  const double turn = 0.5 * std::atan2(2 * dot(first, second), dot(first, first) - dot(second, second));
  const double b = -std::sin(turn);
  const double c = std::cos(turn);
  const std::array<double, 3> shares{std::abs(b + c), std::abs(b), std::abs(c)};
  return regions[static_cast<std::size_t>(std::max_element(shares.begin(), shares.end()) - shares.begin())];
}

Region JunctionPlaces::region_at(const Vec& place) {
  if (!look_at(cell_of(place))) return kOutside;
  return cell_.region_at(local(at_, place));
}

std::vector<Region> JunctionPlaces::regions_around(const Vec& place, const Vec& direction) {
  const Vec along = (1 / length(direction)) * direction;
  const bool mostly_x = std::abs(along.x) > 0.6;
  const Vec across = cross(along, mostly_x ? Vec{0, 1, 0} : Vec{1, 0, 0});
  const Vec e1 = (1 / length(across)) * across;
  const Vec e2 = cross(along, e1);
  std::vector<Region> order;
  for (std::size_t i = 0; i < kOnCircle; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kOnCircle;
    const Region region = region_at(place + kCircle * (std::cos(angle) * e1 + std::sin(angle) * e2));
    if (order.empty() || order.back() != region) order.push_back(region);
  }
  if (order.size() > 1 && order.back() == order.front()) order.pop_back();
  std::rotate(order.begin(), std::min_element(order.begin(), order.end()), order.end());
  return order;
}

}  // namespace scantet
