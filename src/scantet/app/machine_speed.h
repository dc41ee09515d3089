// How fast this machine is beside the one that predictions were measured on.
#pragma once

namespace scantet {

/// Processor time of a fixed piece of meshing, seconds: about a tenth of one.
double trial_seconds();

}  // namespace scantet
