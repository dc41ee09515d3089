// Private: whether the boundary of the mesh is a surface at a vertex.
#pragma once

#include <vector>

#include "scantet/refine/triangulation_impl.h"

namespace scantet::refine {

/// The facets around a vertex that lie between two regions. A workspace, to be used for one vertex after another.
class BoundaryLink {
 public:
  /// Whether they form one disk with the vertex inside: then their outer edges are one closed path.
  bool is_cycle_around(PointId v, const Triangulation& t);
  /// The cells around the vertex asked for last.
  const std::vector<CellId>& star() const { return star_; }
  /// Whether there were any such facets.
  bool empty() const { return edges_.empty(); }

 private:
  std::vector<CellId> star_;
  std::vector<std::array<PointId, 2>> edges_;
};

}  // namespace scantet::refine
