// The main job: open -> sample -> refine -> audit -> write.
#pragma once

#include "scantet/app/job_result.h"
#include "scantet/app/mesh_job.h"
#include "scantet/base/api.h"
#include "scantet/base/progress.h"
#include "scantet/plugin/plugin_registry.h"

namespace SCANTET_PROGRAM_API scantet {

/// Checks the options and outputs, opens the input with the best plugin, meshes it, audits the mesh and writes the
/// files and reports. Cancelling works until all files are complete under temporary names; then they take their own. If
/// a budget (job.budget) is used up, the mesh by then is kept, with a finding; if there is none yet, there is a finding
/// alone: then report.mesh is empty and nothing is written. A mesh that the clock or the memory ended may differ from
/// run to run. Throws Error: usage.*, input.*, output.* as the parts do; usage.size (a size so small that the mesh
/// would exceed max_vertices, or its default if that is more, ten times over), usage.memory (it would take more memory
/// than there is). Guarantees: prints nothing; the same job on the same input writes the same meshes, byte for byte.
JobResult run_mesh_job(const MeshJob& job, const PluginRegistry& plugins, Progress& progress);

}  // namespace scantet
