// Elements of second order: tets of ten nodes that follow the curved boundary.
#pragma once

#include <cstdint>

#include "scantet/base/api.h"
#include "scantet/base/progress.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/domain/domain.h"

namespace SCANTET_API scantet {

/// Each Jacobian determinant of a tet with a curved edge is proved to be more than this share of the straight tet's.
inline constexpr double kLeastJacobianShare = 0.1;

/// What became of a mesh on its way to second order.
struct SecondOrderCounts {
  std::uint64_t edges = 0;           ///< of tets: as many nodes were added
  std::uint64_t boundary_edges = 0;  ///< of boundary facets
  std::uint64_t on_boundary = 0;     ///< of these, with their node on the domain's boundary or curve
  std::uint64_t off_boundary = 0;    ///< with none found near the middle of the edge: straight
  std::uint64_t eased_edges = 0;     ///< taken back toward the straight edge, for the sake of a tet
  std::uint64_t eased_tets = 0;      ///< tets for whose sake that was
  std::uint64_t unproved = 0;  ///< tets whose determinant is not proved positive; 0 if the straight ones are positive
  double least_share = 1;      ///< a bound below every determinant, as a share of its straight tet's
  double volume_mm3 = 0;       ///< of all elements, as they are curved; exact but for rounding
};

/// Gives each edge a node (TetMesh::tet_edge_vertices), behind the other vertices: edges inside in their middle; edges
/// of boundary facets where the domain's boundary crosses the line through their middle along the facets' mean normal,
/// nearest to the middle, within half the edge's length; edges of curves at the nearest point of the domain's curve, as
/// near. On flat parts, such as caps, that is the middle; where nothing is found, it is, too. A tet whose Jacobian
/// determinant is not proved to be above kLeastJacobianShare of the straight one's has the nodes of its edges moved
/// toward the middles in quarters of the way, until it is. Nodes have the strata of their edges.
///
/// Sets of vertices get the nodes of edges of curves whose ends they have, of boundary facets whose corners they have,
/// and of such tets that are not between boundary vertices alone. mesh: of first order, of the domain, tets positively
/// oriented, with patches, curves and strata. domain: asked from several threads. Return: what has become of the edges;
/// if cancelled before all nodes are found, nothing is counted and the mesh is left as it was (tet_edge_vertices is
/// empty).
/// Throws Error: mesh.order (Fault::internal: the mesh is of second order already), usage.order (it would have more
/// nodes than can be numbered); the mesh is as it was then. The result is the same for any number of threads.
SecondOrderCounts make_second_order(TetMesh& mesh, const Domain& domain, const Progress& progress);

/// The same of a mesh that is of second order already, as files hold such: `edges`, `boundary_edges` (those whose node
/// is on_boundary()), `unproved`, `least_share` (at most 0 if a straight tet is not positively oriented) and
/// `volume_mm3`; the rest is not known, and 0. Pre: mesh.tet_edge_vertices and mesh.strata are whole.
SecondOrderCounts measure_second_order(const TetMesh& mesh);

/// Volume of a mesh of either order, mm³: the sum of the signed volumes of its elements.
double curved_volume_mm3(const TetMesh& mesh);

}  // namespace scantet
