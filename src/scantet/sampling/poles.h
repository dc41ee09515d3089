// The poles of a sample of a surface: Voronoi vertices near its medial axis.
#pragma once

#include <vector>

#include "scantet/base/progress.h"
#include "scantet/domain/domain.h"

namespace scantet {

/// The centre of a large empty ball that touches the sample.
struct Pole {
  Point center;       ///< world mm
  double radius_mm;   ///< of the ball
  double spread_rad;  ///< largest angle under which two of the sample points that it touches are seen from its centre
};

/// The poles of each point of the sample: the farthest vertex of its Voronoi cell, and the farthest one on the other
/// side of the point (Amenta and Bern, Surface reconstruction by Voronoi filtering, 1999). Each vertex is listed once;
/// those at infinity are left out. For a dense sample of a smooth surface the poles are near its medial axis.
///
/// bounds: of all points. If cancelled: empty. Depends on the points only, not on the number of threads.
std::vector<Pole> poles_of(const std::vector<Point>& sample, const Box& bounds, Progress& progress);

}  // namespace scantet
