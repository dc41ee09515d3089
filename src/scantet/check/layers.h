// How many tets there are across the parts of regions.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/progress.h"
#include "scantet/base/tet_mesh.h"

namespace SCANTET_API scantet {

/// A place with too few tets across.
struct ThinPlace {
  Point place;     ///< between the two sides, world mm
  int layers = 0;  ///< edges from side to side there
};

/// What check_layers() found.
struct LayerCheck {
  std::uint64_t vertices = 0;       ///< of each region's boundary: from these, the other side was looked for
  std::uint64_t broken = 0;         ///< those that have it nearer than asked for
  std::vector<ThinPlace> places{};  ///< of these the first kMostThinPlaces, the fewest layers first
};

inline constexpr std::size_t kMostThinPlaces = 100;  ///< that are listed

/// Looks for ways of fewer than `layers` edges within a region from one side of it to the other: from a vertex of its
/// boundary inward to one where the boundary faces back, to within 45 degrees, and that lies inward to within 60. Where
/// there is none, at least `layers` tets lie between the two sides, whichever way one goes.
///
/// regions: those to look at; one that the mesh has not has no vertices. layers: ≥ 2. thinnest_mm: ways whose ends are
/// nearer to each other are not counted: they are at tips, where sides meet. Return: none if cancelled. Pre: as TetMesh
/// promises. Guarantees: does not depend on the number of threads.
std::optional<LayerCheck> check_layers(const TetMesh& mesh, const std::set<Region>& regions, int layers,
                                       double thinnest_mm, const Progress& progress);

}  // namespace scantet
