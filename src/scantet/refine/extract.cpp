// Vertices are numbered along a Morton curve, so that neighbours in space are neighbours in memory; a tet starts with
// its smallest vertex and tets are sorted. Nothing depends on the order in which the triangulation keeps its cells.
#include <algorithm>
#include <vector>

#include "scantet/base/mesh_topology.h"
#include "scantet/refine/extract_impl.h"

namespace scantet::refine {
namespace {

/// Interleaves 21 bits of each coordinate within the box.
std::uint64_t morton(const Point& p, const Box& box) {
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = std::max(box.extent()[axis], std::numeric_limits<double>::min());
    auto bits = static_cast<std::uint64_t>((p[axis] - box.min[axis]) / extent * 2097151.0);
    bits = (bits | bits << 32) & 0x1f00000000ffffULL;
    bits = (bits | bits << 16) & 0x1f0000ff0000ffULL;
    bits = (bits | bits << 8) & 0x100f00f00f00f00fULL;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3ULL;
    bits = (bits | bits << 2) & 0x1249249249249249ULL;
    code |= bits << axis;
  }
  return code;
}

struct Numbered {
  std::uint64_t code;
  VertexHandle vertex;
};

/// The same tet, positively oriented as before, with its smallest vertex first and its second smallest second.
Tet canonical(Tet t) {
  const auto smallest = static_cast<std::size_t>(std::min_element(t.begin(), t.end()) - t.begin());
  if (smallest != 0) {  // two transpositions keep the orientation
    const std::size_t a = smallest == 3 ? 1 : 3;
    const std::size_t b = smallest == 2 ? 1 : 2;
    std::swap(t[0], t[smallest]);
    if (smallest == 1) {
      std::swap(t[2], t[3]);
    } else {
      std::swap(t[a], t[b]);
    }
  }
  while (t[1] > t[2] || t[1] > t[3]) t = {t[0], t[2], t[3], t[1]};  // an even rotation of the other three
  return t;
}

}  // namespace

TetMesh extract_mesh(const RestrictedTriangulation& triangulation) {
  const Triangulation& t = triangulation.triangulation();
  std::vector<CellHandle> cells;
  std::vector<char> used(triangulation.vertex_count(), 0);
  for (CellHandle cell : t.finite_cell_handles()) {
    if (cell->info().region == kOutside) continue;
    cells.push_back(cell);
    for (int i = 0; i < 4; ++i) used[cell->vertex(i)->info().id] = 1;
  }
  Box box;
  std::vector<Numbered> order;
  for (VertexHandle v : t.finite_vertex_handles()) {
    if (used[v->info().id] == 0) continue;
    box.extend(position(v));
    order.push_back({0, v});
  }
  for (Numbered& n : order) n.code = morton(position(n.vertex), box);
  std::sort(order.begin(), order.end(), [](const Numbered& a, const Numbered& b) {
    return a.code != b.code ? a.code < b.code : lexicographically_less(position(a.vertex), position(b.vertex));
  });

  TetMesh mesh;
  std::vector<VertexId> number(triangulation.vertex_count(), 0);
  for (const Numbered& n : order) {
    number[n.vertex->info().id] = static_cast<VertexId>(mesh.vertices.size());
    mesh.vertices.push_back(position(n.vertex));
  }
  std::vector<std::pair<Tet, Region>> tets;
  tets.reserve(cells.size());
  for (CellHandle cell : cells) {
    Tet tet;
    for (int i = 0; i < 4; ++i) tet[static_cast<std::size_t>(i)] = number[cell->vertex(i)->info().id];
    tets.push_back({canonical(tet), cell->info().region});
  }
  std::sort(tets.begin(), tets.end());
  for (const auto& [tet, region] : tets) {
    mesh.tets.push_back(tet);
    mesh.tet_regions.push_back(region);
  }
  build_boundary(mesh);
  for (const Numbered& n : order) {
    mesh.on_boundary[number[n.vertex->info().id]] = n.vertex->info().on_boundary ? 1 : 0;
  }
  return mesh;
}

}  // namespace scantet::refine
