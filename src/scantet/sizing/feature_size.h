// How fine the shape of a boundary is, from place to place.
#pragma once

#include <optional>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/domain/cone_tree.h"
#include "scantet/domain/domain.h"

namespace scantet {

struct FeatureOptions {
  /// The slope k > 0 of the Lipschitz radius lr_k (paper, section 6.1), which is positive at edges where normals turn
  /// by less than 2 arctan k; the paper's proofs ask for k < tan 18.6° = 0.336. None: d_M, the distance to the medial
  /// axis (section 2), which is 0 at edges.
  std::optional<double> lipschitz_k;
  /// The boundary is sampled no denser than that, mm, > 0, nor with more than 200,000 points, so narrower features may
  /// be passed over. Where no feature needs it, the sample is less dense.
  double spacing_mm = 1;
};

struct FeatureSizes {
  /// Points of the boundary, each with its feature size as height: positive and finite.
  std::vector<Cone> sizes;
  double spacing_mm = 0;  ///< of the points, about
};

/// Points of the boundary, evenly about spacing_mm apart, so that none of the boundary is further from them. If that
/// takes more than 200,000 points, spacing_mm is set to what it must be. Throws and cancels as feature_sizes.
std::vector<Point> boundary_sample(const Domain& domain, double& spacing_mm, Progress& progress);

/// The feature size at points of the boundary.
///
/// d_M is the distance to the nearest pole of the sample (Amenta and Bern 1999) from whose centre the sample points of
/// its ball are seen under 45° or more; poles of smaller angles come from noise, edges, and the rim of the medial axis.
/// Error: where d_M ≥ 4 spacings, within 10 % on a sphere and tori, 13 % on ellipsoids with axes 1 : 2 (too large at
/// the tips). Where the spacing is not small beside it, d_M comes out too large.
///
/// lr_k is the distance at which the normals of the sample no longer fit into a cone of half-angle arctan k. Error: the
/// cone is found by adding one normal after the other, and so is up to 1.5 times too wide, which makes lr_k too small
/// rather than too large; the distance is an eighth off at most.
///
/// Throws Error (input.empty) if the domain has no boundary. Empty if cancelled. The same for any number of threads.
FeatureSizes feature_sizes(const Domain& domain, const FeatureOptions& options, Progress& progress);

}  // namespace scantet
