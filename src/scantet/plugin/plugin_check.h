// Plugins are not trusted: what they make is checked first.
#pragma once

#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/plugin/input_plugin.h"

namespace SCANTET_API scantet {

/// Opens the input and checks what comes back: there must be a domain, and a default size that is finite and above 0;
/// the box must be finite, not empty, of a diagonal from 1e-15 to 1e16 mm, and no farther from the origin than 1e13
/// diagonals; nothing of the object may be on its surface, at 17 x 17 points of each face and along the lines through
/// these. Pre: the plugin's options are set. Return: what open() has given, unchecked if progress.cancelled() became
/// true.
/// Throws Error: what open() and the domain throw; input.bounds (the box); internal.plugin (no domain or size, or
/// either has thrown a std::exception that is neither Error nor std::bad_alloc: a fault of the plugin).
OpenedDomain open_checked(InputPlugin& plugin, const std::string& input, Progress& progress);

/// Converts the input. output: the file to write. also_read: files that the output must not replace beside the input's
/// own, by whatever name or link, as PluginRegistry::files(). Pre: can_convert() is above 0. Return: false if
/// cancelled. Throws Error: before anything is read usage.same_file, output.cannot_write, output.full; what convert()
/// throws; internal.plugin (it has written no file, or thrown a std::exception that is neither Error nor
/// std::bad_alloc).
bool convert_checked(InputPlugin& plugin, const std::string& input, const std::string& output, Progress& progress,
                     const std::vector<std::string>& also_read = {});

}  // namespace scantet
