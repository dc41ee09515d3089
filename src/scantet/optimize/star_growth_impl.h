// Private: stars of vertices that grow over bad tets.
#pragma once

#include <vector>

#include "scantet/optimize/change_impl.h"
#include "scantet/optimize/star_pump_impl.h"

namespace scantet::optimize {

/// Looks for vertices whose stars can take over a bad tet, as a pump would make them; keeps its buffers.
class StarGrowth {
 public:
  explicit StarGrowth(const TetComplex& complex) : star_(complex, no_weights_) {}

  /// Puts into `best` new tets in place of t and others around it, if none of them is as sharp as best.sharpest: those
  /// of a star of one of its vertices, or of one beyond its faces, that has grown by what lies next to it. No vertex
  /// moves, the boundary stays.
  void try_tet(TetId t, Change& best);

 private:
  const std::vector<double> no_weights_;
  StarPump star_;
  Pump pump_;
};

}  // namespace scantet::optimize
