// What is asked of the elements of a finished mesh.
#pragma once

#include <algorithm>
#include <optional>

#include "scantet/base/api.h"
#include "scantet/domain/rule_bounds.h"
#include "scantet/domain/sizing_field.h"

namespace SCANTET_API scantet {

/// R1, R2 and R3 (paper, section 3) at a size.
struct RuleTarget {
  RuleBounds bounds;
  const SizingField* size;  ///< not null; lives as long as the target; asked from several threads at once
};

/// How long edges must be.
struct EdgeTarget {
  double mm = 0;                      ///< no edge is shorter, ≥ 0; 0: no bound in mm
  double share = 0;                   ///< nor than this share of the size at its middle, 0 … 0.5; 0: no such bound
  const SizingField* size = nullptr;  ///< of the share; lives as long as the target; asked from several threads at once
  bool thorough = true;               ///< vertices are put at new places for it, which takes longer

  /// The least length of an edge with this middle (world mm), mm. Pre: `size` is not null if there is a share.
  double least_mm(const Point& middle) const { return share > 0 ? std::max(mm, share * size->size_at(middle)) : mm; }
  /// Whether an edge with this middle is to be longer. Pre: as above.
  bool asks_more_than(double length_mm, const Point& middle) const {
    return mm > length_mm || (share > 0 && size->size_down_to(middle, length_mm / share) > length_mm / share);
  }
};

inline constexpr double kMostMinDihedralDeg = 60;   ///< of ElementBounds::min_dihedral_deg; the regular tet has 70.5°
inline constexpr double kLeastMaxDihedralDeg = 90;  ///< of ElementBounds::max_dihedral_deg
inline constexpr double kMostScaledJacobian = 0.9;  ///< of ElementBounds::min_scaled_jacobian
inline constexpr double kMostMinEdgeShare = 0.5;    ///< of EdgeTarget::share

/// Bounds on the shape of tets, the rules, and bounds on edges.
struct ElementBounds {
  double min_dihedral_deg = 10;   ///< no dihedral angle is smaller, 0 … 60; 0: no bound
  double max_dihedral_deg = 180;  ///< none is larger, 90 … 180; 180: no bound
  /// No scaled Jacobian is smaller, 0 … 0.9; 0: no bound. It is √2 · 6 · volume / the largest product of the three
  /// edges at a corner: 1 of the regular tet.
  double min_scaled_jacobian = 0;
  /// None: the rules are not looked at. They are not asked of elements with a vertex on a curve or at a corner.
  std::optional<RuleTarget> rules = std::nullopt;
  /// None: edges may be of any length. Sought last, and by no change that breaks one of the others.
  std::optional<EdgeTarget> min_edge = std::nullopt;
};

}  // namespace scantet
