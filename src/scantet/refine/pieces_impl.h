// Private: the cells of the triangulation in pieces of one region, joined by faces.
#pragma once

#include <map>
#include <vector>

#include "scantet/base/union_find.h"
#include "scantet/refine/restricted_triangulation_impl.h"

namespace scantet::refine {

/// Pieces of the inside and of the outside as they are when this is made. Pieces of one side that share a component of
/// ∂O belong to one component of that side of the domain, of which the largest piece is the main one.
class Pieces {
 public:
  explicit Pieces(const RestrictedTriangulation& t) : t_(t), sets_(t.slot_count()), size_(t.slot_count(), 0) {
    for (CellHandle cell : cells()) {
      for (int i = 0; i < 4; ++i) {
        const CellInfo& neighbor = cell->neighbor(i)->info();
        if (neighbor.region == cell->info().region) sets_.unite(cell->info().slot, neighbor.slot);
      }
    }
    for (CellHandle cell : cells()) ++size_[of(cell)];
    each_boundary_facet([&](CellHandle cell, int, BoundaryId boundary) {
      const std::uint32_t piece = of(cell);
      auto& main = main_.try_emplace({boundary, cell->info().region}, piece).first->second;
      if (size_[piece] > size_[main]) main = piece;
    });
  }

  /// The piece of a cell: equal numbers, equal pieces.
  std::uint32_t of(CellHandle cell) { return sets_.find(cell->info().slot); }

  /// Whether a larger piece of the cell's side has that component of ∂O, too.
  bool is_side_piece(CellHandle cell, BoundaryId boundary) {
    return main_.at({boundary, cell->info().region}) != of(cell);
  }

  /// visit(cell, i, boundary) for each facet between two regions, from either side.
  template <class Visit>
  void each_boundary_facet(Visit visit) const {
    for (CellHandle cell : cells()) {
      for (int i = 0; i < 4; ++i) {
        const std::uint32_t ball = cell->info().balls[static_cast<std::size_t>(i)];
        if (ball == kNone || cell->neighbor(i)->info().region == cell->info().region) continue;
        visit(cell, i, t_.balls()[ball].boundary);
      }
    }
  }

 private:
  Triangulation::All_cell_handles cells() const { return t_.triangulation().all_cell_handles(); }
  const RestrictedTriangulation& t_;
  UnionFind sets_;  // of slots
  std::vector<std::uint32_t> size_;
  std::map<std::pair<BoundaryId, Region>, std::uint32_t> main_;
};

}  // namespace scantet::refine
