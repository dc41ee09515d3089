// Private: surface candidates where sizes vary.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "scantet/domain/domain.h"

namespace scantet::engine {

/// On which scale the boundary has been looked at, and on which it has to be.
struct CandidateScale {
  double seen_mm;                                  ///< spacing of the candidates there are
  double finest_mm;                                ///< the least spacing, > 0
  double steepness;                                ///< Lipschitz constant of spacing_at
  std::function<double(const Point&)> spacing_at;  ///< the spacing needed, mm
};

/// Boundary points in cubes of side seen_mm around the given ones, about as far apart as is needed there; none where
/// the candidates there are will do. Several threads; always in the same order. None if that takes more than
/// `most_lines` lines through the domain.
std::optional<std::vector<Point>> closer_candidates(const Domain& domain, std::span<const Point> points,
                                                    const CandidateScale& scale, double most_lines);

}  // namespace scantet::engine
