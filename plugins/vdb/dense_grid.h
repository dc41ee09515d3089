// A grid of whole numbers, voxel by voxel, as segmentations are looked at.
#pragma once

#include <optional>
#include <string>

#include "scantet/field/scan.h"
#include "vdb_grid.h"

namespace vdb {

/// The voxels of a grid of int32 or int64, in its box; nullopt of others, and if all voxels are equal. file: for
/// messages. Throws Error (Fault::input): input.too_large (more than 2³¹ voxels, or more than 2²⁷ of which not one in a
/// thousand is stored).
std::optional<scantet::Scan> dense_scan(const Grid& grid, const std::string& file);

}  // namespace vdb
