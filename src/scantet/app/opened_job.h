// The part of a job that needs no files: from an opened input to an audited mesh.
#pragma once

#include <optional>
#include <vector>

#include "scantet/app/job_result.h"
#include "scantet/app/mesh_job.h"
#include "scantet/app/meshing.h"
#include "scantet/base/budget.h"
#include "scantet/plugin/input_plugin.h"
#include "scantet/size_options/size_choice.h"

namespace scantet {

/// The result of a job that has ended before there is a mesh: cancelled, or with its budget used up.
JobResult ended_job(const MeshJob& job, const Budget& budget);

/// The planes of the cuts that are asked for by themselves, not by the border. Throws Error: usage.cut.
std::vector<CutPlane> read_cuts(const CutOptions& cut);

/// Cuts what was opened as the job says. job.input names the object in messages. Throws Error: usage.cut,
/// usage.no_effect (the input has no border to cap), input.cut (nothing is left).
void cut_opened(const MeshJob& job, OpenedDomain& opened);

/// The size that the job asks for of what was opened. A null field if cancelled. sizes: of the job. Throws Error: as
/// choose_affordable_size().
ChosenSize choose_job_size(const MeshJob& job, const SizePlan& sizes, const OpenedDomain& opened, Budget& budget);

/// Makes what was opened anew for facets of the size, where its input can (OpenedDomain::fit), and cuts it again as
/// cut_opened() did. Sizes that go by thickness are then chosen anew. size: without a field if cancelled, before
/// or in this; opened stays as it is then. Return: what that took, of the stage "read". Throws Error: as cut_opened()
/// and choose_job_size().
std::vector<PhaseAccount> fit_opened(const MeshJob& job, const SizePlan& sizes, ChosenSize& size, OpenedDomain& opened,
                                     Budget& budget);

/// Meshes what was opened at the size, improves the mesh, measures and audits it. Fills result: findings, notes, and
/// the report but for its input, options and files. timing: what this took. job: with its bounds resolved; job.input
/// names the object in messages. opened: its boundary moves with the mesh, where it can (settle_volumes()). search: as
/// mesh_and_optimize() takes it. budget: is closed once there is a mesh.
/// Return: empty if it ended before there was a mesh: see ended_job(). Throws Error: as mesh_and_optimize();
/// input.empty_mesh (the size is too large for the object), usage.max_vertices.
std::optional<Meshing> mesh_opened(const MeshJob& job, OpenedDomain& opened, const ChosenSize& size, Budget& budget,
                                   ReportTiming& timing, JobResult& result, const FaultSearch& search = {});

}  // namespace scantet
