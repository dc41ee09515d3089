#include "surface_gap.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>

namespace scantet::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 to_cgal(const Point& p) {
  return {p.x, p.y, p.z};
}

double farthest_from(const Domain& polyhedron, const Point& a, const Point& b, const Point& c) {
  constexpr int kParts = 4;  // of an edge
  double farthest = 0;
  for (int i = 0; i <= kParts; ++i) {
    for (int j = 0; i + j <= kParts; ++j) {
      const Point p = a + (1.0 / kParts) * (static_cast<double>(i) * (b - a) + static_cast<double>(j) * (c - a));
      farthest = std::max(farthest, polyhedron.residual_at(p).value());
    }
  }
  return farthest * polyhedron.bounds().diagonal();
}

}  // namespace

SurfaceGap surface_gap(const TetMesh& mesh, const Domain& polyhedron, double spacing_mm) {
  SurfaceGap gap;
  Triangles triangles;
  for (const Triangle& f : mesh.boundary_facets) {
    const Point& a = mesh.vertices[f[0]];
    const Point& b = mesh.vertices[f[1]];
    const Point& c = mesh.vertices[f[2]];
    gap.from_mesh_mm = std::max(gap.from_mesh_mm, farthest_from(polyhedron, a, b, c));
    triangles.emplace_back(to_cgal(a), to_cgal(b), to_cgal(c));
  }
  Tree tree(triangles.begin(), triangles.end());
  tree.accelerate_distance_queries();
  double squared = 0;
  polyhedron.surface_candidates(
      spacing_mm, [&](const Point& p) { squared = std::max(squared, tree.squared_distance(to_cgal(p))); });
  gap.from_surface_mm = std::sqrt(squared);
  return gap;
}

}  // namespace scantet::bench
