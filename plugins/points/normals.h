// Normals that point out of the object.
#pragma once

#include "point_set.h"
#include "scantet/base/progress.h"

namespace points {

enum class NormalSource {
  given,     ///< those of the file; estimated if it has none
  estimate,  ///< estimated, whatever the file has
};

/// Gives every point a normal of length 1: the file's, or one estimated from the nearest points (a quadratic surface
/// fitted to 18 of them) and turned like its neighbours', along a spanning tree from the highest point of each piece of
/// the set, where it points up. The points may change places. Returns whether they were estimated.
///
/// A piece within another is thus taken for another object and not for a cavity, whose normals must be given.
/// Throws scantet::Error: input.points (a normal of length 0 among others). Returns early if cancelled.
bool settle_normals(const std::string& file, NormalSource source, PointSet& points, scantet::Progress& progress);

}  // namespace points
