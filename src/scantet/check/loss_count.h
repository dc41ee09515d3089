// How much of the topology of its domain a mesh has lost.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/domain/domain.h"

namespace SCANTET_API scantet {

/// What a mesh has lost of a domain that was made from a grid of regions.
struct RegionLosses {
  std::vector<Point> places;  ///< world mm
  std::vector<NarrowWay>
      ways;  ///< a mesh with these in tets of their regions has what it breaks now: RegionLedger::broken
};

/// What audit() would find of the topology of a mesh. Of a domain that does not know its components, pinches alone.
struct LossCount {
  /// Components, cavities and handles of the domain that the mesh has not, or has too many, and edges and vertices of
  /// its boundary that are pinched.
  std::uint64_t count = 0;
  std::int64_t missing_euler = 0;  ///< of boundaries that could be compared: the domain's Euler number less the mesh's
  /// Of those that have one: a place, world mm, for each cavity that the mesh has not, or has too many, and for each
  /// component or cavity of a few sizes that has not the handles of the domain's.
  std::vector<Point> small_parts{};
  /// Places half a size apart all over the boxes of those of a few sizes: the handle may be anywhere in one.
  std::vector<Point> in_small_parts{};
  /// A place, world mm, for each gap in what follows a curve of the domain; not counted above.
  std::vector<Point> curve_gaps{};
};

}  // namespace scantet
