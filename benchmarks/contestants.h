// Who is compared. Each function does one run, in this process, and returns its figures.
#pragma once

#include <cstdio>

#include "cases.h"
#include "figures.h"

namespace scantet::bench {

/// scantet, from a domain to a mesh. points: a file that is overwritten with the mesh's points for run_limit.
Figures run_scantet(const Case& c, int threads, std::FILE* points);

/// CGAL's Mesh_3 on its own domain of the same object at the same criteria; optimisers as the case says. ϱ_f is given
/// as the facet angle asin(1 / 2ϱ_f). The scan's axes must be parallel to the world's (CGAL's image knows spacing
/// only).
Figures run_cgal_sequential(const Case& c);
Figures run_cgal_parallel(const Case& c, int threads);

/// The yardstick: CGAL's plain Delaunay triangulation, one thread, of the points that run_scantet left. A mesher that
/// only triangulated its own final points, and took no time to find them, would take that long.
Figures run_limit(std::FILE* points);

}  // namespace scantet::bench
