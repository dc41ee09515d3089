// The plugins of a run.
#pragma once

#include <string>
#include <vector>

#include "scantet/app/mesh_command_options.h"
#include "scantet/plugin/plugin_registry.h"

namespace scantet {

/// What is built in, the files given to --plugin among the words of the command line, and the plugin folder, in this
/// order. Prints a warning for each plugin of the folder that cannot be loaded.
/// Throws Error: usage.plugin (one named with --plugin cannot be loaded).
PluginRegistry load_plugins(const std::vector<std::string>& words);

}  // namespace scantet
