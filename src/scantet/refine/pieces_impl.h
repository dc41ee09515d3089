// Private: the cells of the triangulation in pieces of one region, joined by faces, and the surfaces between them.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "scantet/base/union_find.h"
#include "scantet/refine/boundary_link_impl.h"
#include "scantet/refine/restricted_triangulation_impl.h"

namespace scantet::refine {

/// The component of ∂O that a boundary facet approximates; none for one between tets that changed sides.
inline std::optional<BoundaryId> boundary_of(const RestrictedTriangulation& t, FacetCode facet) {
  const std::uint32_t ball = t.triangulation().info(facet / 4).balls[facet % 4];
  if (ball == kNone) return std::nullopt;
  return t.balls()[ball].boundary;
}

/// Whether each component of ∂O has one connected surface of facets. If there is a disk around every vertex of them,
/// too, no piece is a side piece: along such a surface the cells of a side are joined through faces.
bool has_one_surface_each(const RestrictedTriangulation& t, const std::vector<FacetCode>& facets);

/// Whether a disk around every vertex of the facets is known.
bool has_disks(const Triangulation& t, const std::vector<FacetCode>& facets);

/// Pieces of the inside and of the outside as they are when this is made. Pieces of one side that share a component of
/// ∂O belong to one component of that side of the domain, of which the largest piece is the main one.
class Pieces {
 public:
  Pieces(const RestrictedTriangulation& t, const std::vector<FacetCode>& facets);

  /// The piece of a cell: equal numbers, equal pieces.
  std::uint32_t of(CellId c) { return sets_.find(c); }

  /// Whether a larger piece of that side of a boundary facet has the same component of ∂O, too.
  bool is_side_piece(FacetCode facet);

 private:
  const RestrictedTriangulation& t_;
  UnionFind sets_;  // of cell slots
  std::map<std::pair<std::optional<BoundaryId>, Region>, std::uint32_t> main_;
};

}  // namespace scantet::refine
