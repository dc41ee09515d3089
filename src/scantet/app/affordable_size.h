// A job's size, unless it asks for more vertices than there could be.
#pragma once

#include "scantet/app/mesh_job.h"
#include "scantet/app/size_choice.h"

namespace scantet {

/// Makes the size field as choose_size does. Where it means more vertices than the job's max_vertices, or several
/// levels are closer to each other than it, a note says so. Throws Error: as choose_size does; usage.size, with a size
/// that will do: one finer than the domain can tell, or one that means more than ten times max_vertices, or its default
/// if that is more; usage.gap: levels so close that they do; usage.memory: a
/// mesh that takes more memory than --max-memory, or than the machine has available.
ChosenSize choose_affordable_size(const MeshJob& job, const SizePlan& plan, const OpenedDomain& opened,
                                  Progress& progress);

}  // namespace scantet
