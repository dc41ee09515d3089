// After an insertion only the star of the new vertex is new: its cells are classified by a region query at their
// circumcentre, its facets by a crossing query along their dual edge. Both queries see the same end points from either
// side of a facet, so the two restrictions agree with each other as region_at and crossings do.
#include <algorithm>

#include "scantet/refine/circumcenter.h"
#include "scantet/refine/restricted_triangulation_impl.h"

namespace scantet::refine {

bool RestrictedTriangulation::build(const std::vector<SamplePoint>& points) {
  std::vector<std::pair<WeightedPoint, VertexInfo>> input;
  input.reserve(points.size());
  for (const SamplePoint& p : points) input.push_back({to_cgal(p.point), {0, kNone, p.on_boundary, false}});
  triangulation_.insert(input.begin(), input.end());
  if (triangulation_.dimension() < 3) return false;
  for (VertexHandle v : triangulation_.finite_vertex_handles()) set_vertex(v, v->info().on_boundary);
  for (CellHandle cell : triangulation_.all_cell_handles()) enter(cell);
  for (CellHandle cell : triangulation_.all_cell_handles()) {
    for (int i = 0; i < 4; ++i) {
      if (cell->info().slot < cell->neighbor(i)->info().slot) classify_facet(cell, i);
    }
  }
  return true;
}

void RestrictedTriangulation::set_vertex(VertexHandle vertex, bool on_boundary) {
  const BoundaryId boundary = on_boundary ? domain_.boundary_at(position(vertex)) : 0;
  vertex->info() = {boundary, static_cast<std::uint32_t>(vertex_count_++), on_boundary, false};
}

void RestrictedTriangulation::find_zone(const Point& p, CellHandle near, ConflictZone& zone) const {
  zone.cells.clear();
  zone.facets.clear();
  const WeightedPoint point = to_cgal(p);
  const auto search = [&](CellHandle start) {
    triangulation_.find_conflicts(point, start, std::back_inserter(zone.facets), std::back_inserter(zone.cells));
    return !zone.cells.empty();
  };
  if (search(near)) return;
  for (int i = 0; i < 4; ++i) {
    if (search(near->neighbor(i))) return;
  }
  Triangulation::Locate_type where;
  int li = 0;
  int lj = 0;
  const CellHandle found = triangulation_.locate(point, where, li, lj, near);
  if (where != Triangulation::VERTEX) search(found);
}

void RestrictedTriangulation::insert(const SamplePoint& p, const ConflictZone& zone) {
  for (CellHandle cell : zone.cells) {
    for (int i = 0; i < 4; ++i) remove_balls(cell, i);
    leave(cell);
  }
  const VertexHandle vertex = triangulation_.insert_in_hole(to_cgal(p.point), zone.cells.begin(), zone.cells.end(),
                                                            zone.facets.front().first, zone.facets.front().second);
  set_vertex(vertex, p.on_boundary);
  new_cells_.clear();
  new_balls_.clear();
  star_.clear();
  triangulation_.incident_cells(vertex, std::back_inserter(star_));
  for (CellHandle cell : star_) {
    enter(cell);
    for (int i = 0; i < 4; ++i) cell->vertex(i)->info().disk_checked = false;
  }
  for (CellHandle cell : star_) {
    const int outer = cell->index(vertex);
    for (int i = 0; i < 4; ++i) {
      if (i == outer || cell->info().slot < cell->neighbor(i)->info().slot) classify_facet(cell, i);
    }
  }
}

void RestrictedTriangulation::enter(CellHandle cell) {
  CellInfo& info = cell->info();
  if (free_cells_.empty()) {
    info.slot = static_cast<std::uint32_t>(cells_.size());
    cells_.emplace_back();
  } else {
    info.slot = free_cells_.back();
    free_cells_.pop_back();
  }
  cells_[info.slot] = {cell, ++last_serial_};
  new_cells_.push_back(info.slot);
  if (triangulation_.is_infinite(cell)) return;
  info.circumcenter = circumcenter(
      {position(cell->vertex(0)), position(cell->vertex(1)), position(cell->vertex(2)), position(cell->vertex(3))});
  info.region = domain_.region_at(info.circumcenter);
}

void RestrictedTriangulation::leave(CellHandle cell) {
  cells_[cell->info().slot].serial = 0;
  free_cells_.push_back(cell->info().slot);
}

void RestrictedTriangulation::remove_balls(CellHandle cell, int i) {
  std::uint32_t ball = cell->info().balls[static_cast<std::size_t>(i)];
  if (ball == kNone) return;
  const CellHandle neighbor = cell->neighbor(i);
  cell->info().balls[static_cast<std::size_t>(i)] = kNone;
  neighbor->info().balls[static_cast<std::size_t>(neighbor->index(cell))] = kNone;
  while (ball != kNone) {
    const std::uint32_t next = balls_[ball].next;
    balls_.remove(ball);
    ball = next;
  }
}

/// The dual edge of a facet, the same bits from either side. It lies on the line through the facet's circumcentre along
/// its normal. An end beyond the domain, at infinity or at the circumcentre of a nearly flat tet (which may be 1e16 mm
/// away), is cut off on that line, just outside of the bounds: a longer segment would have no digits left for the
/// domain.
Segment RestrictedTriangulation::dual(CellHandle cell, int i) const {
  const CellHandle neighbor = cell->neighbor(i);
  const Box bounds = domain_.bounds();
  const auto is_near = [&](CellHandle at) {
    return !triangulation_.is_infinite(at) &&
           squared_distance(at->info().circumcenter, bounds.center()) <= 4 * squared_length(bounds.extent());
  };
  const auto canonical = [](const Point& a, const Point& b) {
    return lexicographically_less(a, b) ? Segment{a, b} : Segment{b, a};
  };
  if (is_near(cell) && is_near(neighbor)) return canonical(cell->info().circumcenter, neighbor->info().circumcenter);

  auto v = facet_vertices(cell, i);
  std::sort(v.begin(), v.end(),
            [](VertexHandle a, VertexHandle b) { return lexicographically_less(position(a), position(b)); });
  const Point a = position(v[0]);
  const Point base = circumcenter(a, position(v[1]), position(v[2]));
  const Vec normal = cross(position(v[1]) - a, position(v[2]) - a);
  const double reach = (distance(base, bounds.center()) + bounds.diagonal()) / length(normal);
  const auto end_of = [&](CellHandle at, VertexHandle apex_across) {
    if (is_near(at)) return at->info().circumcenter;
    double side = 0;
    if (triangulation_.is_infinite(at)) {  // away from the tet across, which may be too flat for doubles to tell
      const auto apex_side = CGAL::orientation(v[0]->point().point(), v[1]->point().point(), v[2]->point().point(),
                                               apex_across->point().point());
      side = apex_side == CGAL::POSITIVE ? -1 : 1;
    } else {
      side = dot(normal, at->info().circumcenter - base);
    }
    return base + (side > 0 ? reach : -reach) * normal;
  };
  return canonical(end_of(cell, neighbor->vertex(neighbor->index(cell))), end_of(neighbor, cell->vertex(i)));
}

void RestrictedTriangulation::classify_facet(CellHandle cell, int i) {
  const CellHandle neighbor = cell->neighbor(i);
  if (triangulation_.is_infinite(cell, i)) return;
  domain_.crossings(dual(cell, i), crossings_);
  if (crossings_.empty()) return;
  const auto vertices = facet_vertices(cell, i);
  std::uint32_t next = kNone;
  for (auto crossing = crossings_.rbegin(); crossing != crossings_.rend(); ++crossing) {
    double squared_radius = squared_distance(crossing->point, position(vertices[0]));
    for (VertexHandle v : {vertices[1], vertices[2]}) {
      squared_radius = std::min(squared_radius, squared_distance(crossing->point, position(v)));
    }
    next = balls_.add({crossing->point, std::sqrt(squared_radius), domain_.boundary_at(crossing->point),
                       cell->info().slot, next, 0, static_cast<std::uint8_t>(i)});
  }
  cell->info().balls[static_cast<std::size_t>(i)] = next;
  neighbor->info().balls[static_cast<std::size_t>(neighbor->index(cell))] = next;
  new_balls_.push_back(next);
}

}  // namespace scantet::refine
