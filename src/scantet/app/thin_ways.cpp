// In a cell the field is trilinear, so a spike or a sheet that goes on from cell to cell has nodes of the grid in it,
// and the edges between these: along an edge the field is linear, and ends of one sign have no crossing between them.
// A spike that ends between nodes is reached from the node that sees its end.
#include "scantet/app/thin_ways.h"

#include <algorithm>

#include "scantet/domain/boundary_cells.h"

namespace scantet {
namespace {

/// Leaves one of those that have the same name.
void keep_each_once(std::vector<BoundaryCell>& cells) {
  const auto order = [](const BoundaryCell& a, const BoundaryCell& b) { return a.id < b.id; };
  const auto same = [](const BoundaryCell& a, const BoundaryCell& b) { return a.id == b.id; };
  std::stable_sort(cells.begin(), cells.end(), order);
  cells.erase(std::unique(cells.begin(), cells.end(), same), cells.end());
}

/// corner: bit n is set at the far end of edges[n].
Point corner_of(const BoundaryCell& cell, unsigned corner) {
  Point p = cell.corner;
  for (unsigned axis = 0; axis < 3; ++axis) {
    if ((corner >> axis & 1U) != 0) p = p + cell.edges[axis];
  }
  return p;
}

/// The edges of a cell whose ends have heights of one sign.
void add_edges(const BoundaryCell& cell, std::vector<Segment>& segments) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      const unsigned end = corner | 1U << axis;
      if (end == corner || cell.heights[corner] * cell.heights[end] <= 0) continue;
      segments.push_back({corner_of(cell, corner), corner_of(cell, end)});
    }
  }
}

/// From near p to the corners of a cell that are not near.
void add_ways_to_corners(const BoundaryCell& cell, const Point& p, double near_mm, std::vector<Segment>& segments) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Point end = corner_of(cell, corner);
    const double way_mm = distance(p, end);
    if (way_mm > near_mm) segments.push_back({lerp(p, end, near_mm / way_mm), end});
  }
}

}  // namespace

std::vector<NarrowWay> ways_to(const Domain& domain, std::span<const Point> places, double near_mm) {
  const BoundaryCells* const cells = domain.boundary_cells();
  if (cells == nullptr) return {};
  std::vector<BoundaryCell> around;  // those that hold a place, and those beside them
  std::vector<Segment> to_corners;
  for (const Point& p : places) {
    double reach_mm = 0;
    for (const BoundaryCell& cell : cells_in_box(*cells, {p, p})) {
      for (const Vec& edge : cell.edges) reach_mm = std::max(reach_mm, length(edge));
      add_ways_to_corners(cell, p, near_mm, to_corners);
    }
    const std::vector<BoundaryCell> beside = cells_in_box(*cells, Box{p, p}.grown(reach_mm));
    around.insert(around.end(), beside.begin(), beside.end());
  }
  keep_each_once(around);
  std::vector<Segment> segments;
  for (const BoundaryCell& cell : around) add_edges(cell, segments);
  segments.insert(segments.end(), to_corners.begin(), to_corners.end());
  CrossingLists crossings;
  domain.crossings_of(segments, crossings);
  std::vector<NarrowWay> ways;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (crossings[i].empty()) ways.push_back({domain.region_at(segments[i].source), segments[i]});
  }
  return ways;
}

}  // namespace scantet
