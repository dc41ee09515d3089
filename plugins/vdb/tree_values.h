// From OpenVDB's tree to what the field is made of. Private to the plugin's reader.
#pragma once

#include <openvdb/openvdb.h>

#include <string>

#include "vdb_grid.h"

namespace vdb {

/// The types of grid that are taken, as OpenVDB calls them: "float" …
bool is_supported(const openvdb::GridBase& grid);

/// Whether its values are yes and no: they are taken for the whole numbers 1 and 0.
bool is_mask(const openvdb::GridBase& grid);

/// Fills in all but `head` and `frame` of the grid: values, origin and the rest. The leaves stay where they are, in the
/// grid, which is kept alive. where: opens messages.
/// Throws Error(Fault::input): input.grid, input.nan, input.too_large (vdb_grid.h).
void take_values(const openvdb::GridBase::ConstPtr& source, const std::string& where, Grid& out);

}  // namespace vdb
