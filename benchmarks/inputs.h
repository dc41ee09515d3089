// Objects that plugins open: implicit surfaces, and polyhedra of CGAL's data.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scantet/domain/domain.h"
#include "scantet/plugin/input_plugin.h"

namespace scantet::bench {

/// Opens what stands after `scantet mesh`, with the plugins of the plugin folder, whose warnings go to stderr. Call it
/// before other threads are started. Throws scantet::Error as open_checked does.
/// options: names and values, as after `--`.
OpenedDomain open_input(const std::string& input, const std::vector<std::pair<std::string, std::string>>& options = {});

/// The path of a file of CGAL's data ("meshes/elephant.off"), unpacked from Debian's package libcgal-demo into the
/// folder for temporary files when it is first asked for. Throws std::runtime_error if it cannot be had.
std::string cgal_data_file(const std::string& member);

/// Whether the package is installed.
bool has_cgal_data();

/// Where Debian's package invesalius-examples has a CT of a head, 256 × 256 × 108 voxels of 0.957 × 0.957 × 1.5 mm.
inline constexpr const char* kHeadCtArchive = "/usr/share/doc/invesalius-examples/examples/Cranium.inv3";

/// The path of that CT as NRRD, unpacked into the folder for temporary files when it is first asked for. Throws
/// std::runtime_error if it cannot be had.
std::string head_ct_file();

/// The surfaces that the plugin `implicit` knows by name, as compiled functions: negative inside.
using ImplicitFunction = double (*)(const Point&);

/// name: "torus", "tanglecube" or "gyroid". Throws std::runtime_error for another.
ImplicitFunction implicit_function(const std::string& name);

}  // namespace scantet::bench
