// What a job found out about its mesh.
#pragma once

#include <memory>

#include "scantet/app/job_result.h"
#include "scantet/app/mesh_job.h"
#include "scantet/app/meshing.h"
#include "scantet/plugin/input_plugin.h"
#include "scantet/size_options/size_choice.h"

namespace scantet {

/// Measures and audits the mesh and fills the report's part about it: how it ended, stages, rules, optimization,
/// quality, bounds, audit, regions. What was asked for and is not so becomes a finding of the result, what is worth
/// knowing a note; adds what it takes to the report's phases. chosen: the size that was asked for, without the
/// finer places of `meshing`. job: with its bounds resolved. budget: closed. grid: that of the input, if it is known.
void inspect(const Meshing& meshing, const OpenedDomain& opened, const ChosenSize& chosen, const MeshJob& job,
             Budget& budget, std::optional<RegionGrid> grid, JobResult& result);

}  // namespace scantet
