// What a job asks of sizes, as typed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

inline constexpr double kFeatureShare = 0.3;  ///< SizeOptions::feature_share when the job does not say

class OptionSet;

/// The sizes of a mesh as texts and numbers, as docs/sizing.md describes them.
struct SizeOptions {
  std::string size;                       ///< a number of mm, "auto", a file or a formula; empty: the input's
  std::string boundary_size;              ///< the same; empty: as inside
  std::vector<std::string> region_sizes;  ///< "2=1.5", "skull=1.5": region = mm; each region once
  /// Smaller sizes that "auto", a formula or an image give are raised to this, > 0. None: those of a formula or an
  /// image are not; those of "auto" are, to the least voxel spacing, or a 200th of the longest side of an object that
  /// is no image, or OpenedDomain::min_size_mm, if that is more.
  std::optional<double> least_mm;
  std::optional<double> feature_share;  ///< "auto" is this share of the feature size, > 0; none: kFeatureShare
  std::optional<double> lipschitz_k;    ///< "auto" goes by the paper's lr_k, k > 0; none: by d_M
  std::string layers;  ///< "2" or "3,skull,4": tets across parts, 2 to 20, and regions; empty: none asked
  std::vector<std::string> size_where;  ///< "ball(0, 0, 9, 4)=1.5": a place and the size there, mm
  std::optional<double> target_tets;  ///< ≥ 1: one size, of which about so many tets are to be expected; none: as asked
};

/// Declares --size, --boundary-size, --region-size, --size-where, --layers, --target-tets, --least-size,
/// --feature-share and --lipschitz with the fields of `sizes`, which must outlive `options`, as targets. Pre: it has
/// none of these yet.
void declare_size_options(OptionSet& options, SizeOptions& sizes);

}  // namespace scantet
