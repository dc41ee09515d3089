// Integrals over pieces of facets, many side by side. Private to fields/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace scantet {

constexpr std::size_t kFans = 64;
using FanLane = std::array<double, kFans>;

/// Parts of facets between planes of the grid: the triangles (o, a, b) and (o, b, c) of each, in index space, and the
/// cell in whose row along x they lie.
struct Fans {
  std::size_t count = 0;
  std::array<FanLane, 3> o, a, b, c;           // by axis
  std::array<std::array<int, kFans>, 3> cell;  // its lowest corner
  std::array<std::uint32_t, kFans> facet;      // that it is of
};

/// What the voxels on the four edges of the cell along x say, in the order of CellHeights.
struct ColumnHeights {
  std::array<FanLane, 4> before, at, after;  // the cell's lower side along x, and a step before and after it
  std::array<FanLane, 2> start;              // steps from the cell's lower side to where an antiderivative begins
};

struct ColumnIntegrals {
  std::array<FanLane, 2> integral;
  std::array<FanLane, 4> weight;  // integrals of what the trilinear map takes of each edge
};

/// Integrals over y and z, signed as the triangles are turned, of the antiderivatives along x of the trilinear map as
/// it is in the cell. Where an antiderivative begins farther than a step away, only what it is from the cell on.
void integrate_columns(const Fans& fans, const ColumnHeights& heights, ColumnIntegrals& result);

/// The same of half the square of x past the cell's lower side, times the bilinear map in y and z of these numbers. The
/// fans' corners o lie on that side.
void integrate_bends(const Fans& fans, const std::array<FanLane, 4>& bends, FanLane& result);

}  // namespace scantet
