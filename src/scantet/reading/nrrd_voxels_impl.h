// Whether a NRRD file holds as many voxels as its header states. Internal to the reader.
#pragma once

#include <cstdint>
#include <string>

#include "scantet/base/api.h"

namespace SCANTET_PROGRAM_API scantet {

/// Teem sets memory for all voxels to zero before it reads the first, so what cannot be there is refused before. Voxels
/// may be in several files, of which those that are not there count nothing. bytes, numbers: of all voxels, numbers as
/// text has them. Throws Error: input.corrupt.
void check_nrrd_voxels(const std::string& path, std::uint64_t bytes, std::uint64_t numbers);

}  // namespace scantet
