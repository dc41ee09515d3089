// The boundary of a mesh, derived from its tets and their regions.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/tet_mesh.h"

namespace SCANTET_PROGRAM_API scantet {

/// One of the four faces of a tet.
struct TetFace {
  std::uint32_t tet;  ///< index into TetMesh::tets
  std::uint8_t face;  ///< 0 … 3: the face opposite to that vertex of the tet
};

/// The face's vertices so that their right-hand normal points out of the tet, if the tet is positively oriented.
Triangle face_of(const Tet& tet, int face);

/// Replaces boundary_facets, facet_regions and all that set_strata() sets by what tets and tet_regions say. Facets are
/// the faces that only one tet has, between its region and kOutside, and each face between two tets of different
/// regions a < b, once, from a to b. tet_regions must have one entry per tet; every vertex id must be below
/// vertices.size(). Facets point out of the region behind them, also where that tet is negatively oriented. A face
/// shared by more than two tets (which no mesh has, but some files do) is listed once, out of the tet with the smallest
/// index. Throws Error (input.too_large) from 2^30 tets on. Guarantees: facets start with their smallest vertex id and
/// are sorted by their vertex ids, so their order depends on the set of tets and not on the order of the tets. Runs
/// on several threads; takes 4 bytes per face.
void build_boundary(TetMesh& mesh);

/// Whether one of the vertices lies on a curve or at a corner. The rules are not asked of elements of a finished mesh
/// there: they are about radii of spheres that are orthogonal to the balls around curves, which the mesh does not know.
template <std::size_t Count>
bool touches_curve(const TetMesh& mesh, const std::array<VertexId, Count>& vertices) {
  for (const VertexId v : vertices) {
    if (mesh.strata[v].dimension < 2) return true;
  }
  return false;
}

/// Sets strata, patches, facet_patches, curves, curve_edges, edge_curves and corners by what the facets and the tets
/// say: a patch for each pair of regions, ascending; a curve for each set of regions that meet along edges, ascending,
/// where facets of more than one patch have an edge; a corner where a vertex has not two edges of one curve. Patches
/// that are there already keep their names. Every vertex id must be below vertices.size(). Meshes without junctions
/// take a few passes over tets and facets.
void set_strata(TetMesh& mesh);

/// For each vertex 1 if one of mesh.boundary_facets has it, else 0. Every vertex id of a facet must be below
/// vertices.size().
std::vector<std::uint8_t> vertices_of_boundary(const TetMesh& mesh);

/// For each of mesh.boundary_facets, in their order, the face of the tet of region facet_regions[i][0] behind it.
/// Throws Error (mesh.facet) if a facet is not a face of such a tet.
std::vector<TetFace> faces_behind_facets(const TetMesh& mesh);

/// The same of the tets of facet_regions[i][1] in front; a facet of the outside has none there, and gets face 4.
std::vector<TetFace> faces_before_facets(const TetMesh& mesh);

}  // namespace scantet
