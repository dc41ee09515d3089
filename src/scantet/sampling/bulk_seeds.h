// The points inside that refinement starts from.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/delaunay/seed_lattice.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"

namespace scantet {

struct BulkSeedOptions {
  double alpha = 1;                       ///< of the mesher: surface balls may have radius alpha·σ
  std::uint64_t max_points = 20'000'000;  ///< about: once there are so many, no more are begun
};

/// The lattice of the seeds where σ has its usual value.
SeedLattice seed_lattice(const Domain& domain, const SizingField& size);

/// Points inside the domain that leave little to rule R3: a body-centred cubic lattice whose tets have circumradius σ,
/// in steps where σ varies, with the points near the boundary moved to one depth under it.
///
/// boundary_sample: of the boundary, alpha·σ dense (initial_sample). Guarantees: a seed is at most max(1, alpha)·σ(q)
/// away from the lattice point q that it comes from; it is at least 0.54·σ(q) from the other seeds (0.65·σ(q) where σ
/// is constant) and 0.8·max(1, alpha)·σ(q) from the boundary sample; region_at is not kOutside there. The seeds are a
/// function of the arguments alone, whatever the number of threads. If cancelled: the seeds so far.
std::vector<Point> bulk_seeds(const Domain& domain, const SizingField& size, const std::vector<Point>& boundary_sample,
                              const BulkSeedOptions& options, Progress& progress);

}  // namespace scantet
