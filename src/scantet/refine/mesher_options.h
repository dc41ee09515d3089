// What the mesher is asked for.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/rule_bounds.h"

namespace SCANTET_API scantet {

/// How the triangulation starts.
enum class Seeding {
  bulk,  ///< a sample of the boundary and a lattice inside, inserted at once (docs/algorithm.md)
  paper  ///< the paper's P_i alone: a sample of the boundary
};

/// What the elements must satisfy, how to start, and when to give up.
struct MesherOptions {
  RuleBounds bounds;
  std::uint64_t max_vertices = 20'000'000;  ///< refinement ends there, with Stop::limit; at 140 million anyway
  std::uint64_t seed = 0;                   ///< of the random order in which the initial sample is drawn
  Seeding seeding = Seeding::bulk;
  /// Points for each boundary vertex, ≥ 0: where keeping the domain's handles would take more, and more than 1,000, the
  /// size is too coarse for them, and they are left out (MeshResult::handles_left_out).
  double most_at_handles = 0.065;
  /// How often points are put on narrow ways of the domain that the mesh breaks, at the most; ≥ 0.
  int handle_rounds = 30;
  /// And how often again, as often at nodes on the wrong side, after the boundary was untangled, which breaks others;
  /// 0 to 4.
  int handle_rounds_untangled = 0;
  /// Whether, where keeping them would take more than most_at_handles, handles are kept without narrow ways if no more
  /// than 20 are wrong.
  bool keeps_few_handles = false;
  /// Whether to look for handles that the domain has not also where Euler numbers are right, as others may be lost.
  bool seeks_exchanged_handles = false;
  /// Whether narrow ways lead on across ground of the domain that is level.
  LevelGround level_ground = LevelGround::ends_ways;
  /// Segments that must each lie in tets of their region, beside the domain's own narrow ways. They should lie in that
  /// region of the domain.
  std::vector<NarrowWay> ways{};
  std::uint64_t threads = 0;  ///< 0: as many as the machine has cores; 256 at most; the mesh does not depend on it
};

}  // namespace scantet
