// OpenVDB, kept away from the program's own process.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scantet/base/progress.h"
#include "vdb_grid.h"

namespace vdb {

/// read_heads() in a child process with limits of time and memory (limits_for() of the file's size, and 64 times its
/// bytes). Throws Error: as read_heads(); input.corrupt, too, for whatever else befalls OpenVDB. Empty if
/// progress.cancelled() became true.
std::vector<GridHead> read_heads_apart(const std::string& file, const scantet::Progress& progress);

/// read_grid() in the same way. Nullopt if progress.cancelled() became true.
std::optional<Grid> read_grid_apart(const std::string& file, const std::optional<std::string>& name,
                                    const scantet::Progress& progress);

}  // namespace vdb
