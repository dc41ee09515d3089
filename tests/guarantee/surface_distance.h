// How far the boundary of a mesh and the boundary of the domain are from each other, both ways, by samples.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "scantet/base/tet_mesh.h"
#include "scantet/domain/domain.h"

namespace scantet {

struct SurfaceDistance {
  double from_mesh_mm = 0;    ///< farthest sample of a facet from the domain's boundary, along the facet's normal
  double from_domain_mm = 0;  ///< farthest surface candidate of the domain from the facets
};

/// The point of the triangle nearest to p (Ericson, Real-Time Collision Detection, 5.1.5), as a squared distance.
inline double squared_distance_to_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Vec ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  const auto to = [&](const Point& q) { return squared_distance(p, q); };
  if (d1 <= 0 && d2 <= 0) return to(a);
  if (d3 >= 0 && d4 <= d3) return to(b);
  if (d6 >= 0 && d5 <= d6) return to(c);
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return to(lerp(a, b, d1 / (d1 - d3)));
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return to(lerp(a, c, d2 / (d2 - d6)));
  if (va <= 0 && d4 >= d3 && d5 >= d6) return to(lerp(b, c, (d4 - d3) / ((d4 - d3) + (d5 - d6))));
  return to(a + (vb / (va + vb + vc)) * ab + (vc / (va + vb + vc)) * ac);
}

/// spacing_mm: of the candidates on the domain's boundary; reach_mm: the boundary is looked for that far off a facet.
inline SurfaceDistance surface_distance(const TetMesh& mesh, const Domain& domain, double spacing_mm, double reach_mm) {
  SurfaceDistance farthest;
  Crossings crossings;
  for (const Triangle& f : mesh.boundary_facets) {
    const Point& a = mesh.vertices[f[0]];
    const Point& b = mesh.vertices[f[1]];
    const Point& c = mesh.vertices[f[2]];
    const Vec normal = cross(b - a, c - a);
    const Vec offset = (reach_mm / length(normal)) * normal;
    for (const Point& p : {lerp(a, b, 0.5), lerp(b, c, 0.5), lerp(c, a, 0.5), (1.0 / 3) * (a + b + c)}) {
      domain.crossings({p - offset, p + offset}, crossings);
      double nearest = reach_mm;
      for (const Crossing& crossing : crossings) nearest = std::min(nearest, distance(p, crossing.point));
      farthest.from_mesh_mm = std::max(farthest.from_mesh_mm, nearest);
    }
  }
  domain.surface_candidates(spacing_mm, [&](const Point& p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Triangle& f : mesh.boundary_facets) {
      nearest = std::min(
          nearest, squared_distance_to_triangle(p, mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]));
    }
    farthest.from_domain_mm = std::max(farthest.from_domain_mm, std::sqrt(nearest));
  });
  return farthest;
}

}  // namespace scantet
