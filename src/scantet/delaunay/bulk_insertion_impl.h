// Private: inserts many points at once.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/delaunay/seed_lattice.h"
#include "scantet/delaunay/triangulation_impl.h"

namespace scantet::engine {

/// A point to insert, and what it lies on.
struct SamplePoint {
  Point point;
  std::uint8_t dimension = 3;  ///< as Stratum::dimension
  Patch patch{};               ///< with dimension 2, if known already
  double weight = 0;           ///< mm², see Triangulation::set_weights
};

/// Inserts the points into a triangulation that has none, on several threads. Duplicates are dropped, and what lies in
/// a ball. Those with weights are the first of the vector; they become the first vertices, in their order. The
/// triangulation depends on the points only; the numbers of its vertices and cells depend on the points and the
/// lattice. lattice: one that many of the points are on, which are then inserted more quickly unless there are weights;
/// side 0: none. If cancelled, it stops early, with some of the points.
void insert_in_bulk(std::vector<SamplePoint> points, Triangulation& t, Progress& progress,
                    const SeedLattice& lattice = {});

}  // namespace scantet::engine
