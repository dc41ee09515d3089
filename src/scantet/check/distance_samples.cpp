// A domain that does not know where its boundary may be is asked at points: those that its sample would start from,
// about as many as there are facets, and the crossings along the normal of each facet.
#include <algorithm>
#include <cmath>

#include "scantet/base/parallel.h"
#include "scantet/check/distance_impl.h"

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
  double area_mm2 = 0;
  for (const Triangle& t : mesh.boundary_facets) {
    const Point& a = mesh.vertices[t[0]];
    area_mm2 += 0.5 * length(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
  }
  Gathering all(options.limit_mm);
  const auto facets = static_cast<double>(mesh.boundary_facets.size());
  if (!(area_mm2 > 0)) return all.result(false);
  std::vector<Point> points;
  domain.surface_candidates(std::sqrt(area_mm2 / facets), [&](const Point& p) { points.push_back(p); });
  std::vector<std::uint32_t> every(mesh.boundary_facets.size());
  for (std::uint32_t i = 0; i < every.size(); ++i) every[i] = i;
  const FacetTree tree(mesh, every);
  std::vector<FarPlace> places(points.size());
  parallel_for(points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::uint32_t hint = FacetTree::kNone;
    for (std::size_t i = begin; i < end; ++i) {
      const FacetTree::Nearest nearest = tree.nearest(points[i], hint);
      places[i] = {points[i], tree.nearest_point(nearest.facet, points[i]), nearest.distance_mm};
      hint = nearest.facet;
    }
  });
  for (std::size_t i = 0; i < points.size(); ++i) add_point(all, places[i]);
  return all.result(false);
}

OneWayDistance sampled_to_domain(const TetMesh& mesh, const Domain& domain, const DistanceOptions& options) {
  std::vector<FarPlace> places(mesh.boundary_facets.size());
  parallel_for(places.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<Segment> segments;
    for (std::size_t i = begin; i < end; ++i) {
      const Triangle& t = mesh.boundary_facets[i];
      const Point& a = mesh.vertices[t[0]];
      const Point& b = mesh.vertices[t[1]];
      const Point& c = mesh.vertices[t[2]];
      const Point center = 1.0 / 3 * (a + b + c);
      const double reach_mm = std::max({distance(a, center), distance(b, center), distance(c, center)});
      const Vec normal = cross(b - a, c - a);
      const double norm = length(normal);
      const Vec along = norm > 0 ? reach_mm / norm * normal : Vec{0, 0, reach_mm};
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
  Gathering all(options.limit_mm);
  for (const FarPlace& place : places) add_point(all, place);
  return all.result(false);
}

}  // namespace

BoundaryDistance sampled_distance(const TetMesh& mesh, const Domain& domain, const DistanceOptions& options) {
  return {sampled_to_mesh(mesh, domain, options), sampled_to_domain(mesh, domain, options), options.limit_mm};
}

}  // namespace scantet::measuring
