// The steps of the audit. Private to check/.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "scantet/base/parallel.h"
#include "scantet/base/parallel_union_find.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/check/audit.h"
#include "scantet/domain/domain.h"
#include "scantet/quality/tet_stars.h"

namespace scantet::auditing {

inline constexpr std::uint32_t kNone = 0xffffffff;

/// Collects the elements of one kind of finding.
struct Tally {
  explicit Tally(const char* finding_code) : code(finding_code) {}

  const char* code;  ///< of finding_kinds()
  std::uint64_t count = 0;
  std::string first;          ///< names the first: "tet 17"
  std::vector<Point> places;  ///< as Finding has them

  /// describe(): the name of the element. Called for the first one only.
  template <typename Describe>
  void hit(const Point& place, const Describe& describe) {
    if (count == 0) first = describe();
    ++count;
    if (places.size() < kMostPlaces) places.push_back(place);
  }

  /// Adds what comes after, of the same kind.
  void add(const Tally& later) {
    if (count == 0) first = later.first;
    count += later.count;
    const std::size_t room = std::min(kMostPlaces - places.size(), later.places.size());
    places.insert(places.end(), later.places.begin(), later.places.begin() + static_cast<std::ptrdiff_t>(room));
  }

 private:
  static constexpr std::size_t kMostPlaces = 1000;
};

/// Tallies of the pieces of [0, count), one behind the other: body(begin, end, tally) looks at a piece, on several
/// threads.
template <class Body>
Tally parallel_tally(const char* code, std::size_t count, const Body& body) {
  constexpr std::size_t kPiece = 8192;
  std::vector<Tally> pieces((count + kPiece - 1) / kPiece, Tally(code));
  parallel_for(count, kPiece, [&](std::size_t begin, std::size_t end) { body(begin, end, pieces[begin / kPiece]); });
  Tally all(code);
  for (const Tally& piece : pieces) all.add(piece);
  return all;
}

/// Adds a finding if the tally counted anything.
void record(const Tally& tally, AuditReport& report);

inline std::string named(const char* element, std::size_t index) {
  return std::string(element) + " " + std::to_string(index);
}

/// A face of one tet, or between two of different regions, as the tets have it.
struct BoundaryFace {
  Triangle vertices;     ///< ascending
  std::uint32_t behind;  ///< the tet that stands for facet_regions[0]
  std::uint32_t front;   ///< the other tet, or kNone
  VertexId apex;         ///< the fourth vertex of `behind`
};

/// What matching the faces yields.
struct FaceMatch {
  std::vector<BoundaryFace> boundary;  ///< ascending by vertices
  ParallelUnionFind pieces;            ///< of tets: same region, connected through faces
  std::vector<std::uint8_t> repeated;  ///< one per tet: 1 if it has the vertices of an earlier tet
  std::uint64_t faces = 0;             ///< distinct faces
  std::uint64_t edges = 0;             ///< distinct edges
};

Point centroid(const TetMesh& mesh, std::uint32_t tet);
Point centroid(const TetMesh& mesh, const Triangle& triangle);

/// Array lengths, coordinates, vertex ids: true if the rest can be checked.
bool check_arrays(const TetMesh& mesh, AuditReport& report);
/// What looking at single elements yields.
struct ElementCounts {
  std::uint64_t used_vertices = 0;
  bool all_positive = false;  ///< whether every tet is positively oriented
};
/// Orientation, regions, unused vertices, points that coincide.
ElementCounts check_elements(const TetMesh& mesh, AuditReport& report);
/// Conformity. all_positive: whether every tet is positively oriented.
FaceMatch match_faces(const TetMesh& mesh, const TetStars& stars, bool all_positive, AuditReport& report);
/// boundary_facets, facet_regions and on_boundary against the faces.
void check_facets(const TetMesh& mesh, const FaceMatch& match, AuditReport& report);
/// Fills components with their regions.
/// Returns one per tet: the index of its component, kNone for a repeated tet.
std::vector<std::uint32_t> list_components(const TetMesh& mesh, FaceMatch& match, AuditReport& report);
/// Fills tets, volumes and boxes of components, and vertex_components. component_of: as list_components() gives it.
void measure_components(const TetMesh& mesh, const std::vector<std::uint32_t>& component_of, AuditReport& report);
/// The surfaces of the mesh's boundary as the outside has them.
struct OutsideSurfaces {
  std::vector<std::uint32_t> of_face;  ///< one per boundary face: its surface; kNone between two regions
  std::vector<std::int64_t> euler;     ///< one per surface: V - E + F
  std::vector<std::uint32_t> cavity;   ///< one per surface: the place in cavity_walls; kNone if it is no such wall
};

/// Manifoldness, boundary components, cavities, Euler numbers of boundaries.
OutsideSurfaces check_boundary(const TetMesh& mesh, const FaceMatch& match,
                               const std::vector<std::uint32_t>& component_of, AuditReport& report);
/// Fills interfaces.
void list_interfaces(const TetMesh& mesh, const FaceMatch& match, AuditReport& report);
/// Boundary facets must not cross. Not asked where an overlap has been found already.
void check_crossings(const TetMesh& mesh, AuditReport& report);
/// The domain's curves. boundary: the vertices of the mesh on it. size: as AuditOptions has it.
void check_curves(const TetMesh& mesh, const FaceMatch& match, const std::vector<VertexId>& boundary,
                  const Domain& domain, const SizingField* size, AuditReport& report);
/// The vertices of the boundary, ascending.
std::vector<VertexId> boundary_vertices(const TetMesh& mesh, const FaceMatch& match);
/// How far the vertices of the boundary are from the domain's.
void check_residuals(const TetMesh& mesh, const std::vector<VertexId>& boundary, const Domain& domain,
                     double max_residual, AuditReport& report);
/// finding: whether a circumcentre in another region is a fault.
void check_circumcentres(const TetMesh& mesh, const Domain& domain, bool finding, AuditReport& report);
/// The ledgers of components and handles. component_of: as list_components() gives it; outside: as check_boundary()
/// does.
void check_ledgers(const TetMesh& mesh, const FaceMatch& match, const std::vector<VertexId>& boundary,
                   const std::vector<std::uint32_t>& component_of, const OutsideSurfaces& outside, const Domain& domain,
                   AuditReport& report);

/// Places of the domain's boundary that are far from the mesh's beside the size.
void check_distance(const TetMesh& mesh, const Domain& domain, const BoundaryDistance& distance,
                    const SizingField& size, AuditReport& report);

/// Which nodes of the grid lie in tets of their regions, and whether its parts and cavities are the mesh's: fills
/// region_ledger. component_of: as list_components() gives it; outside: as check_boundary() does.
void check_regions(const TetMesh& mesh, const FaceMatch& match, const std::vector<std::uint32_t>& component_of,
                   const OutsideSurfaces& outside, const RegionGrid& grid, AuditReport& report);

/// A component of the domain, with patches of its boundary.
struct ListedComponent {
  Component component;
  std::vector<Patch> walls;
};
/// Which patch each vertex of the mesh's boundary lies on.
using VertexPatches = std::unordered_map<VertexId, Patch>;

/// Handles of the boundaries of components and cavities: fills handle_ledger. listed: of all regions; are_all: whether
/// the domain has no others; patches: if the domain tells its boundaries apart by them, else none.
void check_handles(const FaceMatch& match, const std::vector<std::uint32_t>& component_of,
                   const OutsideSurfaces& outside, const std::vector<ListedComponent>& listed, bool are_all,
                   const VertexPatches* patches, AuditReport& report);

}  // namespace scantet::auditing
