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

constexpr std::size_t kGrain = 8192;

/// The tets, in order: the cells grouped by the first vertex of their tets, then the tets of each group sorted.
void extract_tets(const Triangulation& t, const std::vector<CellId>& cells, const std::vector<VertexId>& number,
                  TetMesh& mesh) {
  const auto tet_of = [&](CellId c) {
    Tet tet;
    for (std::size_t k = 0; k < 4; ++k) tet[k] = number[t.cell(c).vertex[k]];
    return tet;
  };
  std::vector<VertexId> first(cells.size());
  parallel_for(cells.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Tet tet = tet_of(cells[i]);
      first[i] = *std::min_element(tet.begin(), tet.end());
    }
  });
  std::vector<std::uint32_t> ends(mesh.vertices.size() + 1, 0);
  for (const VertexId v : first) ++ends[v + 1];
  for (std::size_t v = 1; v < ends.size(); ++v) ends[v] += ends[v - 1];
  std::vector<std::uint32_t> next(ends.begin(), ends.end() - 1);
  std::vector<CellId> grouped(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) grouped[next[first[i]]++] = cells[i];
  mesh.tets.resize(cells.size());
  mesh.tet_regions.resize(cells.size());
  parallel_for(mesh.vertices.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<std::pair<Tet, Region>> group;
    for (std::size_t v = begin; v < end; ++v) {
      group.clear();
      for (std::size_t i = ends[v]; i < ends[v + 1]; ++i) {
        group.push_back({canonical(tet_of(grouped[i])), t.info(grouped[i]).region});
      }
      std::sort(group.begin(), group.end());
      for (std::size_t i = ends[v]; i < ends[v + 1]; ++i) {
        mesh.tets[i] = group[i - ends[v]].first;
        mesh.tet_regions[i] = group[i - ends[v]].second;
      }
    }
  });
}

struct BoundaryFacet {
  Triangle ascending;
  Triangle oriented;
  std::array<Region, 2> regions;
};

/// The facets between two regions as build_boundary would find them, in the same order.
void extract_boundary(const Triangulation& t, const std::vector<CellId>& cells, const std::vector<VertexId>& number,
                      TetMesh& mesh) {
  std::vector<std::vector<BoundaryFacet>> found((cells.size() + kGrain - 1) / kGrain);
  parallel_for(cells.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Cell& cell = t.cell(cells[i]);
      const Region behind = t.info(cells[i]).region;
      for (int k = 0; k < 4; ++k) {
        const Region in_front = t.info(cell.neighbor[static_cast<std::size_t>(k)] / 4).region;
        if (in_front == behind || (in_front != kOutside && in_front < behind)) continue;
        const Tet tet{number[cell.vertex[0]], number[cell.vertex[1]], number[cell.vertex[2]], number[cell.vertex[3]]};
        Triangle facet = face_of(tet, k);
        std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
        Triangle ascending = facet;
        std::sort(ascending.begin(), ascending.end());
        found[begin / kGrain].push_back({ascending, facet, {behind, in_front}});
      }
    }
  });
  std::vector<BoundaryFacet> facets;
  for (const auto& list : found) facets.insert(facets.end(), list.begin(), list.end());
  parallel_sort(facets, [](const BoundaryFacet& a, const BoundaryFacet& b) { return a.ascending < b.ascending; });
  for (const BoundaryFacet& facet : facets) {
    mesh.boundary_facets.push_back(facet.oriented);
    mesh.facet_regions.push_back(facet.regions);
  }
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
  extract_tets(t, cells, number, mesh);
  extract_boundary(t, cells, number, mesh);
  mesh.on_boundary.resize(mesh.vertices.size());
  for (const Numbered& n : order) mesh.on_boundary[number[n.vertex]] = t.vertex(n.vertex).on_boundary ? 1 : 0;
  return mesh;
}

}  // namespace scantet::refine
