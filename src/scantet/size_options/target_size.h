// The size that a mesh of so many tets takes, or one that fits into so much memory.
#pragma once

#include <optional>
#include <string>

#include "scantet/base/api.h"
#include "scantet/base/progress.h"
#include "scantet/plugin/input_plugin.h"
#include "scantet/size_options/affordable_size.h"
#include "scantet/size_options/mesh_prediction.h"

namespace SCANTET_PROGRAM_API scantet {

/// A size that was chosen.
struct TargetSize {
  double size_mm = 0;
  std::string note;  ///< which, and why; a sentence without a full stop
};

/// Spacing of the voxels of what was opened; none if it is no grid.
std::optional<double> finest_mm(const OpenedDomain& opened);

/// A request for one size, as if it had been typed.
SizeRequest number_request(double size_mm);

/// The size for sizes.target_tets; or, where no size at all is asked for and limits.memory_bytes is too little for the
/// input's own, one whose mesh is expected to fit. None if neither is to be chosen, or if cancelled. Throws Error:
/// usage.target_tets (other sizes or layers are asked for, or no size gives so few tets); usage.memory (none fits).
/// Guarantee: the same for any number of threads.
std::optional<TargetSize> choose_target_size(const SizeOptions& sizes, const SizePlan& plan, const SizeLimits& limits,
                                             const OpenedDomain& opened, Progress& progress);

}  // namespace scantet
