// Between nodes of one region each field is at most that of the region: linear along an edge, bilinear on a face,
// trilinear in a cube. So a cell all of whose nodes are in one region lies in it whole.
#include <algorithm>
#include <cmath>
#include <optional>

#include "scantet/base/parallel.h"
#include "scantet/check/broken_ways_impl.h"
#include "scantet/check/held_edges_impl.h"

namespace scantet::auditing {
namespace {

constexpr std::size_t kGrain = 1024;
constexpr double kTouch = 1e-6;  // voxels from a crossing to the next one, or to a node, if the boundary only touches

void keep_each_once(std::vector<GridCell>& cells) {
  parallel_sort(cells, std::less<>());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
}

class BrokenCells {
 public:
  BrokenCells(const TetMesh& mesh, const FaceMatch& match, const RegionGrid& grid, const GridNodes& nodes)
      : mesh_(mesh), match_(match), grid_(grid), nodes_(nodes) {
    for (int axis = 0; axis < 3; ++axis) {
      grid_box_.min[axis] = -1;
      grid_box_.max[axis] = grid.size[static_cast<std::size_t>(axis)];
    }
  }

  std::vector<GridCell> find() const {
    std::vector<GridCell> cells = lost_nodes();
    std::vector<GridCell> edges = crossed_edges();
    std::vector<GridCell> upper = cells_around(cells);
    upper.insert(upper.end(), edges.begin(), edges.end());
    keep_each_once(upper);
    for (int dimension = 1; dimension <= 3; ++dimension) {
      cells.insert(cells.end(), upper.begin(), upper.end());
      if (dimension == 3) break;
      upper = cells_around(upper);
      keep_each_once(upper);
    }
    return cells;
  }

 private:
  std::vector<GridCell> lost_nodes() const {
    const auto rows = static_cast<std::size_t>(grid_.size[1]) * static_cast<std::size_t>(grid_.size[2]);
    return parallel_collect<GridCell>(rows, kGrain,
                                      [&](std::size_t begin, std::size_t end, std::vector<GridCell>& out) {
                                        for (std::size_t row = begin; row < end; ++row) {
                                          const int j = static_cast<int>(row % static_cast<std::size_t>(grid_.size[1]));
                                          const int k = static_cast<int>(row / static_cast<std::size_t>(grid_.size[1]));
                                          nodes_.each_lost(j, k, [&](int i, Region region) {
                                            if (is_looked_at(region)) out.push_back({{2 * i, 2 * j, 2 * k}});
                                          });
                                        }
                                      });
  }

  /// Those that the boundary crosses, and does not only touch, and of those that it touches at a node those that are in
  /// another region.
  std::vector<GridCell> crossed_edges() const {
    auto crossings = parallel_collect<Crossing>(match_.boundary.size(), kGrain,
                                                [&](std::size_t begin, std::size_t end, std::vector<Crossing>& out) {
                                                  for (std::size_t f = begin; f < end; ++f)
                                                    add_crossings(match_.boundary[f], out);
                                                });
    parallel_sort(crossings, std::less<>());
    std::vector<GridCell> edges;
    std::vector<GridCell> at_nodes;
    for (std::size_t n = 0; n < crossings.size(); ++n) {
      if (crossings[n].at == std::round(crossings[n].at)) {
        at_nodes.push_back(crossings[n].edge);
        continue;
      }
      const bool touches = n + 1 < crossings.size() && crossings[n + 1].edge == crossings[n].edge &&
                           crossings[n + 1].at - crossings[n].at < kTouch;
      if (touches) {
        ++n;
      } else {
        edges.push_back(crossings[n].edge);
      }
    }
    keep_each_once(at_nodes);
    std::vector<Region> regions;
    regions.reserve(at_nodes.size());
    for (const GridCell& edge : at_nodes) regions.push_back(region_at({edge.first(0), edge.first(1), edge.first(2)}));
    for (const GridCell& edge : edges_not_held(mesh_, grid_.frame, at_nodes, regions)) edges.push_back(edge);
    return edges;
  }

  /// Of whole edges. One at a node, to a whole number, is of both edges there.
  void add_crossings(const BoundaryFace& face, std::vector<Crossing>& out) const {
    std::array<Vec, 3> p;
    for (std::size_t n = 0; n < 3; ++n) p[n] = grid_.frame.to_index(mesh_.vertices[face.vertices[n]]);
    std::vector<Crossing> crossings;
    auditing::add_crossings(p, grid_box_, crossings);
    for (Crossing& crossing : crossings) {
      const double node = std::round(crossing.at);
      if (std::abs(crossing.at - node) >= kTouch) {
        if (is_whole(crossing.edge)) out.push_back(crossing);
        continue;
      }
      const std::size_t axis = crossing.edge.axis();
      for (const int step : {-1, 1}) {
        crossing.edge.center[axis] = 2 * static_cast<int>(node) + step;
        if (is_whole(crossing.edge)) out.push_back({crossing.edge, node});
      }
    }
  }

  /// Those of a dimension more that these are part of.
  std::vector<GridCell> cells_around(const std::vector<GridCell>& cells) const {
    return parallel_collect<GridCell>(cells.size(), kGrain,
                                      [&](std::size_t begin, std::size_t end, std::vector<GridCell>& out) {
                                        for (std::size_t n = begin; n < end; ++n) add_around(cells[n], out);
                                      });
  }

  void add_around(const GridCell& cell, std::vector<GridCell>& out) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (cell.is_wide(axis)) continue;
      for (const int step : {-1, 1}) {
        GridCell around = cell;
        around.center[axis] += step;
        if (is_whole(around)) out.push_back(around);
      }
    }
  }

  /// Whether all its nodes are in one region, and that is looked at. Around the grid all is kOutside.
  bool is_whole(const GridCell& cell) const {
    std::optional<Region> region;
    for (int k = cell.first(2); k <= cell.last(2); ++k) {
      for (int j = cell.first(1); j <= cell.last(1); ++j) {
        for (int i = cell.first(0); i <= cell.last(0); ++i) {
          const Region here = region_at({i, j, k});
          if (!is_looked_at(here) || (region && *region != here)) return false;
          region = here;
        }
      }
    }
    return true;
  }

  Region region_at(const std::array<int, 3>& node) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (node[axis] < 0 || node[axis] >= grid_.size[axis]) return kOutside;
    }
    return nodes_.region_at(node[0], node[1], node[2]);
  }

  bool is_looked_at(Region region) const { return region != kOutside || !grid_.is_cut; }

  const TetMesh& mesh_;
  const FaceMatch& match_;
  const RegionGrid& grid_;
  const GridNodes& nodes_;
  Box grid_box_;  // with the nodes around it
};

/// Twice the area of a, b, c, looked at along the third axis.
double cross_of(const Vec& a, const Vec& b, const Vec& c, int u, int v) {
  return (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
}

/// The whole numbers that a triangle and a box have along an axis.
std::array<int, 2> lines_between(const std::array<Vec, 3>& p, const Box& box, int axis) {
  const auto [least, most] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
  const auto within = [&](double at) { return std::clamp(at, box.min[axis], box.max[axis]); };
  return {static_cast<int>(std::ceil(within(least - kNodeRounding))),
          static_cast<int>(std::floor(within(most + kNodeRounding)))};
}

/// Of edges along the axis.
void add_crossings(const std::array<Vec, 3>& p, int axis, const Box& box, std::vector<Crossing>& out) {
  // Lines of edges are asked beside where they are, so that none meets an edge of the mesh.
  constexpr double kBesideU = 0.6180339887e-9;
  constexpr double kBesideV = 0.7548776662e-9;
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const double area = cross_of(p[0], p[1], p[2], u, v);
  if (area == 0) return;
  const auto [first_u, last_u] = lines_between(p, box, u);
  const auto [first_v, last_v] = lines_between(p, box, v);
  Vec line;
  for (int b = first_v; b <= last_v; ++b) {
    line[v] = b + kBesideV;
    for (int a = first_u; a <= last_u; ++a) {
      line[u] = a + kBesideU;
      std::array<double, 3> shares{};
      for (std::size_t n = 0; n < 3; ++n) shares[n] = cross_of(line, p[(n + 1) % 3], p[(n + 2) % 3], u, v) / area;
      if (*std::min_element(shares.begin(), shares.end()) < 0) continue;
      const double at = shares[0] * p[0][axis] + shares[1] * p[1][axis] + shares[2] * p[2][axis];
      if (at < box.min[axis] || at > box.max[axis]) continue;
      Crossing crossing{{}, at};
      crossing.edge.center[static_cast<std::size_t>(axis)] = 2 * static_cast<int>(std::floor(at)) + 1;
      crossing.edge.center[static_cast<std::size_t>(u)] = 2 * a;
      crossing.edge.center[static_cast<std::size_t>(v)] = 2 * b;
      out.push_back(crossing);
    }
  }
}

}  // namespace

void add_crossings(const std::array<Vec, 3>& corners, const Box& box, std::vector<Crossing>& out) {
  for (int axis = 0; axis < 3; ++axis) add_crossings(corners, axis, box, out);
}

std::vector<GridCell> broken_cells(const TetMesh& mesh, const FaceMatch& match, const RegionGrid& grid,
                                   const GridNodes& nodes) {
  return BrokenCells(mesh, match, grid, nodes).find();
}

}  // namespace scantet::auditing
