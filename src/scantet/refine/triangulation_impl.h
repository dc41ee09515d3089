// Private: the triangulation type, and what the mesher keeps on its vertices and cells.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <array>
#include <cstdint>

#include "scantet/base/tet_mesh.h"
#include "scantet/domain/domain.h"

namespace scantet::refine {

inline constexpr std::uint32_t kNone = 0xffffffff;

struct VertexInfo {
  BoundaryId boundary = 0;   ///< which component of ∂O, for a boundary vertex
  std::uint32_t id = kNone;  ///< number of the point in order of insertion
  bool on_boundary = false;
  bool disk_checked = false;  ///< its boundary facets form a disk and have not changed since
};

struct CellInfo {
  Point circumcenter;                                              ///< of a finite cell
  Region region = kOutside;                                        ///< at the circumcentre; infinite cells are outside
  std::uint32_t slot = kNone;                                      ///< in RestrictedTriangulation's table of cells
  std::array<std::uint32_t, 4> balls{kNone, kNone, kNone, kNone};  ///< first surface ball of each facet, if any
};

/// Stands in for the list of hidden points that CGAL would keep in each cell: weights are zero, none is ever hidden.
template <class WeightedPoint>
using NoPoints = std::array<WeightedPoint, 0>;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using WeightedPoint = Kernel::Weighted_point_3;
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_3<VertexInfo, Kernel, CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using CellBase = CGAL::Regular_triangulation_cell_base_3<
    Kernel, CGAL::Triangulation_cell_base_with_info_3<CellInfo, Kernel, CGAL::Triangulation_ds_cell_base_3<>>,
    CGAL::Discard_hidden_points, NoPoints<WeightedPoint>>;
using Triangulation = CGAL::Regular_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using CellHandle = Triangulation::Cell_handle;
using VertexHandle = Triangulation::Vertex_handle;
using Facet = Triangulation::Facet;

inline WeightedPoint to_cgal(const Point& p) {
  return WeightedPoint(Kernel::Point_3(p.x, p.y, p.z), 0);
}
inline Point position(VertexHandle v) {
  return {v->point().x(), v->point().y(), v->point().z()};
}

/// The three vertices of the facet opposite to vertex i of a cell.
inline std::array<VertexHandle, 3> facet_vertices(CellHandle cell, int i) {
  return {cell->vertex((i + 1) & 3), cell->vertex((i + 2) & 3), cell->vertex((i + 3) & 3)};
}

}  // namespace scantet::refine
