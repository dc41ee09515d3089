// Cells are cut into boxes, each surely inside, surely outside or open; tets are summed up.
#include "scantet/verify/volumes.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "scantet/base/parallel.h"
#include "scantet/verify/cell_boxes.h"

namespace scantet::verify {

std::array<double, 2> field_volume(const VoxelNodes& nodes, const Progress& progress) {
  const auto layers = static_cast<std::size_t>(nodes.size()[2]) + 1;
  std::vector<std::array<std::int64_t, 2>> eighths(layers);  // of cells, to the third: surely inside, and maybe
  const auto count = [&](const auto& self, const CellValues& values, const Cell& cell, const Box& box, int depth,
                         std::array<std::int64_t, 2>& sum) -> void {
    const Interval range = value_range(values, cell, box);
    const std::int64_t parts = std::int64_t{1} << 3 * depth;
    if (range.hi <= 0) return;
    if (range.lo > 0) {
      sum[0] += parts;
      sum[1] += parts;
    } else if (depth == 0) {
      sum[1] += parts;
    } else {
      for (int n = 0; n < 8; ++n) self(self, values, cell, eighth(box, n), depth - 1, sum);
    }
  };
  constexpr int kDepth = 2;
  parallel_for(layers, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end && !progress.cancelled(); ++k) {
      for_cells_of_layer(nodes, static_cast<int>(k) - 1, [&](const Cell& cell, int low, int high) {
        if (high <= 0) return;
        if (low > 0) {
          eighths[k][0] += 1 << 3 * kDepth;
          eighths[k][1] += 1 << 3 * kDepth;
        } else {
          count(count, nodes.cell(cell), cell, whole_cell(cell), kDepth, eighths[k]);
        }
      });
    }
  });
  std::array<std::int64_t, 2> all{};
  for (const auto& layer : eighths) {
    all[0] += layer[0];
    all[1] += layer[1];
  }
  const Frame& frame = nodes.frame();
  const Interval voxel = det(IntervalVec(frame.column(0)), IntervalVec(frame.column(1)), IntervalVec(frame.column(2)));
  const Interval size = (voxel.is_positive() ? voxel : -voxel) * Interval(1.0 / (1 << 3 * kDepth));
  return {(size * Interval(static_cast<double>(all[0]))).lo, (size * Interval(static_cast<double>(all[1]))).hi};
}

std::array<double, 2> enclosed_volume(const std::vector<Point>& points, const std::vector<Triangle>& facets) {
  if (facets.empty()) return {0, 0};
  const IntervalVec from(points[facets[0][0]]);
  Interval sum;
  for (const Triangle& facet : facets) {
    const auto corner = [&](std::size_t n) { return IntervalVec(points[facet[n]]) - from; };
    sum = sum + det(corner(0), corner(1), corner(2));
  }
  const Interval volume = sum * Interval(below(1.0 / 6), above(1.0 / 6));
  if (volume.lo >= 0) return {volume.lo, volume.hi};
  return {std::max(0.0, -volume.hi), std::max(volume.hi, -volume.lo)};
}

std::array<double, 2> mesh_volume(const TetMesh& mesh) {
  constexpr std::size_t kPiece = 8192;
  std::vector<Interval> pieces((mesh.tets.size() + kPiece - 1) / kPiece);
  parallel_for(mesh.tets.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    Interval& sum = pieces[begin / kPiece];
    for (std::size_t t = begin; t < end; ++t) {
      const Tet& tet = mesh.tets[t];
      const IntervalVec a(mesh.vertices[tet[0]]);
      const auto edge = [&](std::size_t n) { return IntervalVec(mesh.vertices[tet[n]]) - a; };
      sum = sum + det(edge(1), edge(2), edge(3));
    }
  });
  const Interval sum = std::accumulate(pieces.begin(), pieces.end(), Interval());
  const Interval volume = sum * (Interval(1) * Interval(below(1.0 / 6), above(1.0 / 6)));
  return {volume.lo, volume.hi};
}

}  // namespace scantet::verify
