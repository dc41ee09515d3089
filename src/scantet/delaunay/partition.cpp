// A kd-tree over a sample of the work.
#include "scantet/base/parallel.h"
#include "scantet/delaunay/partition_impl.h"

namespace scantet::engine {

Partition::Partition(std::vector<Point>& work, int depth, double near_mm)
    : depth_(std::min(depth, kMostCuts)), near_mm_(near_mm), cuts_(std::size_t{1} << depth_) {
  constexpr std::size_t kEnough = 256;  // places for each part
  const std::size_t stride = std::max<std::size_t>(work.size() / (kEnough << depth_), 1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < work.size(); i += stride) work[kept++] = work[i];
  cut(work, 0, kept, 1);
}

void Partition::cut(std::vector<Point>& work, std::size_t begin, std::size_t end, std::size_t node) {
  if (node >= cuts_.size() || begin == end) return;
  const double count = static_cast<double>(end - begin);
  double best = std::numeric_limits<double>::infinity();
  std::vector<double> places(end - begin);
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = begin; i < end; ++i) places[i - begin] = work[i][axis];
    std::sort(places.begin(), places.end());
    for (const double quantile : {0.5, 0.45, 0.55, 0.4, 0.6, 0.35, 0.65}) {
      const double at = places[static_cast<std::size_t>(quantile * count)];
      const auto near = std::upper_bound(places.begin(), places.end(), at + near_mm_) -
                        std::lower_bound(places.begin(), places.end(), at - near_mm_);
      const double cost = static_cast<double>(near) / count + std::abs(quantile - 0.5);
      if (cost >= best) continue;
      best = cost;
      cuts_[node] = {axis, at};
    }
  }
  const Cut& chosen = cuts_[node];
  const auto at = [&](std::size_t i) { return work.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto middle = std::partition(at(begin), at(end), [&](const Point& p) { return p[chosen.axis] < chosen.at; });
  const auto split = static_cast<std::size_t>(middle - work.begin());
  cut(work, begin, split, 2 * node);
  cut(work, split, end, 2 * node + 1);
}

VertexParts Partition::parts_of(const Triangulation& t) const {
  constexpr std::size_t kGrain = 8192;
  VertexParts parts(t.vertex_slots());
  parallel_for(parts.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) parts[v] = of(t.point(static_cast<PointId>(v)));
  });
  return parts;
}

int partition_depth(std::size_t count, std::size_t least) {
  int depth = 0;
  while (depth < Partition::kMostCuts && (count >> (depth + 1)) >= least) ++depth;
  return depth;
}

}  // namespace scantet::engine
