// What `--repair` does to a surface that would be refused.
#pragma once

#include <string>
#include <vector>

#include "surface.h"

namespace polyhedron {

/// Makes a surface closed and free of self-intersections where that takes little: joins border edges that lie on each
/// other, drops pieces of fewer than four facets (they enclose nothing), fills holes of up to kMostHoleEdges edges with
/// triangles, and replaces small patches of triangles that meet others. Faces come out as triangles.
/// Appends to `done` what it did: "filled 2 holes, the largest of 14 edges". Leaves what it cannot repair.
void repair_surface(Surface& surface, std::vector<std::string>& done);

inline constexpr std::size_t kMostHoleEdges = 1000;

}  // namespace polyhedron
