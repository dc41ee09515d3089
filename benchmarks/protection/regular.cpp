// CGAL's regular triangulation: the method with weights, and what weights cost when all are zero.
#include <CGAL/Regular_triangulation_3.h>

#include "refiner_impl.h"

namespace scantet::bench {
namespace {

using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_3<int, Kernel, CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using CellBase = CGAL::Triangulation_cell_base_with_info_3<
    CellInfo, Kernel,
    CGAL::Regular_triangulation_cell_base_3<Kernel, CGAL::Triangulation_cell_base_3<Kernel>,
                                            CGAL::Discard_hidden_points>>;
using Triangulation = CGAL::Regular_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using Plain = CGAL::Regular_triangulation_3<Kernel>;

struct Access {
  static Kernel::Weighted_point_3 make(const MeshVertex& v) { return {{v.point.x, v.point.y, v.point.z}, v.weight}; }
  static void find_conflicts(const Triangulation& t, const Point& p, Triangulation::Cell_handle from,
                             std::vector<Triangulation::Cell_handle>& zone) {
    std::vector<Triangulation::Facet> facets;
    const Kernel::Weighted_point_3 point{{p.x, p.y, p.z}, 0};
    const Triangulation::Cell_handle cell = t.locate(point, from);
    if (t.side_of_power_sphere(cell, point) != CGAL::ON_BOUNDED_SIDE) return;
    t.find_conflicts(point, cell, std::back_inserter(facets), std::back_inserter(zone));
  }
};

}  // namespace

Refined refine_regular(const Arrangement& domain, const RefinementBounds& bounds, unsigned seed) {
  return Refiner<Triangulation, Access>(domain, Method::kWeights, bounds).run(seed);
}

double regular_seconds(const std::vector<Point>& points) {
  std::vector<Kernel::Weighted_point_3> input;
  input.reserve(points.size());
  for (const Point& p : points) input.emplace_back(Kernel::Point_3{p.x, p.y, p.z}, 0);
  const auto start = std::chrono::steady_clock::now();
  const Plain triangulation(input.begin(), input.end());
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::size_t regular_cell_bytes() {
  return sizeof(Plain::Cell);
}

}  // namespace scantet::bench
