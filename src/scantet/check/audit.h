// The invariant checker: says of any mesh whether it is what TetMesh promises, and whether it represents its domain.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/progress.h"
#include "scantet/base/run_account.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/check/distance.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/region_grid.h"
#include "scantet/domain/sizing_field.h"

namespace SCANTET_API scantet {

class TetStars;

/// One thing that is wrong with a mesh.
struct Finding {
  std::string code;             ///< stable, "audit.orientation"; all are in finding_kinds()
  std::uint64_t count = 0;      ///< how many elements
  std::string message;          ///< for people: what, how many, the first of them and its value
  std::string remedy;           ///< what to do about it
  Point where;                  ///< the first of them, world mm
  std::vector<Point> places{};  ///< of each, the first 1,000 of them; `where` is the first
};

/// A kind of finding, in words.
struct FindingKind {
  const char* code;
  const char* what;  ///< plural noun phrase: "tets without positive volume"
  const char* remedy;
};

/// Everything the audit can find, one entry a code; lives as long as the program.
const std::vector<FindingKind>& finding_kinds();

/// Tets of one region that are connected through faces.
struct MeshComponent {
  Region region = kOutside;
  std::uint64_t tets = 0;
  double volume_mm3 = 0;
  Box box_mm;
  std::uint64_t surfaces = 0;       ///< connected pieces of its boundary
  std::int64_t boundary_euler = 0;  ///< V - E + F summed over them: 2 - 2·handles each
};

/// A closed piece of the boundary, as the component behind it or the cavity within it has it.
struct MeshSurface {
  std::uint32_t component = 0;  ///< index into AuditReport::components; 0 for a cavity's
  std::int64_t euler = 0;       ///< V - E + F: 2 - 2·handles if the boundary is manifold
  double volume_mm3 = 0;        ///< enclosed; negative if the component is around it
  Box box_mm;
};

/// The boundary facets between two regions.
struct MeshInterface {
  std::array<Region, 2> regions{};  ///< {behind, in front}, as in TetMesh::facet_regions
  std::uint64_t facets = 0;
  std::uint64_t surfaces = 0;  ///< connected through edges
  std::int64_t euler = 0;      ///< V - E + F
  double area_mm2 = 0;
  double min_angle_deg = 0;   ///< least angle of a facet
  double mean_angle_deg = 0;  ///< mean over the facets of each one's least angle
  double min_edge_mm = 0;     ///< shortest edge
  double mean_edge_mm = 0;    ///< mean over the sides of the facets
};

/// A region of a grid, a label of a segmentation, and what the mesh has of it.
struct KeptRegion {
  GridRegion grid;          ///< as the grid has it; of kOutside without a volume
  std::uint64_t parts = 0;  ///< connected parts of it in the grid; 0 for kOutside
  std::uint64_t kept = 0;   ///< nodes of it that lie in tets of the region, or for kOutside in none
  std::vector<Point> lost;  ///< others, in the order of the nodes, kMostLostNodes at most; world mm
};

inline constexpr std::size_t kMostLostNodes = 100'000;  ///< that are listed of a region

/// The nodes of a grid against the mesh.
struct RegionLedger {
  std::vector<KeptRegion> regions;  ///< ascending; the first is kOutside
  std::vector<GridPart> lost;       ///< parts of regions none of whose nodes lies in a tet of the region; no cavities
  std::vector<Point> missed;        ///< nodes that those parts lack, and parts of which the mesh has less than half
  std::vector<NarrowWay> broken;    ///< between nodes that are neighbours: what the mesh breaks of the regions
  std::vector<NarrowWay> contacts;  ///< where it parts what touches by edges or corners; not all lie in the region
};

/// What the domain says must be there, and what is not. A cavity without volume (voxels at the level itself, with none
/// below it) is not expected.
struct ComponentLedger {
  std::uint64_t expected_components = 0;
  std::uint64_t expected_cavities = 0;
  std::vector<Component> missing;  ///< that the mesh does not have
};

/// A component or cavity of the domain whose boundary has not as many handles in the mesh; or another Euler number,
/// where the domain does not know how many surfaces there are.
struct HandleDifference {
  Component component;         ///< as the domain has it
  std::int64_t euler = 0;      ///< of its boundary in the mesh: MeshComponent::boundary_euler
  std::uint64_t surfaces = 0;  ///< in the mesh
  std::int64_t handles() const { return static_cast<std::int64_t>(surfaces) - euler / 2; }  ///< in the mesh
};

/// Boundaries of components and cavities that the domain knows the Euler numbers of and that are one in the mesh, too:
/// each other one is missing, parted or joined, and another finding.
struct HandleLedger {
  std::uint64_t compared = 0;                    ///< components
  std::uint64_t compared_cavities = 0;           ///< not in the sums, as their boundaries are the components', too
  std::uint64_t unknown = 0;                     ///< components of which the domain does not know it
  std::int64_t expected_euler = 0;               ///< sum over those compared
  std::int64_t euler = 0;                        ///< the same in the mesh
  std::optional<std::int64_t> domain_euler;      ///< sum over all components of the domain, if it knows all
  std::optional<std::int64_t> expected_handles;  ///< sum over those compared, if the domain knows all
  std::int64_t handles = 0;                      ///< the same in the mesh
  std::vector<HandleDifference> different;       ///< components, then cavities, in the domain's order
};

/// What the audit takes for granted, and how exact it is.
struct AuditOptions {
  /// Largest Domain::residual_at of a boundary vertex.
  double max_residual = 1e-6;
  /// The mesh is a restricted Delaunay triangulation: every circumcentre lies in the region of its tet. False for
  /// meshes whose points were moved afterwards, and of domains with curves: then such tets are counted, but no finding.
  bool restricted_delaunay = true;
  /// Is shown what is checked now, with the share that is done. Null: nobody is. The audit cannot be cancelled.
  Progress* progress = nullptr;
  /// Of the mesh, if they are known; not kept. Null: they are found.
  const TetStars* stars = nullptr;
  /// Of the mesh from the domain, and the sizes that it was made for: a point of the domain's boundary that is farther
  /// from the mesh's than twice the size there is a finding. Null, either: no such check. The size is for curves, too.
  const BoundaryDistance* distance = nullptr;
  const SizingField* size = nullptr;
  /// What the domain was made from, if that is a grid of regions. Findings are parts of regions, and cavities, that the
  /// mesh has nothing of at its nodes; neighbours along an axis in several components, or nodes of a part that touch,
  /// if no plane cuts it; parts that do not touch in one; cavities that are open, or in one with others. Null: none.
  const RegionGrid* grid = nullptr;
};

/// What the audit found, and what it counted on the way.
struct AuditReport {
  std::vector<Finding> findings;
  /// False if the arrays do not even describe a mesh (findings say why): then nothing else was checked, all below is 0.
  bool complete = false;

  std::vector<MeshComponent> components;  ///< in the order of their first tets
  std::uint64_t vertex_components = 0;    ///< tets of one region connected through vertices: ≤ components.size()
  std::uint64_t boundary_components = 0;  ///< boundary facets connected through edges
  std::uint64_t cavities = 0;             ///< bounded pieces of the outside, by their walls
  std::vector<MeshSurface> surfaces;      ///< of every component, by their first facets
  std::vector<MeshSurface> cavity_walls;  ///< one a cavity, by their first facets
  std::vector<MeshInterface> interfaces;  ///< ascending by regions
  std::int64_t boundary_euler = 0;        ///< V - E + F of all boundary facets
  std::int64_t mesh_euler = 0;            ///< V - E + F - T; half of boundary_euler for a manifold of one region
  std::uint64_t boundary_vertices = 0;    ///< vertices of boundary facets
  std::uint64_t non_manifold_edges = 0;
  std::uint64_t non_manifold_vertices = 0;
  /// Whether every edge and vertex of the boundary is manifold.
  bool manifold() const { return non_manifold_edges == 0 && non_manifold_vertices == 0; }

  std::optional<double> max_residual;                 ///< over the boundary vertices, if the domain knows it
  std::optional<std::uint64_t> circumcentres_astray;  ///< tets with the circumcentre in another region; with a domain
  std::optional<ComponentLedger> ledger;              ///< if the domain knows its components
  std::optional<HandleLedger> handle_ledger;          ///< if it knows the Euler number of one that the mesh has
  std::optional<RegionLedger> region_ledger;          ///< if the audit was given a grid of regions

  std::vector<PhaseAccount> phases;  ///< what the audit's time was spent on, in order

  /// Whether nothing is wrong.
  bool passed() const { return findings.empty(); }
};

/// Checks a mesh; never throws for what is wrong with it. Return: what it found, in the order of the checks.
///
/// Of the mesh alone: arrays of matching lengths, finite coordinates, valid vertex ids; positive tets (exact signs);
/// every vertex used, no point, tet or facet twice; every face of one tet or of two on opposite sides of it;
/// boundary_facets are exactly the faces of one tet or between two regions, with those regions and oriented from
/// facet_regions[i][0] to [1]; the boundary of every region (and of the outside) is a manifold: two facets at each
/// edge, one fan at each vertex; no two facets cross (crossing_facets()); the vertices of boundary facets, and no
/// others, are on_boundary(). With a domain (else null): boundary vertices lie on its boundary, circumcentres in the
/// region of their tet (unless that is a matter of rounding), its components and cavities are there, each component
/// with the Euler number of its boundary (so that no handle is lost without a word), and its curves are followed by
/// edges (vertices within 1e-6 of its diagonal, joined from end to end; where sizes are given, edges with all of the
/// curve's regions around them, within a fifth of the size, may stand for several curves). A component is found through
/// Domain::patch_at of the mesh's boundary vertices, or through its box where the domain cannot tell its boundaries
/// apart; the counts must agree too.
///
/// domain: asked from several threads at once. Pre: the mesh is of first order (first_order()), else the nodes on its
/// edges count as unused vertices. Throws Error: input.too_large (2^27 tets or more). Guarantees: depends on what it is
/// given only, not on the number of threads, but for the times in `phases`. Shares no code with what builds meshes and
/// boundaries, but that improvement asks crossing_facets(), too. Takes 17 bytes per tet while it runs, beside what
/// vertices and facets take.
AuditReport audit(const TetMesh& mesh, const Domain* domain, const AuditOptions& options = {});

}  // namespace scantet
