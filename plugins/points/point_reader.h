// Point sets from files.
#pragma once

#include <string>

#include "point_set.h"
#include "scantet/base/progress.h"

namespace points {

/// Whether the file, by its name and its first bytes, holds points: .xyz, .pwn, or a .ply without faces. Throws
/// nothing.
bool is_point_file(const std::string& file);

/// Reads the points, mm, in the file's order; of points at the same place the first is kept. Normals are as in the
/// file: zero vectors if it has none. Throws scantet::Error: input.points, with the line or the number of the point
/// that is at fault. Guarantees: all is finite; from kFewestPoints to kMostPoints points, which do not lie within a box
/// of less than 1e-6 mm or reach beyond 1e9 mm.
/// Empty if cancelled.
PointSet read_points(const std::string& file, const scantet::Progress& progress);

inline constexpr std::size_t kFewestPoints = 50;
inline constexpr std::size_t kMostPoints = 1'000'000;  // CGAL's triangulation has four vertices for each

}  // namespace points
