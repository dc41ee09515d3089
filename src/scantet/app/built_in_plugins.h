// The registry that a program starts from.
#pragma once

#include <memory>

#include "scantet/base/api.h"
#include "scantet/plugin/plugin_registry.h"
#include "scantet/scan_input/image_plugin.h"

namespace SCANTET_PROGRAM_API scantet {

/// The registry with the built-in plugin, which opens images. Plugins that are added may not declare the options of a
/// mesh job. in_memory: scans that it opens by name; null: none.
PluginRegistry built_in_plugins(const std::shared_ptr<const ScansInMemory>& in_memory = nullptr);

}  // namespace scantet
