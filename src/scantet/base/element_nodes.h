// The nodes of elements of first or second order, as files list them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "scantet/base/mesh_topology.h"
#include "scantet/base/tet_mesh.h"

namespace scantet {

/// The corners of the edges of a tet, in the order of the nodes on them.
inline constexpr std::array<std::array<std::size_t, 2>, 6> kEdgesOfNodes{
    {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};

/// Whether tets have ten nodes, and facets six.
inline bool is_second_order(const TetMesh& mesh) {
  return !mesh.tet_edge_vertices.empty();
}

/// The nodes of one element: corners first.
struct ElementNodes {
  std::array<VertexId, 10> all;
  std::size_t count;
  const VertexId* begin() const { return all.data(); }
  const VertexId* end() const { return all.data() + count; }
};

/// The order of corners of a tet, and of the nodes on its edges, which are those of TetMesh::tet_edge_vertices.
struct TetOrder {
  std::array<std::size_t, 4> corners{0, 1, 2, 3};
  std::array<std::size_t, 6> edges{0, 1, 2, 3, 4, 5};  ///< VTK's, and that of Abaqus, Nastran, Exodus and FEBio
};

/// 4 or 10 nodes.
inline ElementNodes nodes_of_tet(const TetMesh& mesh, std::size_t tet, const TetOrder& order = {}) {
  ElementNodes nodes;
  nodes.count = 4;
  for (std::size_t i = 0; i < 4; ++i) nodes.all[i] = mesh.tets[tet][order.corners[i]];
  if (!is_second_order(mesh)) return nodes;
  for (const std::size_t edge : order.edges) nodes.all[nodes.count++] = mesh.tet_edge_vertices[tet][edge];
  return nodes;
}

/// The nodes of boundary facets: corners, and of second order those on the edges 01, 12 and 20.
class FacetNodes {
 public:
  explicit FacetNodes(const TetMesh& mesh) : mesh_(mesh) {
    if (is_second_order(mesh)) behind_ = faces_behind_facets(mesh);
  }

  /// 3 or 6.
  ElementNodes of(std::size_t facet) const {
    ElementNodes nodes;
    nodes.count = 3;
    const Triangle& corners = mesh_.boundary_facets[facet];
    for (std::size_t i = 0; i < 3; ++i) nodes.all[i] = corners[i];
    if (behind_.empty()) return nodes;
    for (std::size_t i = 0; i < 3; ++i) nodes.all[nodes.count++] = between(facet, corners[i], corners[(i + 1) % 3]);
    return nodes;
  }

 private:
  VertexId between(std::size_t facet, VertexId a, VertexId b) const {
    constexpr std::size_t kEdge[4][4] = {{0, 0, 2, 3}, {0, 0, 1, 4}, {2, 1, 0, 5}, {3, 4, 5, 0}};
    const std::uint32_t t = behind_[facet].tet;
    const Tet& tet = mesh_.tets[t];
    const auto corner = [&](VertexId v) {
      return static_cast<std::size_t>(std::find(tet.begin(), tet.end(), v) - tet.begin());
    };
    return mesh_.tet_edge_vertices[t][kEdge[corner(a)][corner(b)]];
  }

  const TetMesh& mesh_;
  std::vector<TetFace> behind_;
};

}  // namespace scantet
