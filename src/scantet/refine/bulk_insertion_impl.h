// Private: many points at once.
#pragma once

#include <vector>

#include "scantet/base/progress.h"
#include "scantet/refine/triangulation_impl.h"

namespace scantet::refine {

struct SamplePoint {
  Point point;
  bool on_boundary = false;
};

/// Inserts the points into a triangulation that has none, on several threads. Duplicates are dropped. The triangulation
/// and the numbers of its vertices and cells depend on the points only. Cancelled: stops early, with some of the
/// points.
void insert_in_bulk(std::vector<SamplePoint> points, Triangulation& t, Progress& progress);

}  // namespace scantet::refine
