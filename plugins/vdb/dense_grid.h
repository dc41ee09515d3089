// A grid voxel by voxel, as segmentations are looked at, and fields are verified.
#pragma once

#include <optional>
#include <string>

#include "scantet/field/scan.h"
#include "vdb_grid.h"

namespace vdb {

/// Whether it is a grid of int32 or int64.
bool holds_whole_numbers(const Grid& grid);

/// The voxels of a grid in its box; nullopt if all are equal, or the box is flat. file: for messages. Throws Error
/// (Fault::input): input.too_large (more than 2³¹ voxels, more than 2²⁷ of which not one in a thousand is stored by
/// itself, or more than half of the machine's memory).
std::optional<scantet::Scan> dense_scan(const Grid& grid, const std::string& file);

}  // namespace vdb
