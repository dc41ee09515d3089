// The program as a command-line module of 3D Slicer: it describes its parameters in XML, takes them as Slicer gives
// them, and tells its progress and results as Slicer reads them. docs/slicer.md.
#pragma once

#include <string>
#include <vector>

#include "scantet/plugin/plugin_registry.h"

namespace scantet {

/// `--xml`: the parameters of a module that meshes an image, made from the declarations of the options. Names have
/// underscores for hyphens, as the schema asks.
std::string slicer_description(const PluginRegistry& plugins);

/// `scantet slicer INPUT OUTPUT... [parameters]`, what lib/scantet/slicer/ScantetMesh and the plugin of ParaView call:
/// meshes INPUT into OUTPUT (Slicer names one, the plugin others for the boundary). A parameter that is empty or has
/// its default value counts as not given, as Slicer passes all of them. Return: exit status; 0 also where a mesh was
/// written that misses a bound, since Slicer drops what comes with another. Throws Error as run_mesh_job() does.
int run_slicer_module(const std::vector<std::string>& words, const PluginRegistry& plugins);

}  // namespace scantet
