// Lines that a user draws along edges of a surface.
#pragma once

#include <array>
#include <set>
#include <string>
#include <vector>

#include "scantet/base/geometry.h"
#include "surface.h"

namespace polyhedron {

/// A line of straight pieces, and where it stands: "edges.obj:12".
struct EdgeLine {
  std::vector<scantet::Point> points;
  std::string place;
};

/// The lines of a file: of a .obj its elements "l" (as Blender and others write edges), of any other file those of
/// CGAL's polylines, a line of text each: how many points, and their coordinates. Throws scantet::Error:
/// input.edges (no file, not a line that can be, or none at all).
std::vector<EdgeLine> read_edge_lines(const std::string& file);

/// What lines are of a surface.
struct FollowedLines {
  std::set<Surface::Edge_index> edges;   ///< along which they run
  std::set<std::array<double, 3>> ends;  ///< places where a line begins or ends, but for closed ones
};

/// A piece of a line runs along one edge or several that lie on it, to 1e-6 of the box's diagonal; its ends are
/// vertices. Throws scantet::Error (input.edges): a piece that runs along none, with its place.
FollowedLines follow_lines(const Surface& surface, const std::vector<EdgeLine>& lines);

}  // namespace polyhedron
