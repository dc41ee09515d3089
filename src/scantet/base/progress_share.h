// How much of a job is done, as one number: for hosts that show a bar.
#pragma once

#include "scantet/base/api.h"
#include "scantet/base/progress.h"

namespace SCANTET_API scantet {

/// The share of a job that is done, from 0 to 1, by what reading, sampling, refining, improving, auditing and writing
/// usually take of the whole; 0 for any other stage, as "sizes". It may fall, also as refinement finds more to do: who
/// shows it keeps the largest.
double progress_share(const ProgressState& state);

}  // namespace scantet
