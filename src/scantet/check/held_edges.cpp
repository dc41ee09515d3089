// A middle may lie on a face or an edge of tets, so places all around it are looked at, each in one tet or none.
#include <array>
#include <atomic>

#include "scantet/base/parallel.h"
#include "scantet/base/point_grid_impl.h"
#include "scantet/check/held_edges_impl.h"

namespace scantet::auditing {
namespace {

constexpr std::size_t kGrain = 1024;
constexpr double kBeside = 1e-7;  // steps of the grid
// Directions across an edge, along none that a mesh's faces would have.
constexpr std::array<std::array<double, 2>, 8> kAround{{{0.97, 0.26},
                                                        {0.53, 0.85},
                                                        {-0.24, 0.98},
                                                        {-0.84, 0.56},
                                                        {-0.96, -0.28},
                                                        {-0.55, -0.83},
                                                        {0.23, -0.96},
                                                        {0.86, -0.52}}};
constexpr unsigned kAll = 0xff;

using Corners = std::array<Vec, 4>;

/// Of the places around the middle of an edge, one bit each: whether it is in the tet.
unsigned places_in(const Corners& p, const GridCell& edge) {
  const std::size_t axis = edge.axis();
  unsigned bits = 0;
  for (unsigned n = 0; n < kAround.size(); ++n) {
    Vec place = edge.middle();
    place[(axis + 1) % 3] += kBeside * kAround[n][0];
    place[(axis + 2) % 3] += kBeside * kAround[n][1];
    if (is_in_tet(p, place)) bits |= 1U << n;
  }
  return bits;
}

Box box_of(const Corners& p) {
  Box box;
  for (const Vec& corner : p) box.extend(corner);
  return box.grown(kBeside);
}

}  // namespace

bool is_in_tet(const Corners& p, const Vec& place) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec& base = p[(i + 1) % 4];
    const Vec normal = cross(p[(i + 2) % 4] - base, p[(i + 3) % 4] - base);
    if (dot(normal, place - base) * dot(normal, p[i] - base) < 0) return false;
  }
  return true;
}

std::vector<GridCell> edges_not_held(const TetMesh& mesh, const Frame& frame, const std::vector<GridCell>& edges,
                                     const std::vector<Region>& regions) {
  if (edges.empty()) return {};
  std::vector<Point> middles;
  middles.reserve(edges.size());
  for (const GridCell& edge : edges) middles.push_back(edge.middle());
  const PointGrid grid(middles, 1);
  std::vector<unsigned> found(edges.size(), 0);
  parallel_for(mesh.tets.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      Corners p;
      for (std::size_t n = 0; n < 4; ++n) p[n] = frame.to_index(mesh.vertices[mesh.tets[t][n]]);
      grid.any_in(box_of(p), [&](std::uint32_t edge, const Point&) {
        if (regions[edge] == kOutside || regions[edge] == mesh.tet_regions[t]) {
          std::atomic_ref(found[edge]).fetch_or(places_in(p, edges[edge]), std::memory_order_relaxed);
        }
        return false;
      });
    }
  });
  std::vector<GridCell> left;
  for (std::size_t n = 0; n < edges.size(); ++n) {
    if (regions[n] == kOutside ? found[n] == kAll : found[n] == 0) left.push_back(edges[n]);
  }
  return left;
}

}  // namespace scantet::auditing
