// Pumping without weights: these only decide in which order a star swallows the tets around it, and the order of the
// Delaunay triangulation is a good one, whatever the weights were that led to the tets as they are.
#include "scantet/optimize/star_growth_impl.h"

namespace scantet::optimize {

void StarGrowth::try_tet(TetId t, Change& best) {
  pump_.sharpest = best.sharpest;
  pump_.added.clear();
  grow(t);
  if (!pump_.found()) return;
  best.reset(pump_.sharpest);
  best.removed = pump_.removed;
  best.added = pump_.added;
  best.read = pump_.read;
}

void StarGrowth::grow(TetId t) {
  const Tet& tet = complex_.tet(t);
  for (const VertexId v : tet) {
    star_.try_vertex(v, t, pump_);
    if (pump_.sharpest <= bound_) return;
  }
  for (int k = 0; k < 4; ++k) {
    const TetId beyond = complex_.across(t, k);
    if (beyond == kNoTet || complex_.region(beyond) != complex_.region(t)) continue;
    for (const VertexId v : complex_.tet(beyond)) {
      if (!has_vertex(tet, v)) star_.try_vertex(v, beyond, pump_);
    }
    if (pump_.sharpest <= bound_) return;
  }
}

}  // namespace scantet::optimize
