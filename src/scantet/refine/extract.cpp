// Vertices are numbered along a Morton curve, so that neighbours in space are neighbours in memory. Tets keep the order
// of the cells, which follows the curve, too, but for the cells that the rules have made.
#include <algorithm>
#include <atomic>
#include <cassert>
#include <set>
#include <vector>

#include "scantet/base/mesh_topology.h"
#include "scantet/base/morton_impl.h"
#include "scantet/base/parallel.h"
#include "scantet/refine/extract_impl.h"

namespace scantet::engine {
namespace {

constexpr std::size_t kGrain = 8192;

struct Numbered {
  std::uint64_t code;
  PointId vertex;
};

/// The vertices of the cells that are inside, along the curve.
std::vector<Numbered> number_vertices(const Triangulation& t, const std::vector<CellId>& cells) {
  std::vector<std::atomic<bool>> used(t.vertex_slots());
  parallel_for(cells.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (const PointId v : t.cell(cells[i]).vertex) used[v].store(true, std::memory_order_relaxed);
    }
  });
  const auto collect = [&](std::size_t begin, std::size_t end, std::vector<Numbered>& piece) {
    for (auto v = static_cast<PointId>(begin); v < end; ++v) {
      if (used[v].load(std::memory_order_relaxed)) piece.push_back({0, v});
    }
  };
  std::vector<Numbered> order = parallel_collect<Numbered>(t.vertex_slots(), kGrain, collect);
  const Box box = parallel_bounds(order.size(), [&](std::size_t i) { return t.point(order[i].vertex); });
  parallel_for(order.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) order[i].code = morton_code(t.point(order[i].vertex), box);
  });
  parallel_sort(order, [&](const Numbered& a, const Numbered& b) {
    return a.code != b.code ? a.code < b.code : lexicographically_less(t.point(a.vertex), t.point(b.vertex));
  });
  return order;
}

void extract_tets(const Triangulation& t, const std::vector<CellId>& cells, const std::vector<VertexId>& number,
                  TetMesh& mesh) {
  mesh.tets.resize(cells.size());
  mesh.tet_regions.resize(cells.size());
  parallel_for(cells.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t k = 0; k < 4; ++k) mesh.tets[i][k] = number[t.cell(cells[i]).vertex[k]];
      mesh.tet_regions[i] = t.info(cells[i]).region;
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
  const auto find = [&](std::size_t begin, std::size_t end, std::vector<BoundaryFacet>& found) {
    for (std::size_t i = begin; i < end; ++i) {
      const Cell& cell = t.cell(cells[i]);
      const Region behind = t.info(cells[i]).region;
      for (int k = 0; k < 4; ++k) {
        const Region in_front = t.info(cell.neighbor[static_cast<std::size_t>(k)] / 4).region;
        if (in_front == behind || (in_front != kOutside && in_front < behind)) continue;
        assert(facet_vertices(cell, k)[0] >= Triangulation::kCorners);
        const Tet tet{number[cell.vertex[0]], number[cell.vertex[1]], number[cell.vertex[2]], number[cell.vertex[3]]};
        Triangle facet = face_of(tet, k);
        std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
        Triangle ascending = facet;
        std::sort(ascending.begin(), ascending.end());
        found.push_back({ascending, facet, {behind, in_front}});
      }
    }
  };
  std::vector<BoundaryFacet> facets = parallel_collect<BoundaryFacet>(cells.size(), kGrain, find);
  parallel_sort(facets, [](const BoundaryFacet& a, const BoundaryFacet& b) { return a.ascending < b.ascending; });
  mesh.boundary_facets.resize(facets.size());
  mesh.facet_regions.resize(facets.size());
  parallel_for(facets.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      mesh.boundary_facets[i] = facets[i].oriented;
      mesh.facet_regions[i] = facets[i].regions;
    }
  });
}

/// Those of the edges that are edges of the boundary, and their curves.
void extract_sharp_edges(const SharpEdges& sharp, const std::vector<VertexId>& number, TetMesh& mesh) {
  if (sharp.edges.empty()) return;
  std::set<std::array<VertexId, 2>> edges;
  for (const Triangle& facet : mesh.boundary_facets) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(facet[k], facet[(k + 1) % 3]);
      edges.insert({a, b});
    }
  }
  mesh.curves = sharp.curves;
  for (const SharpEdge& edge : sharp.edges) {
    const auto [a, b] = std::minmax({number[edge.vertices[0]], number[edge.vertices[1]]});
    if (edges.count({a, b}) == 0) continue;
    mesh.curve_edges.push_back({a, b});
    mesh.edge_curves.push_back(edge.curve);
  }
}

}  // namespace

/// The cells that are inside.
std::vector<CellId> inner_cells(const Triangulation& t) {
  return parallel_collect<CellId>(t.cell_slots(), kGrain,
                                  [&](std::size_t begin, std::size_t end, std::vector<CellId>& cells) {
                                    for (auto c = static_cast<CellId>(begin); c < end; ++c) {
                                      if (t.is_cell(c) && t.info(c).region != kOutside) cells.push_back(c);
                                    }
                                  });
}

TetMesh extract_mesh(const RestrictedTriangulation& triangulation, const SharpEdges& sharp) {
  const Triangulation& t = triangulation.triangulation();
  const std::vector<CellId> cells = inner_cells(t);
  TetMesh mesh;
  std::vector<VertexId> number(t.vertex_slots(), 0);
  const std::vector<Numbered> order = number_vertices(t, cells);
  mesh.vertices.resize(order.size());
  parallel_for(order.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      number[order[i].vertex] = static_cast<VertexId>(i);
      mesh.vertices[i] = t.point(order[i].vertex);
    }
  });
  extract_tets(t, cells, number, mesh);
  extract_boundary(t, cells, number, mesh);
  extract_sharp_edges(sharp, number, mesh);
  set_strata(mesh);
  return mesh;
}

}  // namespace scantet::engine
