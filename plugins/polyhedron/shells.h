// Which shells of a surface lie in which.
#pragma once

#include <vector>

#include "scantet/domain/domain.h"
#include "surface.h"

namespace polyhedron {

/// A component of the inside for each shell (connected piece of a closed surface) that lies in an even number of
/// others, a cavity for each other one: what lies between it and the shells directly in it. domain: of the surface; its
/// the second components of crossings number shells. shell_of: the shell of each face, from 0 to `shells` - 1. Returns
/// nothing if a shell is so thin that no point in it can be found.
std::vector<scantet::Component> find_components(const scantet::Domain& domain, const Surface& surface,
                                                const std::vector<std::size_t>& shell_of, std::size_t shells);

}  // namespace polyhedron
