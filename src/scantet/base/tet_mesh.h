// The finished mesh: plain arrays.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/geometry.h"
#include "scantet/base/stratum.h"

namespace SCANTET_API scantet {

/// A vertex by its place in TetMesh::vertices.
using VertexId = std::uint32_t;
using Tet = std::array<VertexId, 4>;
using Triangle = std::array<VertexId, 3>;

/// The boundary facets between two regions, or a part of them that has a name of its own.
struct MeshPatch {
  std::array<Region, 2> regions{};  ///< {behind, in front}, as in TetMesh::facet_regions
  std::string name;                 ///< the domain's; empty: patch_name() makes one
};

/// Edges where three or more regions meet, or where the boundary between two is to be sharp.
struct MeshCurve {
  std::vector<Region> regions;  ///< around it, ascending, kOutside among them if it is
  std::string name;             ///< the domain's; empty: none
  bool is_sharp = false;        ///< two regions only: the mesh alone does not tell that it is a curve
};

/// A named place: what a solver holds, loads or looks at. Vertices, tets and boundary facets by index, each list
/// ascending and without repeats; a list that was not asked for is empty.
struct MeshSet {
  std::string name;
  std::vector<VertexId> vertices;
  std::vector<std::uint32_t> facets;  ///< of TetMesh::boundary_facets
  std::vector<std::uint32_t> tets;    ///< of TetMesh::tets
};

/// One number a tet, such as the mean of a scan over it.
struct MeshField {
  std::string name;
  std::vector<double> values;  ///< one per tet, in the scan's unit
};

/// Isotropic and linear; in millimetres, newtons, seconds and tonnes, which go together.
struct MeshMaterial {
  std::string name;
  double youngs_modulus_mpa = 0;     ///< > 0
  double poissons_ratio = 0;         ///< in (-1, 0.5)
  double density_tonne_per_mm3 = 0;  ///< >= 0; 0: not known
};

/// A tetrahedral mesh with its boundary.
///
/// Guarantees of a mesh made by scantet (the audit in check/ tests them): tets are positively oriented
/// (det(b-a, c-a, d-a) > 0); every vertex belongs to a tet; a boundary facet lies between two regions, appears once and
/// is oriented so that its right-hand normal points out of facet_regions[i][0] into facet_regions[i][1].
struct TetMesh {
  std::vector<Point> vertices;                       ///< world mm (LPS for images)
  std::vector<Tet> tets;                             ///< four vertex ids each
  std::vector<Region> tet_regions;                   ///< one per tet, never kOutside
  std::vector<Triangle> boundary_facets;             ///< three vertex ids each
  std::vector<std::array<Region, 2>> facet_regions;  ///< {behind, in front}; behind is never kOutside

  /// One per vertex. Its index: dimension 3, the region; 2, of `patches`; 1, of `curves`; 0, of `corners`.
  std::vector<Stratum> strata;
  std::vector<MeshPatch> patches;
  std::vector<std::uint32_t> facet_patches;  ///< one per boundary facet: of `patches`
  std::vector<MeshCurve> curves;
  std::vector<std::array<VertexId, 2>> curve_edges;
  std::vector<std::uint32_t> edge_curves;  ///< one per curve edge: of `curves`
  std::vector<VertexId> corners;

  std::map<Region, std::string> region_names;  ///< the domain's; for others region_name() makes one

  /// Elements of second order: one per tet, the vertices on its edges 01, 12, 02, 03, 13, 23 (VTK's order). Empty: the
  /// mesh is of first order. Checks and measures are for meshes of first order: first_order() makes one of it.
  std::vector<std::array<VertexId, 6>> tet_edge_vertices;

  /// Read from a file: its cells of three dimensions that are no tets, and so are not in this mesh.
  std::uint64_t other_solids = 0;

  std::vector<MeshSet> sets;      ///< names differ
  std::vector<MeshField> fields;  ///< names differ
  std::vector<MeshMaterial> materials;
  std::vector<std::uint32_t> tet_materials;  ///< one per tet, of `materials`; empty if these are

  /// Whether the vertex lies on the boundary of a region. Pre: strata has it.
  bool on_boundary(VertexId v) const { return strata[v].on_boundary(); }
};

/// The mesh's name for the region; without one, "region_3".
std::string region_name(const TetMesh& mesh, Region region);

/// The patch's name; without one, its regions', behind and in front: "boundary_3_0".
std::string patch_name(const MeshPatch& patch);
/// The curve's name; without one, its regions': "curve_0_1_2".
std::string curve_name(const MeshCurve& curve);

/// Six times the signed volume of the tet (a, b, c, d), mm³; positive if positively oriented. The sign is not exact.
inline double orientation_mm3(const Point& a, const Point& b, const Point& c, const Point& d) {
  return dot(b - a, cross(c - a, d - a));
}

}  // namespace scantet
