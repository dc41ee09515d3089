// Private: what an operation would do to the complex.
#pragma once

#include <vector>

#include "scantet/optimize/tet_complex_impl.h"

namespace scantet::optimize {

inline constexpr VertexId kNoVertex = 0xffffffff;
inline constexpr VertexId kNewVertex = 0xfffffffe;  ///< in tets that come: the vertex that comes with them

/// Tets that go and tets that come; a vertex that moves or gets a weight. Operations look for one that is better than
/// what they are given, and leave it as it is if there is none.
struct Change {
  double sharpest = kInverted;  ///< of the tets and boundary facets that come or move: what is to become less
  std::vector<TetId> removed;
  std::vector<NewTet> added;
  VertexId vertex = kNoVertex;  ///< moves to `position`; may be kNewVertex
  Point position;
  bool on_boundary = false;       ///< it lies on the domain's boundary there
  VertexId weighted = kNoVertex;  ///< gets the weight; only in exudation, where vertices have weights
  double weight_mm2 = 0;
  std::vector<TetId> read;  ///< the change is what it is as long as these tets and their vertices stay as they are

  bool found() const { return vertex != kNoVertex || !removed.empty(); }
  void reset(double sharpness) {
    sharpest = sharpness;
    removed.clear();
    added.clear();
    vertex = kNoVertex;
    weighted = kNoVertex;
    read.clear();
  }
};

}  // namespace scantet::optimize
