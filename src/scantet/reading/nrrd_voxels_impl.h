// Whether a NRRD file holds as many voxels as its header states. Internal to the reader.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "scantet/base/api.h"

namespace SCANTET_PROGRAM_API scantet {

/// What stands for files of voxels in a NRRD header: "slice%03d.raw 1 90 1".
struct NrrdPattern {
  std::string name;
  std::size_t percent;  ///< where the number stands in the name
  std::size_t end;      ///< of "%03", where the d is
  double from;
  double to;
  double step;
};

/// nullopt if it is not one conversion of a whole number with three or four numbers behind it, or stands for 10,000
/// files or more.
std::optional<NrrdPattern> nrrd_pattern(const std::string& value);

/// Teem sets memory for all voxels to zero before it reads the first, so what cannot be there is refused before. Voxels
/// may be in several files, of which those that are not there count nothing. bytes, numbers: of all voxels, numbers as
/// text has them. Throws Error: input.corrupt.
void check_nrrd_voxels(const std::string& path, std::uint64_t bytes, std::uint64_t numbers);

}  // namespace scantet
