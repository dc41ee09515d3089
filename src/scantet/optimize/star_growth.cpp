// Pumping without weights: these only decide in which order a star swallows the tets around it, and the order of the
// Delaunay triangulation is a good one, whatever the weights were that led to the tets as they are.
#include "scantet/optimize/star_growth_impl.h"

namespace scantet::optimize {

void StarGrowth::try_tet(TetId t, Change& best) {
  pump_.sharpest = best.sharpest;
  pump_.added.clear();
  star_.try_tet(t, pump_);
  if (!pump_.found()) return;
  best.reset(pump_.sharpest);
  best.removed = pump_.removed;
  best.added = pump_.added;
  best.read = pump_.read;
}

}  // namespace scantet::optimize
