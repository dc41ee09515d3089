// Whether a .vdb file is all there.
#pragma once

#include <string>

namespace vdb {

/// Throws Error (input.corrupt) if the file ends before the last of its grids does; OpenVDB does not look, and reads
/// rubbish. openvdb::initialize() must have been called.
void check_complete(const std::string& file);

}  // namespace vdb
