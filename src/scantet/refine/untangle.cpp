// Around a vertex the tets of one side that are connected through faces form a group. The boundary is a disk there if
// and only if each side is one group: on the sphere around the vertex, two connected sets that fill it share one closed
// curve.
#include <algorithm>

#include "scantet/refine/untangle_impl.h"

namespace scantet::refine {
namespace {

constexpr int kRounds = 20;
constexpr std::uint8_t kMostChanges = 2;

double volume_mm3(const RestrictedTriangulation& t, CellHandle cell) {
  if (t.triangulation().is_infinite(cell)) return std::numeric_limits<double>::infinity();
  return orientation_mm3(position(cell->vertex(0)), position(cell->vertex(1)), position(cell->vertex(2)),
                         position(cell->vertex(3))) /
         6;
}

/// Whether all vertices lie on ∂O: then the tet can change sides without a vertex off ∂O coming to the surface.
bool is_on_surface(const RestrictedTriangulation& t, CellHandle cell) {
  if (t.triangulation().is_infinite(cell)) return false;
  for (int i = 0; i < 4; ++i) {
    if (!cell->vertex(i)->info().on_boundary) return false;
  }
  return true;
}

/// A group of tets of one side around a vertex.
struct Group {
  std::vector<CellHandle> cells;
  double volume = 0;
  bool on_surface = true;
  Region across = kOutside;  ///< the region beside it
};

/// The groups of the star, which is left in another order.
std::vector<Group> groups_of(const RestrictedTriangulation& t, VertexHandle v, std::vector<CellHandle>& star) {
  std::vector<Group> groups;
  while (!star.empty()) {
    Group group;
    group.cells.push_back(star.back());
    star.pop_back();
    for (std::size_t done = 0; done < group.cells.size(); ++done) {
      const CellHandle cell = group.cells[done];
      group.volume += volume_mm3(t, cell);
      group.on_surface = group.on_surface && is_on_surface(t, cell);
      for (int i = 0; i < 4; ++i) {
        const CellHandle neighbor = cell->neighbor(i);
        if (cell->vertex(i) == v) continue;
        if (neighbor->info().region != cell->info().region) {
          group.across = neighbor->info().region;
          continue;
        }
        const auto found = std::find(star.begin(), star.end(), neighbor);
        if (found == star.end()) continue;
        group.cells.push_back(neighbor);
        *found = star.back();
        star.pop_back();
      }
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace

std::uint64_t Untangler::run() {
  for (int round = 0; round < kRounds; ++round) {
    const bool absorbed = knows_components_ && absorb_fragments();
    const bool mended = mend_pinches();
    if (!absorbed && !mended) break;
  }
  return static_cast<std::uint64_t>(std::count_if(changes_.begin(), changes_.end(), [](auto n) { return n > 0; }));
}

bool Untangler::is_small(double volume_mm3, CellHandle cell) const {
  if (!std::isfinite(volume_mm3)) return false;
  const double side = alpha_ * size_.size_at(cell->info().circumcenter);
  return volume_mm3 < side * side * side;
}

bool Untangler::change(CellHandle cell, Region region) {
  std::uint8_t& changes = changes_[cell->info().slot];
  if (changes == kMostChanges) return false;
  ++changes;
  cell->info().region = region;
  return true;
}

/// Whether a vertex of the cell that is not on ∂O would come to the surface if the cell's piece changed sides.
bool Untangler::exposes_a_vertex(Pieces& pieces, CellHandle cell) {
  if (t_.triangulation().is_infinite(cell)) return true;
  for (int i = 0; i < 4; ++i) {
    const VertexHandle v = cell->vertex(i);
    if (v->info().on_boundary) continue;
    star_.clear();
    t_.triangulation().incident_cells(v, std::back_inserter(star_));
    for (CellHandle other : star_) {
      if (pieces.of(other) != pieces.of(cell)) return true;
    }
  }
  return false;
}

bool Untangler::absorb_fragments() {
  Pieces pieces(t_);
  std::map<std::uint32_t, Region> across;  // of each fragment
  pieces.each_boundary_facet([&](CellHandle cell, int i, BoundaryId boundary) {
    if (pieces.is_side_piece(cell, boundary)) across.try_emplace(pieces.of(cell), cell->neighbor(i)->info().region);
  });
  std::map<std::uint32_t, double> volume;
  std::vector<CellHandle> members;
  for (CellHandle cell : t_.triangulation().all_cell_handles()) {
    const std::uint32_t piece = pieces.of(cell);
    if (across.count(piece) == 0) continue;
    members.push_back(cell);
    volume[piece] += exposes_a_vertex(pieces, cell) ? std::numeric_limits<double>::infinity() : volume_mm3(t_, cell);
  }
  bool changed = false;
  for (CellHandle cell : members) {
    const std::uint32_t piece = pieces.of(cell);
    if (is_small(volume.at(piece), cell)) changed = change(cell, across.at(piece)) || changed;
  }
  return changed;
}

std::vector<VertexHandle> Untangler::boundary_vertices() const {
  std::vector<char> seen(t_.vertex_count(), 0);
  std::vector<VertexHandle> vertices;
  for (CellHandle cell : t_.triangulation().finite_cell_handles()) {
    for (int i = 0; i < 4; ++i) {
      if (cell->info().region == cell->neighbor(i)->info().region) continue;
      for (VertexHandle v : facet_vertices(cell, i)) {
        if (t_.triangulation().is_infinite(v) || seen[v->info().id] != 0) continue;
        seen[v->info().id] = 1;
        vertices.push_back(v);
      }
    }
  }
  // In an order that does not hang on how the triangulation keeps its cells.
  std::sort(vertices.begin(), vertices.end(),
            [](VertexHandle a, VertexHandle b) { return lexicographically_less(position(a), position(b)); });
  return vertices;
}

bool Untangler::mend_pinches() {
  bool changed = false;
  for (VertexHandle v : boundary_vertices()) changed = mend_around(v) || changed;
  return changed;
}

bool Untangler::mend_around(VertexHandle v) {
  star_.clear();
  t_.triangulation().incident_cells(v, std::back_inserter(star_));
  const std::vector<Group> groups = groups_of(t_, v, star_);
  if (groups.size() <= 2) return false;
  std::map<Region, int> groups_on_side;
  for (const Group& group : groups) ++groups_on_side[group.cells.front()->info().region];
  const Group* smallest = nullptr;
  for (const Group& group : groups) {
    if (groups_on_side[group.cells.front()->info().region] < 2 || !group.on_surface) continue;
    if (smallest == nullptr || group.volume < smallest->volume) smallest = &group;
  }
  if (smallest == nullptr || !is_small(smallest->volume, smallest->cells.front())) return false;
  bool changed = false;
  for (CellHandle cell : smallest->cells) changed = change(cell, smallest->across) || changed;
  return changed;
}

}  // namespace scantet::refine
