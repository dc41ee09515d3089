// Points of the domain's curves and corners, with balls around them that keep other points off.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"

namespace scantet {

/// A point of a curve, or a corner, and its ball.
struct CurveVertex {
  Point point;
  double radius_mm = 0;         ///< of the ball, > 0
  std::uint8_t dimension = 1;   ///< as Stratum::dimension: 0 at a corner
  std::vector<Region> regions;  ///< that meet there, ascending
  bool is_merged = false;       ///< it stands for points of several curves, or for several corners
};

/// A cover of the curves by balls: neighbours along a curve overlap, others do not, and none contains the centre of
/// another (Cheng, Dey, Ramos: Delaunay refinement for piecewise smooth complexes, SODA 2007). As weighted points they
/// keep whatever refinement inserts off the curves, and the segments between neighbours are edges of the triangulation.
struct CurveSample {
  std::vector<CurveVertex> vertices;
  /// Neighbours along curves.
  struct Piece {
    std::array<std::uint32_t, 2> vertices;
    std::uint32_t curve;  ///< of Domain::curves()
  };
  std::vector<Piece> pieces;
  /// Where curves come so close to each other that one ball covers several, world mm: the mesh does not part them.
  std::vector<Point> merged;
};

/// Balls of at most 2/3 alpha·σ, smaller where curves meet or come close to each other or hints tell of narrow places,
/// but nowhere smaller than about kSmallestBall · alpha·σ, or kSmallestAtJunctions where three regions or more meet at
/// a curve: what is closer is merged. A function of the arguments alone, whatever the number of threads. Both in world
/// mm; empty for a domain without curves and corners.
CurveSample sample_curves(const Domain& domain, const SizingField& size, double alpha);

inline constexpr double kSmallestBall = 0.02;        ///< of alpha·σ
inline constexpr double kSmallestAtJunctions = 0.1;  ///< of it: labels' curves run side by side wherever voxels are few

}  // namespace scantet
