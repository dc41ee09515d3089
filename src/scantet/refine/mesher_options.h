// What the mesher is asked for.
#pragma once

#include <cstdint>
#include <optional>

namespace scantet {

/// How the triangulation starts.
enum class Seeding {
  bulk,  ///< a sample of the boundary and a lattice inside, inserted at once (DESIGN: seeding in bulk)
  paper  ///< the paper's P_i alone: a sample of the boundary
};

/// What the elements must satisfy (paper, section 3), and when to give up.
struct MesherOptions {
  double alpha = 1;              ///< surface Delaunay balls have radius ≤ alpha·σ(centre); > 0
  double facet_radius_edge = 1;  ///< ϱ_f: circumradius / shortest edge of boundary facets; ≥ 1 for termination
  double cell_radius_edge = 2;   ///< ϱ_t: circumradius / shortest edge of tets; ≥ 2 for termination in practice
  std::optional<double> facet_distance_mm;  ///< bound on facet circumcentre to ball centre; > 0
  std::uint64_t max_vertices = 20'000'000;  ///< refinement stops there, with Stop::limit; at 140 million anyway
  std::uint64_t seed = 0;                   ///< of the random order in which the initial sample is drawn
  Seeding seeding = Seeding::bulk;
  std::uint64_t threads = 0;  ///< 0: as many as the machine has cores; the mesh does not depend on it
};

}  // namespace scantet
