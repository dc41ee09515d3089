// The parts above and below a level by samples, with nodes at the level in neither: slow, but simple.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "scantet/base/union_find.h"
#include "scantet/topology/level_topology.h"
#include "unit/image/sampled_flood.h"

namespace scantet::test {

inline Counts counts(const LevelTopology& topology) {
  Counts counts;
  for (const Component& component : topology.components()) {
    ++(component.region == kOutside ? counts.cavities : counts.inside);
  }
  return counts;
}

/// The parts above and below the level among samples n to a voxel. Zero samples belong to none, but parts below that
/// meet in the middle of an edge at the level are one, and so are parts that meet in the middle of such a face.
inline Counts parts_of_samples(const Scan& scan, const LevelSetSettings& settings, int n) {
  const auto grid = padded_grid(scan, std::get<const std::int16_t*>(scan.voxels), settings);
  Size m;
  for (int axis = 0; axis < 3; ++axis) m[axis] = (scan.size[axis] + 1) * n + 1;
  const auto at = [&](const Size& p) { return static_cast<std::uint32_t>((p[2] * m[1] + p[1]) * m[0] + p[0]); };
  std::vector<double> height(static_cast<std::size_t>(m[0]) * m[1] * m[2]);
  const auto for_each = [&](const auto& visit) {
    for (int z = 0; z < m[2]; ++z) {
      for (int y = 0; y < m[1]; ++y) {
        for (int x = 0; x < m[0]; ++x) visit(Size{x, y, z});
      }
    }
  };
  for_each([&](const Size& p) {
    Size cell;
    for (int axis = 0; axis < 3; ++axis) cell[axis] = std::min(p[axis] / n, scan.size[axis]);
    const Vec u{double(p[0]) / n - cell[0], double(p[1]) / n - cell[1], double(p[2]) / n - cell[2]};
    height[at(p)] = trilinear(grid.corners(cell[0] - 1, cell[1] - 1, cell[2] - 1), u);
  });
  UnionFind sets(height.size());
  const auto moved = [](Size p, int axis, int step) {
    p[axis] += step;
    return p;
  };
  for_each([&](const Size& p) {
    std::vector<int> across;  // the axes across the grid line or face that the sample is on
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] % n == 0) across.push_back(axis);
      if (p[axis] + 1 == m[axis]) continue;
      const Size q = moved(p, axis, 1);
      if (height[at(p)] * height[at(q)] > 0) sets.unite(at(p), at(q));
    }
    if (height[at(p)] != 0 || across.empty() || across.size() == 3) return;
    for (int axis = 0; axis < 3; ++axis) {  // is all of the edge or face at the level?
      if (p[axis] % n == 0) continue;
      if (height[at(moved(p, axis, 1))] != 0 || height[at(moved(p, axis, -1))] != 0) return;
    }
    for (const bool below : {true, false}) {
      if (!below && across.size() == 2) continue;
      std::optional<std::uint32_t> first;
      for (const int axis : across) {
        for (const int step : {-1, 1}) {
          const std::uint32_t q = at(moved(p, axis, step));
          if (below ? height[q] >= 0 : height[q] <= 0) continue;
          sets.unite(first.value_or(q), q);
          first = q;
        }
      }
    }
  });
  Counts counts;
  for (std::uint32_t label = 0; label < sets.size(); ++label) {
    if (height[label] != 0 && sets.find(label) == label) ++(height[label] > 0 ? counts.inside : counts.cavities);
  }
  --counts.cavities;  // the unbounded outside
  return counts;
}

}  // namespace scantet::test
