// What a job writes.
#pragma once

#include "scantet/app/certify.h"
#include "scantet/app/job_result.h"
#include "scantet/app/mesh_job.h"
#include "scantet/base/stopwatch.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/plugin/input_plugin.h"

namespace scantet {

/// Writes the job's meshes and its report (result.report, whose options and input are set), all under temporary names
/// first. Then they take their own names: meshes in the order asked for, reports, and last the reports in JSON, which
/// list the other files with their checksums. Puts the names into result.written, and the times and phases into the
/// report. total: runs since the job began. Return: false if cancelled by then; nothing is written. Throws Error:
/// output.*. mesh: what reports are of; written: what mesh files hold, the same or of second order. model: of the mesh;
/// its decks are written beside. certifier: verifies the meshes before anything takes its name; null: nobody does.
bool write_job_files(const MeshJob& job, const OpenedDomain& opened, const TetMesh& mesh, const TetMesh& written,
                     const ModelPlan& model, ReportTiming timing, const Stopwatch& total, JobResult& result,
                     Certifier* certifier, Progress& progress);

}  // namespace scantet
