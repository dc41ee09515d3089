// Surfaces from files that nobody vouches for.
#pragma once

#include "surface_reader.h"

namespace polyhedron {

/// read_surface() in a process of its own, which may take 256 MiB and 64 times the file, and 10 s and 4 s for each MB
/// of it. Throws scantet::Error: as read_surface(), also if that process ends in any other way.
ReadSurface read_surface_apart(const std::string& file, bool repair, scantet::Progress& progress);

}  // namespace polyhedron
