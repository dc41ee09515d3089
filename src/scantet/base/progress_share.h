// How much of a job is done, as one number: for hosts that show a bar.
#pragma once

#include "scantet/base/api.h"
#include "scantet/base/progress.h"

namespace SCANTET_API scantet {

/// From 0 to 1, by what stages usually take of the whole; 0 for a stage that is not of a job. It may fall a little, as
/// refinement finds more to do: who shows it keeps the largest.
double progress_share(const ProgressState& state);

}  // namespace scantet
