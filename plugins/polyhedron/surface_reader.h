// Surfaces from files.
#pragma once

#include <string>

#include "surface.h"

namespace polyhedron {

/// Reads a .off, .stl, .ply or .obj file into a closed triangle surface that does not meet itself. Points at the same
/// place are made one, facets that appear twice or have no area dropped, polygons cut into triangles; nothing is moved
/// and no hole is filled.
/// Throws scantet::Error: input.surface, naming the file and, where there is one, the place (mm).
Surface read_surface(const std::string& file);

}  // namespace polyhedron
