// How fast this machine is beside the one that predictions were measured on.
#pragma once

namespace scantet {

/// Processor time of a fixed piece of meshing, seconds: about a tenth of one. Where the environment has
/// SCANTET_TRIAL, a duration, as `scantet cohort` sets it after its first plan, nothing is meshed, and that is it.
/// Throws Error: usage.value (SCANTET_TRIAL is no duration).
double trial_seconds();

}  // namespace scantet
