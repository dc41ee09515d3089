// Elements of second order at the end of a job.
#pragma once

#include <cstdint>
#include <string>

#include "scantet/app/job_result.h"
#include "scantet/app/mesh_job.h"
#include "scantet/base/progress.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/domain/domain.h"

namespace scantet {

/// Throws Error (usage.order) if the job asks for second order and for a certificate, which such meshes cannot have.
void check_order(const MeshJob& job);

/// Makes the mesh one of second order, and tells of it in the report and the notes; a tet whose Jacobian is not proved
/// is a finding. Return: false if cancelled.
bool make_order_two(TetMesh& mesh, const Domain& domain, JobResult& result, const Progress& progress);

/// The finding about so many tets.
std::string unproved_text(std::uint64_t tets);

}  // namespace scantet
