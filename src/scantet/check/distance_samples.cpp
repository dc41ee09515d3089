// A domain that does not know where its boundary may be is asked at points: those that its sample would start from,
// about as many as there are facets, and the crossings along the normal of each facet.
#include <algorithm>
#include <cmath>

#include "scantet/base/parallel.h"
#include "scantet/check/distance_impl.h"
#include "scantet/check/facet_corners_impl.h"

namespace scantet::measuring {
namespace {

constexpr std::size_t kGrain = 256;

void add_point(Gathering& all, const FarPlace& place) {
  PartBounds part;
  part.take(place);
  part.upper_mm = place.distance_mm;
  all.add(part, place.point);
}

OneWayDistance sampled_to_mesh(const TetMesh& mesh, const Domain& domain, const DistanceOptions& options) {
  Gathering all(options);
  const std::vector<Point> points = boundary_samples(mesh, domain);
  if (points.empty()) return all.result(false);
  const FacetTree tree(mesh, all_facets(mesh));
  std::vector<FarPlace> places(points.size());
  parallel_for(points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::uint32_t hint = FacetTree::kNone;
    for (std::size_t i = begin; i < end; ++i) {
      const FacetTree::Nearest nearest = tree.nearest(points[i], hint);
      places[i] = {points[i], tree.nearest_point(nearest.facet, points[i]), nearest.distance_mm};
      hint = nearest.facet;
    }
  });
  for (const FarPlace& place : places) {
    add_point(all, place);
    all.add_if_far(place);
  }
  return all.result(false);
}

OneWayDistance sampled_to_domain(const TetMesh& mesh, const Domain& domain, const DistanceOptions& options) {
  std::vector<FarPlace> places(mesh.boundary_facets.size());
  parallel_for(places.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<Segment> segments;
    for (std::size_t i = begin; i < end; ++i) {
      const FacetCorners t = corners_of(mesh, i);
      const Point center = centroid_of(t);
      const double reach_mm = farthest_corner_mm(t, center);
      const Vec along = along_normal(t, reach_mm);
      segments.push_back({center - along, center + along});
      places[i] = {center, center, reach_mm};
    }
    CrossingLists lists;
    domain.crossings_of(segments, lists);
    for (std::size_t i = begin; i < end; ++i) {
      for (const Crossing& crossing : lists[i - begin]) {
        const double distance_mm = distance(crossing.point, places[i].point);
        if (distance_mm <= places[i].distance_mm) places[i] = {places[i].point, crossing.point, distance_mm};
      }
    }
  });
  Gathering all(options);
  for (const FarPlace& place : places) add_point(all, place);
  return all.result(false);
}

}  // namespace

std::vector<Point> boundary_samples(const TetMesh& mesh, const Domain& domain) {
  double area_mm2 = 0;
  for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
    area_mm2 += 0.5 * length(area_normal(corners_of(mesh, i)));
  }
  std::vector<Point> points;
  if (!(area_mm2 > 0)) return points;
  const auto facets = static_cast<double>(mesh.boundary_facets.size());
  domain.surface_candidates(std::sqrt(area_mm2 / facets), [&](const Point& p) { points.push_back(p); });
  return points;
}

BoundaryDistance sampled_distance(const TetMesh& mesh, const Domain& domain, const DistanceOptions& options) {
  return {sampled_to_mesh(mesh, domain, options), sampled_to_domain(mesh, domain, options), options.limit_mm};
}

}  // namespace scantet::measuring
