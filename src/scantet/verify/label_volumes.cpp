// Cells are cut into boxes; those of which one region may be the largest are its own, others may be of each candidate.
#include "scantet/verify/label_volumes.h"

#include <bit>
#include <cstdint>
#include <vector>

#include "scantet/verify/cell_boxes.h"
#include "scantet/verify/label_cells.h"

namespace scantet::verify {
namespace {

constexpr int kDepth = 2;  // boxes are 2^-kDepth of a cell's side

using Counts = std::map<Region, std::array<std::int64_t, 2>>;  // boxes of the smallest size: surely, and maybe

void count(const LabelCellValues& fields, const Cell& cell, const Box& box, int depth, Counts& counts) {
  const Candidates all = candidates(fields, cell, box);
  if (!is_one(all) && depth > 0) {
    for (int n = 0; n < 8; ++n) count(fields, cell, eighth(box, n), depth - 1, counts);
    return;
  }
  for (std::size_t n = 0; n < fields.count; ++n) {
    if ((all >> n & 1) == 0) continue;
    auto& sum = counts[fields.regions[n]];
    sum[0] += is_one(all) ? std::int64_t{1} << 3 * depth : 0;
    sum[1] += std::int64_t{1} << 3 * depth;
  }
}

}  // namespace

std::map<Region, std::array<double, 2>> region_volumes(const LabelSource& labels, const Progress& progress) {
  std::vector<Counts> layers(static_cast<std::size_t>(labels.size()[2]) + 1);
  for_cells(labels, progress, [&](std::size_t layer, const Cell& cell) {
    if (const std::optional<Region> region = only_region(labels, cell)) {
      for (std::int64_t& sum : layers[layer][*region]) sum += std::int64_t{1} << 3 * kDepth;
      return;
    }
    LabelCellValues fields;
    labels.cell(cell[0], cell[1], cell[2], fields);
    count(fields, cell, whole_cell(cell), kDepth, layers[layer]);
  });
  Counts all;
  for (const Counts& layer : layers) {
    for (const auto& [region, sum] : layer) {
      all[region][0] += sum[0];
      all[region][1] += sum[1];
    }
  }
  const Frame& frame = labels.frame();
  const Interval voxel = det(IntervalVec(frame.column(0)), IntervalVec(frame.column(1)), IntervalVec(frame.column(2)));
  const Interval box = (voxel.is_positive() ? voxel : -voxel) * Interval(1.0 / (1 << 3 * kDepth));
  std::map<Region, std::array<double, 2>> volumes;
  for (const auto& [region, sum] : all) {
    if (region == kOutside) continue;
    volumes[region] = {(box * Interval(static_cast<double>(sum[0]))).lo,
                       (box * Interval(static_cast<double>(sum[1]))).hi};
  }
  return volumes;
}

std::map<Region, std::array<double, 2>> region_volumes(const TetMesh& mesh) {
  std::map<Region, Interval> sums;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Tet& tet = mesh.tets[t];
    const IntervalVec a(mesh.vertices[tet[0]]);
    const auto edge = [&](std::size_t n) { return IntervalVec(mesh.vertices[tet[n]]) - a; };
    Interval& sum = sums[mesh.tet_regions[t]];
    sum = sum + det(edge(1), edge(2), edge(3));
  }
  std::map<Region, std::array<double, 2>> volumes;
  for (const auto& [region, sum] : sums) {
    const Interval volume = sum * Interval(below(1.0 / 6), above(1.0 / 6));
    volumes[region] = {volume.lo, volume.hi};
  }
  return volumes;
}

}  // namespace scantet::verify
