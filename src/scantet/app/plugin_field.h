// Fields that plugins read, for the verifier: OpenVDB's grids.
#pragma once

#include <string>

#include "scantet/base/api.h"
#include "scantet/base/progress.h"
#include "scantet/field/grid_field.h"
#include "scantet/plugin/plugin_registry.h"

namespace SCANTET_PROGRAM_API scantet {

/// The field of an input as the plugin for it reads it; without voxels if cancelled. grid: which of several; empty: the
/// only one. Throws Error: as PluginRegistry::create_for() and InputPlugin::field(); usage.grid (there is no choice of
/// grids); input.no_field (the input is no field between voxels).
GridField plugin_field(const PluginRegistry& plugins, const std::string& input, const std::string& grid,
                       Progress& progress);

}  // namespace scantet
