// The tests of one facet's collar, each a proof if it says yes. All in index coordinates.
#pragma once

#include <array>

#include "scantet/verify/voxel_nodes.h"

namespace scantet::verify {

/// A facet with a fibre at each corner: the points p[n] + s·e[n], -1 ≤ s ≤ 1, and between corners what is linear.
/// Its corners turn to the left as seen from where the fibres point to.
struct Prism {
  std::array<IntervalVec, 3> p;
  std::array<IntervalVec, 3> e;

  IntervalVec at(std::size_t corner, const Interval& s) const { return p[corner] + s * e[corner]; }
  /// The box around the collar between two values of s.
  Box box(double from, double to) const;
};

/// Whether the collar's map has a positive determinant everywhere: no two fibres cross near each other.
bool unfolds(const Prism& prism);

/// Whether the field grows along all fibres, in every closed cell that they touch. boxes: how many may be looked at.
bool rises(const VoxelNodes& nodes, const Prism& prism, int boxes);

/// Whether the field is positive (side 1) or negative (-1) on the whole triangle of the collar at s.
bool has_side(const VoxelNodes& nodes, const Prism& prism, double s, int side, int boxes);

/// Whether the triangles at s of two facets have no point in common, for every s from -1 to 1.
bool stay_apart(const Prism& a, const Prism& b);

}  // namespace scantet::verify
