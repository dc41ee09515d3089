// Private: the cells of the triangulation in pieces of one region, joined by faces, and the surfaces between them.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "scantet/base/parallel_union_find.h"
#include "scantet/surface/boundary_surfaces_impl.h"

namespace scantet::engine {

/// The pieces of the inside and of the outside as they are when this is made. Pieces of one side that share a component
/// of ∂O belong to one component of that side of the domain; the largest of them is its main piece, and the others are
/// side pieces.
class Pieces {
 public:
  /// surfaces: of t, as it is now; only looked at while this is made. The more vertices are known to have a disk, the
  /// faster it is.
  Pieces(const RestrictedTriangulation& t, const BoundarySurfaces& surfaces);

  /// The piece of a cell. If the cell belongs to a side piece, no cell of another piece has the same number; kNone for
  /// most of the others.
  std::uint32_t of(CellId c) { return owner_.empty() || owner_[c] == kNone ? kNone : sets_.find(owner_[c]); }

  /// The boundary facets as seen from side pieces, in the order of the surfaces' facets.
  const std::vector<FacetCode>& side_facets() const { return side_facets_; }

  /// The cells of the side pieces, ascending.
  std::vector<CellId> side_cells();

 private:
  struct Side {
    std::uint32_t side;
    Region region;
  };
  void find_sides();
  void start();
  std::map<std::uint32_t, std::vector<CellId>> own_along(const std::vector<bool>& sides);
  bool own(CellId c, std::uint32_t side);
  void flood(std::uint32_t side, std::vector<CellId> front, std::optional<std::uint32_t> until);
  std::vector<std::uint32_t> owned_cells();
  template <class Is>
  std::vector<CellId> cells_where(const Is& is) const;
  void measure();
  void flood_widest(std::uint32_t widest);
  void find_side_facets();

  const Triangulation& t_;
  const BoundarySurfaces& surfaces_;
  ParallelUnionFind sets_{0};  // sides in one piece: 2 · surface is its one side, 2 · surface + 1 the other
  std::vector<std::uint32_t>
      owner_;  // of each cell: a side that is in the same piece, if known; none if no patch is split
  std::map<Region, std::uint32_t> widest_;  // of each region: the side with the most facets
  std::vector<Side> sides_;
  std::vector<std::uint32_t> size_;  // of the piece, for each side that stands for its set
  std::vector<FacetCode> side_facets_;
};

}  // namespace scantet::engine
