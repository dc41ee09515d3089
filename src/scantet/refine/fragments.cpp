// A cell that changes sides may cut or join others, so the search is repeated until nothing changes. Cells that changed
// once stay: the process ends.
#include <set>

#include "scantet/refine/fragments_impl.h"
#include "scantet/refine/pieces_impl.h"

namespace scantet::refine {
namespace {

double volume_mm3(CellHandle cell) {
  return orientation_mm3(position(cell->vertex(0)), position(cell->vertex(1)), position(cell->vertex(2)),
                         position(cell->vertex(3))) /
         6;
}

}  // namespace

std::uint64_t absorb_fragments(const RestrictedTriangulation& triangulation, const SizingField& size, double alpha) {
  constexpr int kRounds = 10;
  std::set<std::uint32_t> changed;  // slots
  for (int round = 0; round < kRounds; ++round) {
    Pieces pieces(triangulation);
    std::map<std::uint32_t, Region> fragments;  // piece, the region around it
    pieces.each_boundary_facet([&](CellHandle cell, int i, BoundaryId boundary) {
      if (pieces.is_side_piece(cell, boundary)) {
        fragments.try_emplace(pieces.of(cell), cell->neighbor(i)->info().region);
      }
    });
    std::map<std::uint32_t, double> volume;
    std::vector<CellHandle> members;
    for (CellHandle cell : triangulation.triangulation().all_cell_handles()) {
      const auto fragment = fragments.find(pieces.of(cell));
      if (fragment == fragments.end()) continue;
      members.push_back(cell);
      const bool infinite = triangulation.triangulation().is_infinite(cell);
      volume[fragment->first] += infinite ? std::numeric_limits<double>::infinity() : volume_mm3(cell);
    }
    std::uint64_t moved = 0;
    std::vector<std::pair<CellHandle, Region>> moves;
    for (CellHandle cell : members) {
      const double side =
          triangulation.triangulation().is_infinite(cell) ? 0 : alpha * size.size_at(cell->info().circumcenter);
      const std::uint32_t piece = pieces.of(cell);
      if (volume.at(piece) < side * side * side) moves.push_back({cell, fragments.at(piece)});
    }
    for (const auto& [cell, region] : moves) {
      if (!changed.insert(cell->info().slot).second) continue;
      cell->info().region = region;
      ++moved;
    }
    if (moved == 0) break;
  }
  return changed.size();
}

}  // namespace scantet::refine
