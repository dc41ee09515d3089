// The edges of a mesh's curves as elements of their own, and curves as sets of nodes. Private to io/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scantet/base/element_nodes.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/io/mesh_tags_impl.h"

namespace scantet {

/// The nodes of each edge of a curve, and a tet that has the edge.
class CurveElements {
 public:
  /// Throws Error: mesh.inconsistent (an edge of a curve is not one of a tet).
  explicit CurveElements(const TetMesh& mesh);

  /// Its ends, and of second order the node between them.
  const ElementNodes& of(std::size_t edge) const { return nodes_[edge]; }
  std::uint32_t tet_of(std::size_t edge) const { return tets_[edge]; }

 private:
  std::vector<ElementNodes> nodes_;
  std::vector<std::uint32_t> tets_;
};

/// For formats without elements for lines, or whose lines would be beams: the nodes of each curve under its name, and
/// the corners.
std::vector<NamedSet> curves_as_sets(const TetMesh& mesh, const MeshTags& tags);

/// Calls `take(curve, indices of its edges)` for each curve.
template <typename Take>
void for_each_curve(const TetMesh& mesh, const MeshTags& tags, const Take& take) {
  for_each_group(tags.curves, mesh.edge_curves, tags.edges_in, take);
}

}  // namespace scantet
