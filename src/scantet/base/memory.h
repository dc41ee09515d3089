// How much memory there is, and how much of it this process has.
#pragma once

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

/// Bytes of memory that this process holds now (resident); 0 if the system does not tell.
double resident_bytes();

/// Bytes of memory that the machine has.
double physical_bytes();

/// Bytes that the process can still have: the least of what the system has available and what its control groups
/// leave; infinite if the system does not tell.
double available_bytes();

}  // namespace scantet
