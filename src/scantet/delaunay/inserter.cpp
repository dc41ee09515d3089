// The incremental algorithm (Bowyer, Watson): walk to the tet that contains the point, collect the tets in conflict
// around it, and join their outer facets to the point.
#include <cassert>

#include "scantet/delaunay/inserter_impl.h"
#include "scantet/delaunay/predicates_impl.h"

namespace scantet::engine {
namespace {

/// Whether the tet is positively oriented and its neighbours know it. Asserted of new tets.
[[maybe_unused]] bool is_sound(const Triangulation& t, CellId c) {
  const std::array<Point, 4> p = t.points_of(c);
  if (orientation(p[0], p[1], p[2], p[3]) <= 0) return false;
  for (FacetCode i = 0; i < 4; ++i) {
    const FacetCode across = t.cell(c).neighbor[i];
    if (across != kNone && t.cell(across / 4).neighbor[across % 4] != 4 * c + i) return false;
  }
  return true;
}

}  // namespace

Inserter::Inserter(Triangulation& triangulation) : t_(triangulation), parts_(nullptr), part_(kWhole) {}

Inserter::Inserter(Triangulation& triangulation, VertexParts& parts, PartId part, std::size_t cells,
                   std::size_t vertices)
    : t_(triangulation), parts_(&parts), part_(part) {
  while (free_cells_.size() < cells && !t_.free_cells_.empty()) {
    free_cells_.push_back(t_.free_cells_.back());
    t_.free_cells_.pop_back();
  }
  fresh_cell_ = t_.cell_slots();
  t_.add_cells(cells - free_cells_.size());
  fresh_end_ = t_.cell_slots();
  while (free_vertices_.size() < vertices) {
    if (t_.free_vertices_.empty()) {
      t_.free_vertices_.push_back(t_.add_vertex());
    }
    free_vertices_.push_back(t_.free_vertices_.back());
    t_.free_vertices_.pop_back();
  }
}

void Inserter::retire() {
  while (fresh_cell_ < fresh_end_) {
    t_.clear_cell(--fresh_end_);
    t_.free_cells_.push_back(fresh_end_);
  }
  t_.free_cells_.insert(t_.free_cells_.end(), free_cells_.rbegin(), free_cells_.rend());
  t_.free_vertices_.insert(t_.free_vertices_.end(), free_vertices_.rbegin(), free_vertices_.rend());
  free_cells_.clear();
  free_vertices_.clear();
}

/// Whether the tet across facet i has a vertex of the part.
bool Inserter::may_cross(const Cell& cell, int i) const {
  if (part_ == kWhole) return true;
  for (const PointId v : facet_vertices(cell, i)) {
    if (v >= Triangulation::kCorners && (*parts_)[v] == part_) return true;
  }
  return false;
}

/// The visibility walk: through a facet that parts the cell from p, until there is none. On a Delaunay triangulation it
/// ends.
Inserter::Found Inserter::locate(const Point& p, CellId from) {
  assert(t_.is_cell(from));
  CellId c = from;
  int came_through = -1;
  while (true) {
    const Cell& cell = t_.cells_[c];
    const std::array<Point, 4> points = t_.points_of(c);
    bool blocked = false;
    int next = -1;
    for (int i = 0; i < 4 && next < 0; ++i) {
      if (i == came_through) continue;
      std::array<Point, 4> seen = points;
      seen[static_cast<std::size_t>(i)] = p;
      if (orientation(seen[0], seen[1], seen[2], seen[3]) >= 0) continue;
      if (may_cross(cell, i)) {
        next = i;
      } else {
        blocked = true;
      }
    }
    if (next < 0) {
      last_seen_ = c;
      if (blocked) return Found::beyond;
      return std::find(points.begin(), points.end(), p) == points.end() ? Found::zone : Found::vertex;
    }
    const FacetCode across = cell.neighbor[static_cast<std::size_t>(next)];
    c = across / 4;
    came_through = static_cast<int>(across % 4);
  }
}

Inserter::Found Inserter::find_zone(const Point& p, CellId near, ConflictZone& zone, double weight) {
  zone.cells.clear();
  zone.facets.clear();
  if (near == kNone || !t_.is_cell(near)) near = last_cell_;
  if (near == kNone || !t_.is_cell(near)) {
    for (near = 0; !t_.is_cell(near);) ++near;
  }
  last_seen_ = near;
  if (!t_.in_conflict(near, p, weight)) {
    const Found found = locate(p, near);
    if (found != Found::zone) return found;
    // The cell that contains a point is in conflict with it, but for one that balls hide.
    if (t_.has_weights() && !t_.in_conflict(last_seen_, p, weight)) return Found::vertex;
  }
  if (!grow({p, weight}, last_seen_, zone)) return Found::beyond;
  for (const CellId c : zone.cells) {  // the zone is whole: now its vertices can be compared with the point
    for (const PointId v : t_.cells_[c].vertex) {
      if (t_.point(v) == p) return Found::vertex;
      if (t_.has_weights() && squared_distance(t_.point(v), p) < t_.weight(v)) return Found::vertex;
    }
  }
  return Found::zone;
}

/// Collects the tets in conflict, which are connected. Returns false if the part does not own them all.
bool Inserter::grow(const WeightedPoint& p, CellId start, ConflictZone& zone) {
  const auto add = [&](CellId c) {
    in_zone_.insert(c);
    zone.cells.push_back(c);
    for (const FacetCode across : t_.cells_[c].neighbor) {  // these are looked at soon
      if (across != kNone) __builtin_prefetch(&t_.cells_[across / 4]);
    }
  };
  in_zone_.clear();
  if (!owns(start)) return false;
  add(start);
  for (std::size_t done = 0; done < zone.cells.size(); ++done) {
    const CellId c = zone.cells[done];
    for (std::uint32_t i = 0; i < 4; ++i) {
      const FacetCode across = t_.cells_[c].neighbor[i];
      const CellId next = across / 4;
      if (across != kNone && in_zone_.contains(next)) continue;
      if (across == kNone || !t_.in_conflict(next, p.point, p.weight)) {
        zone.facets.push_back(4 * c + i);
        continue;
      }
      if (!owns(next)) return false;
      add(next);
    }
  }
  return true;
}

bool Inserter::has_room_for(const ConflictZone& zone) const {
  return part_ == kWhole || free_cells_.size() + (fresh_end_ - fresh_cell_) >= zone.facets.size();
}

PointId Inserter::take_vertex() {
  assert(has_vertex());
  std::vector<PointId>& from = part_ == kWhole ? t_.free_vertices_ : free_vertices_;
  if (from.empty()) return t_.add_vertex();
  const PointId v = from.back();
  from.pop_back();
  return v;
}

CellId Inserter::take_cell() {
  std::vector<CellId>& from = part_ == kWhole ? t_.free_cells_ : free_cells_;
  if (!from.empty()) {
    const CellId c = from.back();
    from.pop_back();
    return c;
  }
  if (part_ == kWhole) return t_.add_cell();
  assert(fresh_cell_ < fresh_end_);
  t_.clear_cell(fresh_cell_);
  return fresh_cell_++;
}

void Inserter::insert(PointId v, const ConflictZone& zone) {
  assert(zone.facets.size() >= 4 && zone.facets.size() % 2 == 0);  // they are the triangles of a sphere
  new_cells_.clear();
  if (parts_ != nullptr) (*parts_)[v] = part_;
  for (const FacetCode inner : zone.facets) {
    const CellId fresh = take_cell();
    const std::uint32_t i = inner % 4;
    Cell& cell = t_.cells_[fresh];
    Cell& old = t_.cells_[inner / 4];
    cell.vertex = old.vertex;
    cell.vertex[i] = v;
    cell.neighbor = {kNone, kNone, kNone, kNone};
    cell.neighbor[i] = old.neighbor[i];
    if (old.neighbor[i] != kNone) t_.cells_[old.neighbor[i] / 4].neighbor[old.neighbor[i] % 4] = 4 * fresh + i;
    old.neighbor[i] = 4 * fresh + i;  // where linking finds the new tet behind an outer facet
    for (const PointId corner : cell.vertex) {
      if (corner >= Triangulation::kCorners) t_.vertices_[corner].cell = fresh;
    }
    new_cells_.push_back(fresh);
  }
  if (!link_by_edges(zone)) {
    for (std::size_t k = 0; k < new_cells_.size(); ++k) link_by_turning(v, zone.facets[k], new_cells_[k]);
  }
  std::vector<CellId>& free = part_ == kWhole ? t_.free_cells_ : free_cells_;
  for (const CellId c : zone.cells) {
    t_.cells_[c].vertex[0] = kNone;
    free.push_back(c);
  }
  last_cell_ = new_cells_.front();
  assert(std::all_of(new_cells_.begin(), new_cells_.end(), [&](CellId c) { return is_sound(t_, c); }));
}

/// Joins the new tets to each other: each edge of an outer facet is also the edge of exactly one other outer facet, in
/// the other direction. Returns false if there are too many vertices for the table of edges.
bool Inserter::link_by_edges(const ConflictZone& zone) {
  // The third index so that those of a facet, of a tet's new vertex and of it form an even permutation with the fourth.
  constexpr std::array<std::array<std::uint8_t, 4>, 4> kThird{{{4, 2, 3, 1}, {3, 4, 0, 2}, {1, 3, 4, 0}, {2, 0, 1, 4}}};
  edges_.clear();
  ends_.clear();
  for (std::size_t n = 0; n < new_cells_.size(); ++n) {
    const std::uint32_t outer = zone.facets[n] % 4;
    const auto& vertex = t_.cells_[new_cells_[n]].vertex;
    std::array<EdgeTable::Number, 4> number{};
    for (std::uint32_t j = 0; j < 4; ++j) {
      if (j != outer) number[j] = edges_.number_of(vertex[j]);
      if (number[j] == EdgeTable::kMost) return false;
    }
    for (std::uint32_t j = 0; j < 4; ++j) {
      if (j == outer) continue;
      const std::uint32_t from = kThird[outer][j];
      const std::uint32_t to = 6 - outer - j - from;
      edges_.facet(number[from], number[to]) = 4 * new_cells_[n] + j;
      ends_.push_back({number[from], number[to]});
    }
  }
  auto ends = ends_.begin();
  for (std::size_t n = 0; n < new_cells_.size(); ++n) {
    for (std::uint32_t j = 0; j < 4; ++j) {
      if (j == zone.facets[n] % 4) continue;
      t_.cells_[new_cells_[n]].neighbor[j] = edges_.facet((*ends)[1], (*ends)[0]);
      ++ends;
    }
  }
  return true;
}

/// Joins a new tet to its three neighbours among the new ones: around each edge of its outer facet it turns through the
/// zone, until it comes to the other outer facet at that edge.
void Inserter::link_by_turning(PointId v, FacetCode inner, CellId fresh) {
  for (std::uint32_t j = 0; j < 4; ++j) {
    if (j == inner % 4 || t_.cells_[fresh].neighbor[j] != kNone) continue;
    CellId at = inner / 4;
    std::uint32_t entered = inner % 4;
    std::uint32_t cross = j;
    FacetCode across = t_.cells_[at].neighbor[cross];
    while (t_.cells_[across / 4].vertex[across % 4] != v) {  // not yet the outer facet of a new tet
      const PointId behind = t_.cells_[at].vertex[entered];
      at = across / 4;
      entered = across % 4;
      cross = static_cast<std::uint32_t>(t_.index_of(at, behind));
      across = t_.cells_[at].neighbor[cross];
    }
    t_.cells_[fresh].neighbor[j] = 4 * (across / 4) + entered;
    t_.cells_[across / 4].neighbor[entered] = 4 * fresh + j;
  }
}

}  // namespace scantet::engine
