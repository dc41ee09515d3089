// Sizes at points of the boundary.
#pragma once

#include <memory>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/plugin/input_plugin.h"
#include "scantet/size_options/size_options.h"
#include "scantet/size_options/size_request.h"
#include "scantet/sizing/feature_size.h"
#include "scantet/sizing/size_source.h"

namespace scantet {

/// Sizes at points of the boundary, none of which is further than spacing_mm from one of them.
struct BoundaryCones {
  std::vector<Cone> sizes;  ///< heights in mm, > 0; empty if cancelled
  double spacing_mm = 0;
};

/// What the sizes of "auto" follow from.
struct AutoSizes {
  double least_mm = 0;  ///< smaller sizes are raised to that
  double share = 0;     ///< of the feature size
  FeatureOptions features;
};

/// What the options ask of "auto", and what follows from the input where they do not say.
AutoSizes auto_sizes(const SizeOptions& options, const OpenedDomain& opened);

/// The sizes that "auto" gives on the boundary. Throws as feature_sizes.
BoundaryCones auto_cones(const Domain& domain, const AutoSizes& how, Progress& progress);

/// How many vertices a boundary of these sizes takes, about.
double vertices_of(const BoundaryCones& cones, const Domain& domain);

/// How many vertices the boundary takes at the sizes of "auto" by a coarse look, a small part of what auto_cones()
/// takes. It passes over what is narrow, so that there are rather more. 0 if cancelled. Throws as feature_sizes.
double rough_vertices(const Domain& domain, const AutoSizes& how, Progress& progress);

/// The sizes that a source gives on the boundary, not less than least_mm unless the request is a number. request: for
/// messages, and whose number says how closely to look. Throws Error: as boundary_sample; usage.size, where a size is
/// not positive.
BoundaryCones asked_cones(const Domain& domain, const SizeRequest& request, const SizeSource& source, double least_mm,
                          Progress& progress);

}  // namespace scantet
