// How fine the shape of a boundary is, from place to place.
#pragma once

#include <optional>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/domain/cone_tree.h"
#include "scantet/domain/domain.h"

namespace scantet {

struct FeatureOptions {
  /// None: d_M, the distance to the medial axis (paper, section 2): 0 at edges. Else the slope k > 0 of the Lipschitz
  /// radius lr_k (section 6.1), which is positive at edges where normals turn by less than 2 arctan k; the paper's
  /// proofs ask for k < tan 18.6° = 0.336.
  std::optional<double> lipschitz_k;
  /// The boundary is sampled no denser than that, mm, > 0, nor with more than 200,000 points: narrower features may be
  /// passed over. Less dense where no feature needs it.
  double spacing_mm = 1;
};

struct FeatureSizes {
  /// Points of the boundary, each with its feature size as height: positive and finite.
  std::vector<Cone> sizes;
  double spacing_mm = 0;  ///< of the points, about
};

/// Points of the boundary, evenly about spacing_mm apart (set to what it takes if that would be more than 200,000
/// points), none of the boundary further from them than that. Throws and cancels as feature_sizes.
std::vector<Point> boundary_sample(const Domain& domain, double& spacing_mm, Progress& progress);

/// The feature size at points of the boundary.
///
/// d_M is the distance to the nearest pole of the sample (Amenta and Bern 1999) from whose centre the sample points of
/// its ball are seen under 45° or more: what makes poles of less is noise, edges, and the rim of the medial axis.
/// Error: where d_M ≥ 4 spacings, within 10 % on a sphere and tori, 13 % on ellipsoids with axes 1 : 2 (too large at
/// the tips); where the spacing is not small beside it, d_M is too large.
///
/// lr_k is the distance at which the normals of the sample no longer fit into a cone of half-angle arctan k. Error: of
/// the cone, found by adding one normal after the other, up to 1.5 times, so lr_k comes out too small rather than too
/// large; of the distance, an eighth.
///
/// Throws Error (input.empty) if the domain has no boundary. Empty if cancelled. The same for any number of threads.
FeatureSizes feature_sizes(const Domain& domain, const FeatureOptions& options, Progress& progress);

}  // namespace scantet
