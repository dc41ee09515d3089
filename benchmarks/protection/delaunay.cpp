// CGAL's Delaunay triangulation: the methods without weights, and its speed.
#include <CGAL/Delaunay_triangulation_3.h>

#include "refiner_impl.h"

namespace scantet::bench {
namespace {

using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<int, Kernel>;
using CellBase =
    CGAL::Triangulation_cell_base_with_info_3<CellInfo, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Triangulation =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using Plain = CGAL::Delaunay_triangulation_3<Kernel>;

struct Access {
  static Kernel::Point_3 make(const MeshVertex& v) { return {v.point.x, v.point.y, v.point.z}; }
  static void find_conflicts(const Triangulation& t, const Point& p, Triangulation::Cell_handle from,
                             std::vector<Triangulation::Cell_handle>& zone) {
    std::vector<Triangulation::Facet> facets;
    const Kernel::Point_3 point{p.x, p.y, p.z};
    t.find_conflicts(point, t.locate(point, from), std::back_inserter(facets), std::back_inserter(zone));
  }
};

}  // namespace

Refined refine_delaunay(const Arrangement& domain, Method method, const RefinementBounds& bounds, unsigned seed) {
  return Refiner<Triangulation, Access>(domain, method, bounds).run(seed);
}

double delaunay_seconds(const std::vector<Point>& points) {
  std::vector<Kernel::Point_3> input;
  input.reserve(points.size());
  for (const Point& p : points) input.emplace_back(p.x, p.y, p.z);
  const auto start = std::chrono::steady_clock::now();
  const Plain triangulation(input.begin(), input.end());
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::size_t delaunay_cell_bytes() {
  return sizeof(Plain::Cell);
}

}  // namespace scantet::bench
