// The options that say how a scan is made simpler before it is meshed.
#pragma once

#include <string>

#include "scantet/base/options.h"
#include "scantet/plugin/input_info.h"
#include "scantet/reading/simplify.h"

namespace scantet {

struct SimplifyOptions {
  Simplification how;       ///< but for what is cut away
  std::string crop_mm;      ///< as read_crop() takes it; empty: nothing is cut away
  std::string crop_voxels;  ///< the same

  /// Declares --crop, --crop-voxels, --median, --smooth, --smoothing and --resample under the heading `group`.
  void declare(OptionSet& options, const std::string& group);

  /// All that is asked for. Throws Error: usage.crop; usage.no_effect (--smoothing without --smooth).
  Simplification simplification() const;
};

/// What has been done, as a sentence without a full stop; empty if nothing. frame: of the image.
std::string simplification_note(const Simplification& how, const Frame& frame);

/// The same for `scantet info`, step by step.
InfoSection describe_simplification(const Simplification& how);

}  // namespace scantet
