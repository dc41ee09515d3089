// The points are moved in their tangent planes, among the neighbours found at the start. Only at the end are they
// brought back to the boundary, by the crossings of a short segment along the normal. A point without a clear plane or
// without such a crossing stays.
#include <array>
#include <cassert>

#include "scantet/base/parallel.h"
#include "scantet/base/point_grid_impl.h"
#include "scantet/domain/nearest_crossing.h"
#include "scantet/sampling/plane_fit_impl.h"
#include "scantet/sampling/sample_relaxation_impl.h"

namespace scantet::engine {
namespace {

constexpr std::size_t kGrain = 512;
constexpr std::size_t kMostNeighbors = 24;  // on a flat boundary there are about ten
// Multiples of the radius of the darts:
constexpr double kReach = 2.0;   // neighbours are looked for that far
constexpr double kRest = 1.7;    // two points that near push each other
constexpr double kStride = 0.3;  // of a move
constexpr double kReturn = 0.5;  // the boundary is looked for that far off the tangent plane
constexpr int kMoves = 4;
constexpr double kPush = 0.4;  // share of what two points lack of the rest distance

struct Neighborhood {
  std::array<std::uint32_t, kMostNeighbors> neighbors;  // places in the grid's order
  std::uint32_t count = 0;
  std::optional<Vec> normal;  // none: the point stays
};

/// place: where each dart is in the grid's order, by its index.
Neighborhood neighborhood(const PointGrid& grid, const std::vector<std::uint32_t>& place, const Dart& dart,
                          std::uint32_t index) {
  Neighborhood result;
  if (dart.fixed) return result;
  const double reach = kReach * dart.radius_mm;
  PlaneFit plane;
  grid.any_near(dart.point, reach, [&](std::uint32_t i, const Point& p, double squared) {
    const double fade = 1 - squared / (reach * reach);
    plane.add(p - dart.point, fade * fade);
    if (i != index) result.neighbors[result.count++] = place[i];
    return result.count == kMostNeighbors;
  });
  result.normal = plane.normal();
  return result;
}

/// Where the neighbours push the point.
Point pushed(const std::vector<Point>& points, std::size_t index, const Neighborhood& around, double radius_mm) {
  Vec force;
  const double rest = kRest * radius_mm;
  for (std::uint32_t k = 0; k < around.count; ++k) {
    const Vec away = points[index] - points[around.neighbors[k]];
    const double near = length(away);
    if (near < rest && near > 0) force = force + (kPush * (rest - near) / near) * away;
  }
  assert(std::abs(squared_length(*around.normal) - 1) < 1e-6);
  force = force - dot(force, *around.normal) * *around.normal;
  const double stride = length(force);
  const double longest = kStride * radius_mm;
  return points[index] + (stride > longest ? longest / stride : 1.0) * force;
}

}  // namespace

void relax_sample(const Domain& domain, std::span<Dart> sample) {
  double widest_mm = 0;
  for (const Dart& dart : sample) widest_mm = std::max(widest_mm, dart.radius_mm);
  const PointGrid grid(points_of(sample), widest_mm);
  // All is kept in the grid's order: neighbours are in the cache together.
  const LargeVector<PointGrid::Entry>& entries = grid.entries();
  std::vector<std::uint32_t> place(entries.size());
  std::vector<Point> points(entries.size());
  LargeVector<Neighborhood> around;
  around.resize(entries.size());
  const auto for_all = [&](const auto& body) {
    parallel_for(entries.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) body(k, sample[entries[k].index]);
    });
  };
  for_all([&](std::size_t k, const Dart&) {
    place[entries[k].index] = static_cast<std::uint32_t>(k);
    points[k] = entries[k].point;
  });
  for_all([&](std::size_t k, const Dart& dart) { around[k] = neighborhood(grid, place, dart, entries[k].index); });
  std::vector<Point> moved = points;
  for (int move = 0; move < kMoves; ++move) {
    for_all([&](std::size_t k, const Dart& dart) {
      if (around[k].normal) moved[k] = pushed(points, k, around[k], dart.radius_mm);
    });
    points.swap(moved);
  }
  parallel_for(entries.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<std::size_t> moving;
    std::vector<Segment> segments;
    for (std::size_t k = begin; k < end; ++k) {
      if (!around[k].normal) continue;
      const Vec offset = (kReturn * sample[entries[k].index].radius_mm) * *around[k].normal;
      moving.push_back(k);
      segments.push_back({points[k] - offset, points[k] + offset});
    }
    CrossingLists crossings;
    domain.crossings_of(segments, crossings);
    for (std::size_t i = 0; i < moving.size(); ++i) {
      const std::size_t k = moving[i];
      const Crossing* const nearest = nearest_crossing(crossings[i], points[k]);
      if (nearest != nullptr) sample[entries[k].index].point = nearest->point;
    }
  });
}

}  // namespace scantet::engine
