// Private: whether the boundary of the mesh is a surface at its vertices.
#pragma once

#include <functional>
#include <vector>

#include "scantet/refine/triangulation_impl.h"

namespace scantet::refine {

/// The facets between two regions as seen from the one with the smaller number that is not outside, in the order of
/// their codes.
std::vector<FacetCode> boundary_facets(const Triangulation& t);

/// For each vertex on ∂O that is not known to have a disk: notes it if the boundary facets around it form one disk, and
/// calls broken(v) if not, on several threads, at once only for vertices of different pieces of `kLinkGrain` slots.
/// A vertex without boundary facets has no disk.
void check_disks(Triangulation& t, const std::vector<FacetCode>& facets, const std::function<void(PointId)>& broken);

inline constexpr std::size_t kLinkGrain = 4096;

}  // namespace scantet::refine
