// Short closed paths along a surface that do not part it: each goes once around a handle, or once through one.
#pragma once

#include <functional>
#include <vector>

#include "scantet/base/triangle_surface.h"

namespace scantet {

/// A closed path along edges of a surface.
struct HandleLoop {
  std::vector<VertexId> vertices;  ///< once around; the last is joined to the first
  Point center;                    ///< the mean of its vertices
  double length_mm = 0;
};

/// Whether a path is of interest. Called from several threads.
using LoopFilter = std::function<bool(const HandleLoop&)>;
/// mm, at a place. Called from several threads.
using LengthAt = std::function<double(const Point&)>;

/// From each vertex, or one nearer to it than a tenth of longest_mm, the shortest paths of each kind that are no
/// longer than longest_mm there; of those that is_asked() takes, the ones that do not part the surface, the shortest
/// first. Of two whose centres are nearer than half the length of the longer one, the shorter one. Paths along edges
/// that more than two facets have are not found.
///
/// After Erickson and Whittlesey (*Greedy optimal homotopy and homology generators*, 2005): of the edges beside a tree
/// of shortest paths, those are left that a tree of the facets does not cross, the longest ways first. Both trees end a
/// tenth of longest_mm behind half of it. Whether a path parts the surface is asked of the first 10,000 only.
/// surface: closed. Guarantee: the same for any number of threads.
std::vector<HandleLoop> handle_loops(const TriangleSurface& surface, const LengthAt& longest_mm,
                                     const LoopFilter& is_asked);

}  // namespace scantet
