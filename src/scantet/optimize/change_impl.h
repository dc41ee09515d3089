// Private: what an operation would do to the complex.
#pragma once

#include <vector>

#include "scantet/optimize/tet_complex_impl.h"

namespace scantet::optimize {

/// Stands for no vertex at all.
inline constexpr VertexId kNoVertex = 0xffffffff;
/// Stands, in tets that a change adds, for the vertex that it adds with them.
inline constexpr VertexId kNewVertex = 0xfffffffe;

/// Tets that go and tets that come; a vertex that moves or gets a weight. Operations look for one that is better than
/// what they are given, and leave it as it is if there is none.
struct Change {
  /// Of the tets and boundary facets that come or move, the sharpness of the sharpest. Each operation looks for a
  /// change that makes this less.
  double sharpest = kInverted;
  std::vector<TetId> removed;
  std::vector<NewTet> added;
  VertexId vertex = kNoVertex;  ///< this vertex moves to `position`; kNewVertex is added there
  Point position;
  bool on_boundary = false;       ///< it lies on the domain's boundary there
  VertexId weighted = kNoVertex;  ///< gets the weight; only in exudation, where vertices have weights
  double weight_mm2 = 0;
  /// What the change was found from: it stays valid as long as these tets and their vertices stay as they are.
  std::vector<TetId> read;

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
