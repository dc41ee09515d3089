// Samples of curves and corners, in the three ways that are compared, and what they protect.
#pragma once

#include <vector>

#include "arrangement.h"

namespace scantet::bench {

/// How curves are protected.
enum class Method {
  kWeights,  ///< W: weighted points whose balls cover the curves
  kRefuse,   ///< U: no weights; nothing may enter the diametral balls of the curves' segments, and is left out
  kSplit,    ///< S: as U, but what would enter splits the segment while that is longer than a fraction of the size
  kCollar    ///< C: as U, with balls around samples, too, and rows of points on every patch along the curve
};

struct MeshVertex {
  Point point;
  double weight = 0;    ///< mm^2
  int dimension = 3;    ///< 0 at a corner, 1 on a curve, 2 on a patch, 3 anywhere
  Patches patches = 0;  ///< that it lies on
};

/// A piece of a curve between two samples next to each other.
struct CurveSegment {
  int curve = 0;
  double from = 0, to = 0;  ///< arc lengths, mm
  int vertex[2] = {0, 0};
};

struct Guard {
  Point center;
  double radius = 0;  ///< mm
};

struct CurveSample {
  std::vector<MeshVertex> vertices;  ///< corners first, in their order
  std::vector<CurveSegment> segments;
  std::vector<Guard> guards;  ///< balls that no further point may enter, besides the segments' diametral balls
  int loose = 0;              ///< W: balls next to each other that do not overlap, others that do
};

CurveSample sample_curves(const Arrangement& domain, double size_mm, Method method);

/// Adds the collars: rows of points along every curve on every patch that meets there, and their guards.
void add_collars(const Arrangement& domain, CurveSample& sample);

/// Points of the patches, at random, about 0.92 size apart from each other and off what is protected.
std::vector<MeshVertex> sample_patches(const Arrangement& domain, const CurveSample& sample, double size_mm,
                                       Method method, unsigned seed);

/// Whether a point lies in a guard or in the diametral ball of a segment; segment: that segment, or -1.
bool is_protected(const CurveSample& sample, const Point& p, int& segment);

}  // namespace scantet::bench
