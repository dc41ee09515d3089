#include "scantet/app/narrow_necks.h"

#include <algorithm>

#include "scantet/base/neighbors.h"
#include "scantet/base/point_grid_impl.h"

namespace scantet {
namespace {

constexpr double kReach = 1;       // sizes, from a place to a neck
constexpr double kNarrow = 0.02;   // of the size there: half the width of a neck, at the most
constexpr double kAround = 3.5;    // times that: the size at a neck
constexpr double kLeast = 0.0075;  // of the size asked for: smaller elements there only make other places wrong

/// From each of these to the nearest point of the boundary, mm, as the directions find it; most_mm if it is farther.
std::vector<double> half_widths(const Domain& domain, const std::vector<Point>& necks, double most_mm) {
  std::vector<Segment> segments;
  for (const Point& p : necks) {
    for (const Vec& way : kNeighborDirections) segments.push_back({p, p + most_mm / length(way) * way});
  }
  CrossingLists crossings;
  domain.crossings_of(segments, crossings);
  std::vector<double> widths_mm(necks.size(), most_mm);
  for (std::size_t n = 0; n < segments.size(); ++n) {
    if (crossings[n].empty()) continue;
    double& width_mm = widths_mm[n / kNeighborDirections.size()];
    width_mm = std::min(width_mm, distance(crossings[n].front().point, segments[n].source));
  }
  return widths_mm;
}

}  // namespace

bool NarrowNecks::add_near(std::span<const Point> places) {
  if (places.empty()) return false;
  std::vector<Point> hints;
  domain_.size_hints([&](const SizeHint& hint) { hints.push_back(hint.point); });
  const PointGrid grid(hints, kReach * size_.usual_size());
  const std::size_t before = places_.size();
  for (const Point& place : places) {
    const double size_mm = size_.size_at(place);
    std::vector<Point> near;
    grid.any_near(place, kReach * size_mm, [&](std::uint32_t, const Point& p, double) {
      near.push_back(p);
      return false;
    });
    if (near.empty()) continue;
    const std::vector<double> widths_mm = half_widths(domain_, near, kNarrow * size_mm);
    const auto narrowest = std::min_element(widths_mm.begin(), widths_mm.end());
    const Point& p = near[static_cast<std::size_t>(narrowest - widths_mm.begin())];
    const auto is_there = [&](const FinerPlace& known) { return known.point == p; };
    if (*narrowest >= kNarrow * size_mm || std::any_of(places_.begin(), places_.end(), is_there)) continue;
    places_.push_back({p, std::max(kAround * *narrowest, kLeast * size_mm)});
  }
  return places_.size() > before;
}

}  // namespace scantet
