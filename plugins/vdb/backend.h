// The part of the plugin that needs OpenVDB is a library of its own, loaded when a file is at hand: OpenVDB's takes a
// tenth of a second to load, and every start of the program asks every plugin what it opens.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/field/scan.h"
#include "vdb_grid.h"

namespace vdb {

/// grid_in_child.h and vdb_writer.h tell of them.
struct Backend {
  std::vector<GridHead> (*read_heads)(const std::string& file, const scantet::Progress& progress);
  std::optional<Grid> (*read_grid)(const std::string& file, const std::optional<std::string>& name,
                                   const scantet::Progress& progress);
  bool (*write_scan)(const scantet::Scan& scan, const std::optional<double>& outside, const std::string& file,
                     scantet::Progress& progress);
};

/// The one symbol of the library, under this name.
inline constexpr const char* kBackendSymbol = "scantet_vdb_backend";

/// Loads the library vdb/openvdb.so, beside the plugin's own file, at the first call; it stays. Throws Error:
/// usage.plugin (not there, or OpenVDB is missing).
const Backend& backend();

}  // namespace vdb
