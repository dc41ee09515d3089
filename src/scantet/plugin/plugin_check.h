// Plugins are not trusted: what they make is checked first.
#pragma once

#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/plugin/input_plugin.h"

namespace SCANTET_API scantet {

/// Opens the input and checks what comes back: there must be a domain, a usable default size, and a finite box of a
/// scale that can be computed with, and nothing of the object may be on the box's surface (at points of a fixed grid on
/// each face and along the lines of that grid). Throws Error: what open() throws; input.bounds (the box);
/// internal.plugin (no domain or size, or an exception that is no Error: a fault of the plugin).
OpenedDomain open_checked(InputPlugin& plugin, const std::string& input, Progress& progress);

/// Converts the input. also_read: files that the output must not replace beside the input's own, by whatever name or
/// link, as PluginRegistry::files(). Return: false if cancelled.
/// Throws Error: what convert() throws; usage.same_file, output.* (before anything is read); internal.plugin (no file,
/// or an exception that is no Error).
bool convert_checked(InputPlugin& plugin, const std::string& input, const std::string& output, Progress& progress,
                     const std::vector<std::string>& also_read = {});

}  // namespace scantet
