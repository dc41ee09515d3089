// Private: the cells of the triangulation in pieces of one region, joined by faces, and the surfaces between them.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "scantet/base/union_find.h"
#include "scantet/surface/boundary_link_impl.h"
#include "scantet/surface/restricted_triangulation_impl.h"

namespace scantet::engine {

/// The patch of ∂O that a boundary facet approximates; none for one between tets that changed sides.
inline std::optional<Patch> patch_of(const RestrictedTriangulation& t, FacetCode facet) {
  const std::uint32_t ball = t.triangulation().info(facet / 4).balls[facet % 4];
  if (ball == kNone) return std::nullopt;
  return t.balls()[ball].patch;
}

/// Whether each component of ∂O has one connected surface of facets. If there is also a disk around every vertex of
/// them, then no piece is a side piece: along such a surface the cells of a side are joined through faces.
bool has_one_surface_each(const RestrictedTriangulation& t, const std::vector<FacetCode>& facets);

/// Whether a disk around every vertex of the facets is known.
bool has_disks(const Triangulation& t, const std::vector<FacetCode>& facets);

/// The pieces of the inside and of the outside as they are when this is made. Pieces of one side that share a component
/// of ∂O belong to one component of that side of the domain; the largest of them is its main piece, and the others are
/// side pieces.
class Pieces {
 public:
  /// facets: all of the boundary. The more vertices are known to have a disk, the faster it is.
  Pieces(const RestrictedTriangulation& t, const std::vector<FacetCode>& facets);

  /// The piece of a cell. If the cell belongs to a side piece, no cell of another piece has the same number.
  std::uint32_t of(CellId c) { return owner_[c] == kNone ? kNone : sets_.find(owner_[c]); }

  /// The boundary facets as seen from side pieces, in the order they were given in.
  const std::vector<FacetCode>& side_facets() const { return side_facets_; }

  /// The cells of the side pieces, ascending.
  std::vector<CellId> side_cells();

 private:
  /// What is kept of a facet.
  struct Seen {
    std::uint32_t surface = kNone;
    std::optional<Patch> patch{};
    bool operator==(const Seen&) const = default;
  };
  struct Side {
    std::uint32_t side;
    Region region;
  };
  void find_surfaces(const std::vector<FacetCode>& facets);
  bool find_split_boundaries();
  void start(const std::vector<FacetCode>& facets);
  void own(CellId c, std::uint32_t side);
  void flood(std::uint32_t side, std::vector<CellId> front, std::optional<std::uint32_t> until);
  void measure();
  void find_side_facets(const std::vector<FacetCode>& facets);
  bool is_split(const Seen& seen) const { return seen.patch && split_.count(*seen.patch) > 0; }

  const RestrictedTriangulation& t_;
  std::vector<Seen> seen_;            // facet by facet
  std::set<Patch> split_;             // those with more than one surface
  UnionFind sets_;                    // sides in one piece: 2 · surface is its one side, 2 · surface + 1 the other
  std::vector<std::uint32_t> owner_;  // of each cell: a side that is in the same piece, if known
  std::vector<std::uint32_t> cells_;  // owned by each side
  std::map<Region, std::uint32_t> widest_;  // of each region: the side with the most facets
  std::vector<Side> sides_;
  std::vector<std::uint32_t> size_;  // of the piece, for each side that stands for its set
  std::vector<FacetCode> side_facets_;
};

}  // namespace scantet::engine
