// CGAL estimates and orients. Its spanning tree covers what hangs together with the one point it starts at; the pieces
// that are left are oriented one by one in the same way.
#include "normals.h"

#include <CGAL/jet_estimate_normals.h>
#include <CGAL/mst_orient_normals.h>

#include <algorithm>

namespace points {
namespace {

constexpr unsigned kNeighbours = 18;

bool has_normal(const Oriented& point) {
  return point.second != CGAL::NULL_VECTOR;
}

void orient_pieces(PointSet& points) {
  PointSet oriented;
  oriented.reserve(points.size());
  PointSet rest = std::move(points);
  while (!rest.empty()) {
    const auto end =
        CGAL::mst_orient_normals(rest, kNeighbours, CGAL::parameters::point_map(PointMap()).normal_map(NormalMap()));
    oriented.insert(oriented.end(), rest.begin(), end);
    rest.erase(rest.begin(), end);
  }
  points = std::move(oriented);
}

}  // namespace

bool settle_normals(const std::string& file, NormalSource source, PointSet& points, scantet::Progress& progress) {
  const bool estimate = source == NormalSource::estimate || std::none_of(points.begin(), points.end(), has_normal);
  if (estimate) {
    progress.report({"read", "normals", 0, points.size(), 0});
    CGAL::jet_estimate_normals<CGAL::Sequential_tag>(points, kNeighbours,
                                                     CGAL::parameters::point_map(PointMap()).normal_map(NormalMap()));
    if (progress.cancelled()) return estimate;
    orient_pieces(points);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double length = scantet::length(normal_of(points[i]));
    if (!(length > 0) || !std::isfinite(length)) {
      refuse(file, "point " + std::to_string(i + 1) + " of the different ones has no normal, and others have",
             "give all of them one, or let them be estimated with --normals estimate");
    }
    points[i].second = points[i].second / length;
  }
  return estimate;
}

}  // namespace points
