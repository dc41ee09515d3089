// How a finished job is shown.
#pragma once

#include "scantet/app/job.h"

namespace scantet {

/// Prints the report's tables and the files written (unless quiet), warnings and findings; returns the exit status.
int print_result(const JobResult& result, bool quiet);

}  // namespace scantet
