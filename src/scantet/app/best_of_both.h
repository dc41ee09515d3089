// Of two meshes of one domain, at each place the one that is right there.
#pragma once

#include <optional>

#include "scantet/app/meshing.h"

namespace scantet {

/// What is wrong with a mesh is often right in another one, as improvement has other luck in each. So where something
/// is wrong with the mesh that has fewer faults, and nothing with the other one within a few sizes, what is nearer than
/// twice the size is taken from that, as long as no region gets another Euler number. Where handles seem to be wrong in
/// either, that is taken which brings the Euler number of the inside nearer to the domain's (graft()).
///
/// one, other: improved and checked, in the order in which they were made. size: that was asked for. Return: the new
/// mesh, with what MeshResult says of tangles and curves at each place as the mesh has it that the place is from, the
/// places of handles of both, and the seconds of the second one; checks of it are not made. Nothing if there is no such
/// place, or if graft() gives nothing.
std::optional<Meshing> best_of_both(const Meshing& one, const Meshing& other, const Domain& domain,
                                    const SizingField& size);

}  // namespace scantet
