// The option by which thin handles of a scan's level set are cut and thin tunnels filled.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scantet/base/options.h"
#include "scantet/base/progress.h"
#include "scantet/field/scan.h"
#include "scantet/image/nested_level_sets.h"
#include "scantet/plugin/input_info.h"
#include "scantet/topology/handle_closing.h"

namespace scantet {

struct HandleOption {
  std::optional<double> thinner_mm;  ///< none: handles stay

  /// Declares --close-handles under the heading `group`.
  void declare(OptionSet& options, const std::string& group);
};

/// The scan without the handles of its level set that are thinner than that. Of no use if cancelled. Throws Error: as
/// make_nested_level_sets(), usage.close_handles (several levels; wider than the image is long), input.too_large.
ClosedHandles without_thin_handles(const Scan& scan, const NestedLevelSettings& settings, double thinner_mm,
                                   const Progress& progress);

/// What has been done, as a sentence without a full stop.
std::string closing_note(const ClosedHandles& closed, double thinner_mm);

/// The same for `scantet info`.
InfoSection describe_closed(const ClosedHandles& closed);

}  // namespace scantet
