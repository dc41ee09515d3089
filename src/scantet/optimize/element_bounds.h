// What is asked of the elements of a finished mesh.
#pragma once

#include <optional>

#include "scantet/base/api.h"
#include "scantet/domain/rule_bounds.h"
#include "scantet/domain/sizing_field.h"

namespace SCANTET_API scantet {

/// R1, R2 and R3 at a size.
struct RuleTarget {
  RuleBounds bounds;
  const SizingField* size;  ///< not null; lives as long as the target; asked from several threads at once
};

inline constexpr double kMostMinDihedralDeg = 60;   ///< the regular tet has 70.5°
inline constexpr double kLeastMaxDihedralDeg = 90;  ///< of ElementBounds::max_dihedral_deg
inline constexpr double kMostScaledJacobian = 0.9;

/// Bounds on the shape of tets, and the rules.
struct ElementBounds {
  double min_dihedral_deg = 10;   ///< no dihedral angle is smaller, 0 … 60; 0: no bound
  double max_dihedral_deg = 180;  ///< none is larger, 90 … 180; 180: no bound
  double min_scaled_jacobian = 0;  ///< none is smaller, 0 … 0.9; 0: no bound. 1 is the regular tet (quality/measures.h)
  std::optional<RuleTarget> rules = std::nullopt;  ///< none: the rules are not looked at
};

}  // namespace scantet
