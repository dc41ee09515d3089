// Leaves components out of the object in a scan: islands of noise, say.
#pragma once

#include <cstdint>
#include <optional>

#include "scantet/image/nested_level_sets.h"

namespace scantet {

/// Which components are kept: those that both bounds let pass. A component is one of the inside of the outermost level,
/// with what further levels have in it; its volume is Component::volume_mm3, a count of voxels.
struct ComponentChoice {
  std::optional<std::uint64_t> count;  ///< the largest so many, ≥ 1; of equals those that LevelTopology lists first
  double min_volume_mm3 = 0;           ///< those of at least this
};

/// A scan that holds what is kept.
struct KeptComponents {
  Scan scan;  ///< the scan given, or, if anything is dropped, a copy of its own
  DroppedComponents dropped;
};

/// Turns the voxels of the components that are not kept to a value just outside of the outermost level, so that the
/// level sets of the scan returned are those of the scan given without them.
/// Throws Error: as make_nested_level_sets(); input.components (nothing is left, or nothing within one of the levels).
/// Guarantees: a component that is kept is one component afterwards, no other is there, and voxels in none of those
/// dropped have the values they had. In a cell that a kept and a dropped component share the kept one recedes a little;
/// where the four corners of one cell that share no edge were all inside, a wall thinner than a voxel may open.
/// Nothing is dropped if progress.cancelled() became true. Costs one sweep as of make_level_set(), and one copy of the
/// voxels if anything is dropped.
KeptComponents keep_components(const Scan& scan, const NestedLevelSettings& settings, const ComponentChoice& choice,
                               const Progress& progress = Progress());

}  // namespace scantet
