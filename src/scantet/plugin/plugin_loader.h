// Plugins from shared libraries.
#pragma once

#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/plugin/plugin_registry.h"

namespace SCANTET_API scantet {

/// Loads the plugin in a shared library and adds it to the registry. The library stays loaded until the process ends.
/// All that is asked of a plugin before an input is opened happens in a child process first, so that one that crashes,
/// hangs (for 10 s), throws or ends the process does no harm. Call it before other threads are started.
/// file: its path. Throws Error: usage.plugin, naming the file (not there, not a shared library, a symbol missing,
/// another interface version, the child came to grief, an option of registry.taken_options(), a second plugin of that
/// name); internal.fork (no child process can be made). The registry is as it was then.
void load_plugin(const std::string& file, PluginRegistry& registry);

/// Loads every *.so of a folder, by name; a folder that is not there has none. A file that is in the registry already
/// is passed over. Return: a sentence for each plugin that could not be loaded, where load_plugin() throws Error. Call
/// it before other threads are started, too.
std::vector<std::string> load_plugin_folder(const std::string& folder, PluginRegistry& registry);

/// The plugin folder of this installation or build, which need not exist: scantet/plugins beside the library that holds
/// this function, an absolute path. Empty if that cannot be told.
std::string plugin_folder();

}  // namespace scantet
