// The registry that a program starts from.
#pragma once

#include "scantet/base/api.h"
#include "scantet/plugin/plugin_registry.h"

namespace SCANTET_PROGRAM_API scantet {

/// The registry with the built-in plugin, which opens images. Plugins that are added may not declare the options of a
/// mesh job.
PluginRegistry built_in_plugins();

}  // namespace scantet
