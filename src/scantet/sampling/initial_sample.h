// P_i: the points on ∂O that refinement starts from.
#pragma once

#include <vector>

#include "scantet/base/progress.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"

namespace scantet {

struct SampleOptions {
  double alpha = 1;        ///< of the mesher: surface balls may have radius alpha·σ
  std::uint64_t seed = 0;  ///< of the random order of the darts
  /// The search for the boundary is refused where far more points than that are to be expected.
  std::uint64_t max_points = 20'000'000;
  bool near_hints = true;  ///< whether the sample is denser near the domain's features
};

/// A maximal Poisson-disk sample of the boundary, drawn from the domain's surface candidates and evened out.
///
/// The radius of the disks is 0.92·alpha·σ. Near the domain's features it is half of the local feature size they
/// announce (unless near_hints is false), so that small components, necks and gaps get points of their own. Two points
/// are at least 0.75 of the radius apart. This stands for conditions I1 and I2 of the paper (section 3), as far as the
/// domain knows the feature size. The sample is a function of the arguments alone: it depends neither on the order of
/// the candidates nor on the number of threads. If cancelled: fewer points, or none. Throws Error: input.empty (the
/// domain has no boundary point), usage.size (far more than max_points).
std::vector<Point> initial_sample(const Domain& domain, const SizingField& size, const SampleOptions& options,
                                  Progress& progress);

}  // namespace scantet
