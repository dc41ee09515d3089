// What is wrong with a mesh, as the next attempt needs it: where, and whether it is less than before.
#pragma once

#include <compare>
#include <cstddef>
#include <vector>

#include "scantet/app/meshing.h"
#include "scantet/app/trouble_spots.h"
#include "scantet/check/distance.h"

namespace scantet {

/// Parts of either boundary that are farther from the other than was asked for.
std::size_t far_parts(const BoundaryDistance& distance);

/// What is wrong with elements, and with what is between them, but for what the search found and what is too far. Where
/// many elements are out of bounds, not for curves' sake, smaller ones only multiply: they get no size of their own.
/// Where little is lost of a domain without curves, what is left are ribbons, a thousandth of the size thick, and few:
/// more get one, of whatever size.
MeshFaults mesh_faults(const Meshing& meshing, bool has_curves);

/// With no more losses a mesh is nearly right: more is done about its elements, and about handles that are wrong.
inline constexpr std::size_t kFewLosses = 3;

/// Whether the Euler number tells of more handles than that which are wrong, but of no more than 20.
bool has_several_wrong_handles(const Meshing& meshing);
/// Whether nothing is wrong but a few handles, which have been counted and have no place. faults: mesh_faults().
bool has_only_wrong_handles(const Meshing& meshing, const MeshFaults& faults);
/// Whether of the topology nothing is wrong but a few handles, of which some are there for others, as the Euler number
/// of the boundary is right.
bool has_exchanged_handles(const Meshing& meshing, const MeshFaults& faults);

/// How much is wrong with a mesh: less is better.
struct Faults {
  std::size_t losses = 0;  ///< parts that are far count, too, and handles whose places are not known
  std::size_t spots = 0;   ///< with these, and what the search found and what is too far
  std::size_t all = 0;
  double lost_mm = 0;  ///< how far parts are, together
  friend auto operator<=>(const Faults&, const Faults&) = default;
};

/// faults: mesh_faults(); spots: how many these are.
Faults faults_of(const Meshing& meshing, const MeshFaults& faults, std::size_t spots);

/// The same, if it is no matter in how many spots they are.
Faults faults_in(const Meshing& meshing);

/// The places of all faults but those of handles, as nobody knows at which of these one is wrong; world mm.
std::vector<Point> fault_places(const Meshing& meshing);

/// Whether smaller elements at some places may mend what is wrong. was_near: what is too far has become so by
/// improvement alone.
bool finer_may_help(const Meshing& meshing, bool was_near);

/// Whether the last attempt made far more spots, or faults, than the best before.
bool is_worse_by_far(const Faults& best, const Faults& last);

/// Whether the last attempt left nothing but losses, many of them and hardly fewer than the best before: handles that
/// are too fine for the size have no places.
bool has_only_lost(const Faults& best, const Faults& last);

}  // namespace scantet
