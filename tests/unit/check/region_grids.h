// Grids of regions and meshes of boxes to hold against them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "scantet/check/audit.h"
#include "unit/quality/grid_mesh.h"

namespace scantet::test {

inline constexpr int kNodes = 12;

/// A grid of region 1 where in(i, j, k), each run a part of its own.
template <class In>
RegionGrid grid_where(const In& in) {
  RegionGrid grid;
  grid.size = {kNodes, kNodes, kNodes};
  grid.regions = {{1, 0, 0}};
  for (int k = 0; k < kNodes; ++k) {
    for (int j = 0; j < kNodes; ++j) {
      for (int i = 0; i < kNodes; ++i) {
        if (!in(i, j, k)) continue;
        const int begin = i;
        while (i < kNodes && in(i, j, k)) ++i;
        grid.runs.push_back({j, k, begin, i, static_cast<std::uint32_t>(grid.parts.size())});
        grid.parts.push_back({1, static_cast<std::uint64_t>(i - begin), {begin, j, k}});
        grid.regions[0].nodes += static_cast<std::uint64_t>(i - begin);
      }
    }
  }
  return grid;
}

inline bool in_box(int i, int j, int k) {
  return std::min({i, j, k}) >= 2 && std::max({i, j, k}) <= 9;
}

/// A box from about 1.6 to 9.6 along each axis, so that no node is on a face of a tet, of region 1 but where
/// left_out(cell) of the 4³ cells along it.
template <class LeftOut>
TetMesh box_without(const LeftOut& left_out) {
  TetMesh mesh = grid_mesh(4, [&](int i, int j, int k) { return left_out(i, j, k) ? kOutside : 1; });
  Box box;
  for (const Point& p : mesh.vertices) box.extend(p);
  for (Point& p : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = 1.55 + 0.1 * axis + 8 * (p[axis] - box.min[axis]) / (box.max[axis] - box.min[axis]);
    }
  }
  return mesh;
}

inline AuditReport audit_of(const TetMesh& mesh, const RegionGrid& grid) {
  AuditOptions options;
  options.grid = &grid;
  return audit(mesh, nullptr, options);
}

inline std::vector<std::string> codes_of(const AuditReport& report) {
  std::vector<std::string> codes;
  for (const Finding& finding : report.findings) codes.push_back(finding.code);
  return codes;
}

}  // namespace scantet::test
