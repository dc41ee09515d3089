// A point of the domain's boundary that is far from the mesh's becomes a vertex: that brings facets there, where the
// boundary is about as wide as they are. A spike or a sheet thinner than the distance between points has no tets in it,
// and so no facets, however many vertices lie on it alone: see thin_ways.h. A part of which the mesh has nothing takes
// points as close to each other as it is thin; how thin that is is not known, so it gets closer ones each time. No
// point comes closer to another one, or to a vertex, than that: boxes that have a corner in common find the same point
// there, up to rounding, and refinement would surround the two with tets as small.
#include "scantet/app/nearer_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "scantet/base/neighbors.h"
#include "scantet/base/point_grid_impl.h"
#include "scantet/check/boundary_points.h"
#include "scantet/domain/boundary_cells.h"

namespace scantet {
namespace {

/// Points that keep a distance from each other.
class ApartPoints {
 public:
  explicit ApartPoints(double apart_mm) : apart_mm_(apart_mm) {}

  /// Takes the point unless one is nearer that was taken before.
  void offer(const Point& p) {
    Cube cube;
    for (int axis = 0; axis < 3; ++axis) {
      cube[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::floor(p[axis] / apart_mm_));
    }
    for (const NeighborOffset& step : kNeighborhood) {
      const auto around = cubes_.find({cube[0] + step[0], cube[1] + step[1], cube[2] + step[2]});
      if (around == cubes_.end()) continue;
      for (const Point& q : around->second) {
        if (distance(p, q) < apart_mm_) return;
      }
    }
    cubes_[cube].push_back(p);
    taken_.push_back(p);
  }
  std::vector<Point> take() { return std::move(taken_); }

 private:
  using Cube = std::array<std::int64_t, 3>;

  double apart_mm_;
  std::map<Cube, std::vector<Point>> cubes_;
  std::vector<Point> taken_;
};

/// Whether its points lie on the two boundaries.
bool was_measured(const FarPlace& place) {
  return place.nearest != place.point;
}

/// Those that no vertex is nearer to than apart_mm.
std::vector<Point> without_near(std::vector<Point> points, const std::vector<Point>& vertices, double apart_mm) {
  const PointGrid grid(vertices, apart_mm);
  std::erase_if(points, [&](const Point& p) {
    return grid.any_near(p, apart_mm, [](std::uint32_t, const Point&, double) { return true; });
  });
  return points;
}

/// The shortest edge of the cells that hold the places; infinite if there are none.
double least_cell_edge_mm(const Domain& domain, const std::vector<Point>& places) {
  double least_mm = std::numeric_limits<double>::infinity();
  const BoundaryCells* const cells = domain.boundary_cells();
  if (cells == nullptr) return least_mm;
  for (const Point& p : places) {
    for (const BoundaryCell& cell : cells_in_box(*cells, {p, p})) {
      for (const Vec& edge : cell.edges) least_mm = std::min(least_mm, length(edge));
    }
  }
  return least_mm;
}

/// Those that are neither as close to each other as a small part of how far apart they were looked for, nor to a
/// vertex.
std::vector<Point> spread(const std::vector<Point>& found, double spacing_mm, const std::vector<Point>& vertices) {
  constexpr double kApart = 0.25;  // of that
  const double apart_mm = kApart * spacing_mm;
  ApartPoints apart(apart_mm);
  for (const Point& p : found) apart.offer(p);
  return without_near(apart.take(), vertices, apart_mm);
}

/// Points of the boundary in the boxes, about that far apart, of a domain without cells.
std::vector<Point> sampled_points_in(const Domain& domain, const std::vector<Box>& boxes, double spacing_mm) {
  std::vector<Point> found;
  domain.surface_candidates(spacing_mm, [&](const Point& p) {
    if (std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) { return box.contains(p); })) found.push_back(p);
  });
  return found;
}

}  // namespace

std::vector<Point> far_points(const BoundaryDistance& distance) {
  std::vector<const FarPlace*> far;
  for (const FarPlace& place : distance.to_mesh.beyond) {
    if (was_measured(place)) far.push_back(&place);
  }
  std::stable_sort(far.begin(), far.end(),
                   [](const FarPlace* a, const FarPlace* b) { return a->distance_mm > b->distance_mm; });
  std::vector<Point> points;
  for (const FarPlace* place : far) points.push_back(place->point);
  for (const FarPlace& place : distance.to_domain.beyond) {
    if (was_measured(place)) points.push_back(place.nearest);
  }
  return points;
}

std::vector<Point> nearer_points(std::span<const Point> far, double limit_mm, const MeshResult& mesh, int round) {
  constexpr double kApart = 3;          // times the limit, in the first round
  constexpr double kSame = 0.1;         // of the limit: a vertex so near has no facets, and another one has none either
  constexpr double kMostPoints = 0.25;  // of the vertices
  ApartPoints apart(kApart * std::ldexp(limit_mm, -round));
  for (const Point& p : far) apart.offer(p);
  std::vector<Point> points = without_near(apart.take(), mesh.sample, kSame * limit_mm);
  const auto most = static_cast<std::size_t>(kMostPoints * static_cast<double>(mesh.sample.size()));
  points.resize(std::min(points.size(), most));
  return points;
}

std::vector<Point> points_on_parts(const Domain& domain, const std::vector<FarPlace>& parts,
                                   const std::vector<Point>& vertices, double share) {
  constexpr double kSpacing = 0.25;  // of the least distance
  std::vector<Box> boxes;
  boxes.reserve(parts.size());
  double least_mm = std::numeric_limits<double>::infinity();
  for (const FarPlace& part : parts) {
    const Vec reach = part.distance_mm * Vec{1, 1, 1};
    boxes.push_back({part.point - reach, part.point + reach});
    least_mm = std::min(least_mm, part.distance_mm);
  }
  if (domain.boundary_cells() != nullptr) {
    const std::vector<Point> places = boundary_points_in(domain, boxes, 1);
    const std::vector<Point> found = boundary_points_near(domain, places, share);
    return found.empty() ? found : spread(found, share * least_cell_edge_mm(domain, places), vertices);
  }
  const double spacing_mm = share * kSpacing * least_mm;
  return spread(sampled_points_in(domain, boxes, spacing_mm), spacing_mm, vertices);
}

}  // namespace scantet
