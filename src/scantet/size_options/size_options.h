// What a job asks of sizes, as typed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

inline constexpr double kFeatureShare = 0.3;  ///< when the job does not say

class OptionSet;

/// The sizes of a mesh as texts and numbers, as docs/sizing.md describes them.
struct SizeOptions {
  std::string size;                       ///< a number, "auto", a file or a formula; empty: the input's
  std::string boundary_size;              ///< the same; empty: as inside
  std::vector<std::string> region_sizes;  ///< "2=1.5", "skull=1.5": region = mm
  std::optional<double> least_mm;         ///< least of what "auto" gives; none: the voxel spacing, or the like
  std::optional<double> feature_share;    ///< "auto" is this share of the feature size; none: kFeatureShare
  std::optional<double> lipschitz_k;      ///< "auto" goes by lr_k; none: by d_M
  std::string layers;                     ///< "2" or "3,skull,4": least number of tets across parts; empty: none asked
  std::vector<std::string> size_where;    ///< "ball(0, 0, 9, 4)=1.5": a place and the size there, mm
  std::optional<double> target_tets;      ///< one size, such that about so many tets are to be expected; none: as asked
};

/// Declares --size and its kin.
void declare_size_options(OptionSet& options, SizeOptions& sizes);

}  // namespace scantet
