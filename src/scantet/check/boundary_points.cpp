#include "scantet/check/boundary_points.h"

#include <algorithm>
#include <array>
#include <set>

#include "scantet/base/neighbors.h"
#include "scantet/check/boundary_box_impl.h"

namespace scantet {
namespace {

void add_witnesses(const BoundaryBox& box, const BoundaryCells& cells, std::size_t surface, double share,
                   std::vector<Point>& out) {
  if (!box.may_hold(cells, surface)) return;
  if (box.size() <= share) {
    if (const std::optional<Point> witness = box.witness(cells, surface)) out.push_back(*witness);
    return;
  }
  for (int corner = 0; corner < 8; ++corner) add_witnesses(box.part(corner), cells, surface, share, out);
}

/// The direction turned so that none of kNeighborDirections stays in a plane of the grid: where nodes side by side are
/// at the level, so is the edge or the face between them, and lines along it begin and end there.
Vec skewed(const Vec& d) {
  return {(2 * d.x + 3 * d.y + 6 * d.z) / 7, (3 * d.x - 6 * d.y + 2 * d.z) / 7, (6 * d.x + 2 * d.y - 3 * d.z) / 7};
}

}  // namespace

std::vector<Point> boundary_points_near(const Domain& domain, std::span<const Point> places, double share) {
  std::vector<Box> boxes;
  boxes.reserve(places.size());
  for (const Point& p : places) boxes.push_back({p, p});
  return boundary_points_in(domain, boxes, share);
}

std::vector<Point> boundary_points_in(const Domain& domain, std::span<const Box> boxes, double share) {
  std::vector<Point> points;
  const BoundaryCells* const cells = domain.boundary_cells();
  if (cells == nullptr) return points;
  std::set<std::pair<std::size_t, std::array<int, 3>>> seen;
  std::vector<BoundaryCell> around;
  for (const Box& box : boxes) {
    for (std::size_t surface = 0; surface < cells->surfaces(); ++surface) {
      around.clear();
      cells->cells_in(surface, box, around);
      for (const BoundaryCell& cell : around) {
        if (seen.insert({surface, cell.id}).second) add_witnesses(BoundaryBox(cell), *cells, surface, share, points);
      }
    }
  }
  return points;
}

bool has_width(const Domain& domain, const Point& p, double length_mm) {
  constexpr double kReach = 0.05;
  Crossings crossings;
  return std::any_of(kNeighborDirections.begin(), kNeighborDirections.end(), [&](const Vec& direction) {
    const Vec along = kReach * length_mm * skewed(direction);
    domain.crossings({p - along, p + along}, crossings);
    return !crossings.empty();
  });
}

}  // namespace scantet
