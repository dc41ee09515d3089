// A scan as an OpenVDB grid.
#pragma once

#include <optional>
#include <string>

#include "scantet/base/progress.h"
#include "scantet/field/scan.h"

namespace vdb {

/// Writes the scan as the grid "density" of a .vdb file, whole or not at all: as floats, or as doubles where voxels
/// have more than 24 bits. Values and frame are kept; index (0, 0, 0) is the first voxel. Active are the voxels that
/// differ from the background, and the first and the last of all, so that the grid has the box of the scan.
///
/// outside: the background, in voxel values; default: the smallest value of the scan. Meshing the grid gives what
/// meshing the scan with that --outside does.
/// Return: false if cancelled. Throws Error: usage.outside (not a number the grid can hold), output.* (AtomicFile).
bool write_scan(const scantet::Scan& scan, const std::optional<double>& outside, const std::string& file,
                scantet::Progress& progress);

}  // namespace vdb
