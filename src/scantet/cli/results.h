// How a finished job is shown.
#pragma once

#include "scantet/app/job.h"
#include "scantet/app/mesh_tools.h"

namespace scantet {

/// Prints the report's tables and the files written (unless quiet), warnings and findings; returns the exit status.
int print_result(const JobResult& result, bool quiet);

/// Prints a table for each mesh, under its name if there are several, and the rest likewise; returns the exit status.
int print_findings(const MeshFindings& found);

}  // namespace scantet
