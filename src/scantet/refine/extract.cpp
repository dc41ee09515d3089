// Vertices are numbered along a Morton curve, so that neighbours in space are neighbours in memory; a tet starts with
// its smallest vertex and tets are sorted. Nothing depends on the order in which the triangulation keeps its cells.
#include <algorithm>
#include <vector>

#include "scantet/base/mesh_topology.h"
#include "scantet/base/parallel.h"
#include "scantet/refine/extract_impl.h"
#include "scantet/refine/morton_impl.h"

namespace scantet::refine {
namespace {

struct Numbered {
  std::uint64_t code;
  PointId vertex;
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

/// The vertices of the cells that are inside, along the curve.
std::vector<Numbered> number_vertices(const Triangulation& t, const std::vector<CellId>& cells) {
  std::vector<char> used(t.vertex_slots(), 0);
  for (const CellId c : cells) {
    for (const PointId v : t.cell(c).vertex) used[v] = 1;
  }
  Box box;
  std::vector<Numbered> order;
  for (PointId v = 0; v < t.vertex_slots(); ++v) {
    if (used[v] == 0) continue;
    box.extend(t.point(v));
    order.push_back({0, v});
  }
  for (Numbered& n : order) n.code = morton_code(t.point(n.vertex), box);
  parallel_sort(order, [&](const Numbered& a, const Numbered& b) {
    return a.code != b.code ? a.code < b.code : lexicographically_less(t.point(a.vertex), t.point(b.vertex));
  });
  return order;
}

}  // namespace

TetMesh extract_mesh(const RestrictedTriangulation& triangulation) {
  const Triangulation& t = triangulation.triangulation();
  std::vector<CellId> cells;
  for (CellId c = 0; c < t.cell_slots(); ++c) {
    if (t.is_cell(c) && t.info(c).region != kOutside) cells.push_back(c);
  }
  TetMesh mesh;
  std::vector<VertexId> number(t.vertex_slots(), 0);
  const std::vector<Numbered> order = number_vertices(t, cells);
  for (const Numbered& n : order) {
    number[n.vertex] = static_cast<VertexId>(mesh.vertices.size());
    mesh.vertices.push_back(t.point(n.vertex));
  }
  std::vector<std::pair<Tet, Region>> tets(cells.size());
  constexpr std::size_t kGrain = 8192;
  parallel_for(cells.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Tet tet;
      for (std::size_t k = 0; k < 4; ++k) tet[k] = number[t.cell(cells[i]).vertex[k]];
      tets[i] = {canonical(tet), t.info(cells[i]).region};
    }
  });
  parallel_sort(tets, [](const auto& a, const auto& b) { return a < b; });
  mesh.tets.reserve(tets.size());
  mesh.tet_regions.reserve(tets.size());
  for (const auto& [tet, region] : tets) {
    mesh.tets.push_back(tet);
    mesh.tet_regions.push_back(region);
  }
  build_boundary(mesh);
  for (const Numbered& n : order) mesh.on_boundary[number[n.vertex]] = t.vertex(n.vertex).on_boundary ? 1 : 0;
  return mesh;
}

}  // namespace scantet::refine
