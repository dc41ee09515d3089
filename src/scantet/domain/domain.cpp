// Default surface candidates: three families of parallel lines, so that a plugin with two queries is complete.
#include "scantet/domain/domain.h"

namespace scantet {

void Domain::surface_candidates(double spacing_mm, const PointSink& sink) const {
  const Box box = bounds();
  Crossings crossings;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const auto steps = [&](int a) { return static_cast<long>(std::ceil(box.extent()[a] / spacing_mm)); };
    for (long i = 0; i <= steps(u); ++i) {
      for (long j = 0; j <= steps(v); ++j) {
        Segment line{box.min, box.min};
        line.source[u] = line.target[u] = std::min(box.min[u] + static_cast<double>(i) * spacing_mm, box.max[u]);
        line.source[v] = line.target[v] = std::min(box.min[v] + static_cast<double>(j) * spacing_mm, box.max[v]);
        line.target[axis] = box.max[axis];
        this->crossings(line, crossings);
        for (const Crossing& crossing : crossings) sink(crossing.point);
      }
    }
  }
}

}  // namespace scantet
