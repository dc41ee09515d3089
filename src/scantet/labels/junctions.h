// The curves where three or more regions of a label field meet, and the corners where these end or meet.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/domain/curve.h"
#include "scantet/labels/junction_crossings.h"
#include "scantet/labels/label_field.h"

namespace scantet {

/// Lengths in voxels are measured along the grid's axes, in steps from centre to centre.
struct Junctions {
  std::vector<std::shared_ptr<const Curve>> curves;  ///< with their regions in their order around them; use the field
  std::vector<Corner> corners;                       ///< that the curves' ends refer to
  std::vector<JunctionCrossing> crossings;           ///< corners where curves of the same regions cross
  std::size_t open_ends = 0;                         ///< corners at which one curve ends and no other one
  std::size_t unsettled = 0;   ///< points of the tracing that are on interfaces only, off the trilinear fields' curves
  std::size_t contracted = 0;  ///< curves shorter than a tenth of a voxel, each of which became a corner
  std::size_t loops = 0;       ///< left out: closed curves as short as that
  std::size_t broken = 0;      ///< pieces that rounding took from the tracing
};

/// Finds them all. The field must outlive the curves. Points of the curves are where the fields of their regions are
/// equal (JunctionCurve); their courses keep to within 0.02 of the shortest voxel edge of all points traced. The
/// outcome does not depend on the number of threads. Where curves come closer than 0.02 voxels they are one.
/// Progress: stage "read", doing "junctions". Return: nothing if it was cancelled.
/// Source: the linear interpolation in tets of Nielson and Franke, Computing the separating surface for segmented data
/// (1997), with the meshes of tets of Kuhn (1960); the points by Newton's method.
Junctions find_junctions(const LabelField& field, Progress& progress);

}  // namespace scantet
