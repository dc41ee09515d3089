// Surfaces from files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scantet/base/progress.h"
#include "surface.h"

namespace polyhedron {

/// What reading a file came to.
struct ReadSurface {
  std::optional<Surface> surface;    ///< none if cancelled
  std::vector<std::string> repairs;  ///< what was done for `repair`, "filled 1 hole, ..."
};

/// Reads a .off, .stl, .ply or .obj file into a closed triangle surface that does not meet itself. Points at the same
/// place are made one, facets that appear twice or have no area dropped, polygons cut into triangles; nothing is moved
/// and no hole is filled.
/// repair: what would be refused is repaired first, if it can be (surface_repair.h).
/// Throws scantet::Error: input.surface, naming the file and, where there is one, the place (mm).
/// Returns no surface if progress.cancelled() became true.
ReadSurface read_surface(const std::string& file, bool repair, scantet::Progress& progress);

}  // namespace polyhedron
