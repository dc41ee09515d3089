// Slots of cells and vertices, and their numbers. The spheres of the cells, which a search for conflicts asks, are in
// cell_spheres.cpp.
#include <bit>
#include <cassert>
#include <numeric>

#include "scantet/base/parallel.h"
#include "scantet/delaunay/cell_set_impl.h"
#include "scantet/delaunay/predicates_impl.h"
#include "scantet/delaunay/triangulation_impl.h"

namespace scantet::engine {
namespace {

/// A little over what Delaunay triangulations of so many points of a domain have.
std::size_t cells_of(std::size_t vertices) {
  constexpr double kCellsPerVertex = 7.2;
  return static_cast<std::size_t>(kCellsPerVertex * static_cast<double>(vertices)) + 1024;
}

}  // namespace

Triangulation::Triangulation(const Box& bounds) {
  // A regular tet whose insphere has eight times the radius of the bounds.
  const double reach = 8 * std::max(0.5 * bounds.diagonal(), 1e-3);
  const Point center = bounds.center();
  const std::array<Vec, 4> directions{{{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}}};
  constexpr double kInradius = 0.577350269189625731;  // of the tet with those vertices: 1 / √3
  for (PointId v = 0; v < kCorners; ++v) {
    add_vertex();
    vertices_[v].point = center + (reach / kInradius) * directions[v];
  }
  add_cell();
  cells_[0].vertex = {0, 1, 2, 3};
  cells_[0].neighbor = {kNone, kNone, kNone, kNone};
  if (orientation(point(0), point(1), point(2), point(3)) < 0) std::swap(cells_[0].vertex[2], cells_[0].vertex[3]);
  find_spheres(std::array<CellId, 1>{0});
}

/// Adds a free slot at the end.
CellId Triangulation::add_cell() {
  add_cells(1);
  clear_cell(cell_slots() - 1);
  return cell_slots() - 1;
}

/// Adds slots at the end. Each is to be cleared, before it is used, by the thread that uses it.
void Triangulation::add_cells(std::size_t count) {
  const std::size_t slots = cells_.size() + count;
  cells_.resize(slots);
  if (!infos_.empty()) infos_.resize(slots);
}

/// Takes free slots, which are to be cleared like those of add_cells().
std::vector<CellId> Triangulation::take_cells(std::size_t count) {
  const std::size_t reused = std::min(count, free_cells_.size());
  std::vector<CellId> taken(free_cells_.end() - static_cast<std::ptrdiff_t>(reused), free_cells_.end());
  free_cells_.resize(free_cells_.size() - reused);
  taken.resize(count);
  std::iota(taken.begin() + static_cast<std::ptrdiff_t>(reused), taken.end(), cell_slots());
  add_cells(count - reused);
  return taken;
}

void Triangulation::clear_cell(CellId c) {
  cells_[c].vertex[0] = kNone;
  if (!infos_.empty()) infos_[c] = {};
}

bool Triangulation::is_on_boundary(CellId c) const {
  const auto& vertices = cells_[c].vertex;
  return std::all_of(vertices.begin(), vertices.end(), [&](PointId v) { return vertex_infos_[v].on_boundary(); });
}

void Triangulation::star_of(PointId v, std::vector<CellId>& star) const {
  assert(is_vertex(v) &&
         cells_[vertices_[v].cell].vertex[static_cast<std::size_t>(index_of(vertices_[v].cell, v))] == v);
  star.assign(1, vertices_[v].cell);
  thread_local CellSet seen;
  seen.clear();
  seen.insert(star.front());
  for (std::size_t done = 0; done < star.size(); ++done) {
    const Cell& cell = cells_[star[done]];
    for (std::size_t i = 0; i < 4; ++i) {
      if (cell.vertex[i] == v) continue;
      const CellId next = cell.neighbor[i] / 4;
      if (seen.contains(next)) continue;
      seen.insert(next);
      star.push_back(next);
    }
  }
}

void Triangulation::reserve(std::size_t vertices) {
  vertices_.reserve(kRoomAhead * vertices + kCorners);
  vertex_infos_.reserve(kRoomAhead * vertices + kCorners);
  cells_.reserve(kRoomAhead * cells_of(vertices));
  infos_.reserve(kRoomAhead * cells_of(vertices));
}

std::function<void(const std::atomic<bool>& enough)> Triangulation::populating(std::size_t vertices) {
  // The arrays' places are read here: whoever inserts meanwhile may move the arrays.
  return [cells = cells_.data(), cell_bytes = cells_of(vertices) * sizeof(Cell), infos = infos_.data(),
          info_bytes = cells_of(vertices) * sizeof(CellInfo)](const std::atomic<bool>& enough) {
    populate_pages(cells, cell_bytes, enough);
    populate_pages(infos, info_bytes, enough);
  };
}

PointId Triangulation::add_vertices(std::size_t count) {
  vertices_.resize(vertices_.size() + count);
  vertex_infos_.resize(vertices_.size());
  return vertex_slots() - static_cast<PointId>(count);
}

PointId Triangulation::add_vertex() {
  vertices_.push_back({});
  vertex_infos_.push_back({});
  return vertex_slots() - 1;
}

/// A new number for each cell, by its last vertex; kNone for free slots.
std::vector<CellId> Triangulation::numbers_by_place(CellId& count) const {
  constexpr std::size_t kGrain = 8192;
  std::vector<CellId> number(cells_.size());  // at first the last vertex
  parallel_for(cells_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const auto& v = cells_[c].vertex;
      number[c] = v[0] == kNone ? kNone : std::max({v[0], v[1], v[2], v[3]});
    }
  });
  std::vector<CellId> next(vertices_.size() + 1, 0);
  for (const PointId last : number) {
    if (last != kNone) ++next[last + 1];
  }
  for (std::size_t v = 1; v < next.size(); ++v) next[v] += next[v - 1];
  count = next.back();
  for (CellId& entry : number) {
    if (entry != kNone) entry = next[entry]++;
  }
  return number;
}

void Triangulation::renumber_cells() {
  constexpr std::size_t kGrain = 8192;
  CellId count = 0;
  const std::vector<CellId> number = numbers_by_place(count);
  struct Links {  // only these are copied: with the spheres, memory would hold each cell twice
    std::array<PointId, 4> vertex;
    std::array<FacetCode, 4> neighbor;
  };
  LargeVector<Links> moved;
  moved.resize(count);
  parallel_for(cells_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      if (number[c] == kNone) continue;
      Links links{cells_[c].vertex, cells_[c].neighbor};
      for (FacetCode& across : links.neighbor) {
        if (across != kNone) across = 4 * number[across / 4] + across % 4;
      }
      moved[number[c]] = links;
    }
  });
  cells_.resize(count);
  infos_.resize(count);
  free_cells_.clear();
  parallel_for(count, kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<CellId> cells;
    for (std::size_t c = begin; c < end; ++c) {
      cells_[c].vertex = moved[c].vertex;
      cells_[c].neighbor = moved[c].neighbor;
      infos_[c] = {};
      cells.push_back(static_cast<CellId>(c));
    }
    find_lasting_spheres(cells);
  });
  parallel_for(vertices_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = std::max<std::size_t>(begin, kCorners); v < end; ++v) {
      if (vertices_[v].cell != kNone) vertices_[v].cell = number[vertices_[v].cell];
    }
  });
}

bool Triangulation::in_conflict_exactly(CellId c, const WeightedPoint& p) const {
  if (p.weight == 0 && !may_have_weight(c)) return exact_in_sphere(points_of(c), p.point);
  return exact_in_orthosphere(weighted_points_of(c), p);
}

}  // namespace scantet::engine
