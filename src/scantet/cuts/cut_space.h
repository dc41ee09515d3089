// What of space several planes leave: a convex part of it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "scantet/cuts/cut_plane.h"
#include "scantet/domain/domain.h"

namespace scantet {

inline constexpr std::size_t kNoPlane = ~std::size_t{0};

/// The stretch of a segment that planes leave, as shares of its length, and the planes at its ends; kNoPlane where the
/// segment itself ends.
struct KeptStretch {
  double enter = 0;
  double leave = 1;
  std::size_t enter_plane = kNoPlane;
  std::size_t leave_plane = kNoPlane;
};

/// A domain and the planes that cut it; both outlive this.
struct CutSpace {
  const Domain& inner;
  std::span<const CutPlane> planes;
  Box box;         ///< of the domain
  double step_mm;  ///< of the grids that rims are looked for in

  /// Whether no plane takes p away; those of `but` do not count.
  bool keeps(const Point& p, const std::array<std::size_t, 2>& but = {kNoPlane, kNoPlane}) const;
  /// The stretch of the segment between the planes but for those of `but`; none if they leave nothing. An end that no
  /// plane takes away is the end of the stretch.
  std::optional<KeptStretch> kept(const Segment& segment,
                                  const std::array<std::size_t, 2>& but = {kNoPlane, kNoPlane}) const;
  /// The corners of what the box and the other planes leave of a plane, around it; empty if that is nothing.
  std::vector<Point> polygon(std::size_t plane) const;
};

}  // namespace scantet
