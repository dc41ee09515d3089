// Leaves components out of the object in a scan, islands of noise, say, and fills cavities.
#pragma once

#include <cstdint>
#include <optional>

#include "scantet/image/masked_level_set.h"
#include "scantet/image/nested_level_sets.h"

namespace scantet {

/// Which components are kept: those that satisfy both bounds; and which cavities. If there are several levels, the
/// inside of each has components and cavities of its own, and the choice holds for each level. Their volume is
/// Component::volume_mm3, a count of voxels.
struct ComponentChoice {
  std::optional<std::uint64_t> count;  ///< so many, the largest, ≥ 1; of equals those that LevelTopology lists first
  double min_volume_mm3 = 0;           ///< those of at least this volume
  double fill_cavities_mm3 = 0;        ///< cavities of less than this volume become inside

  /// Whether components may be left out.
  bool drops() const { return count || min_volume_mm3 > 0; }
};

/// Cavities that became inside, of all levels.
struct FilledCavities {
  std::size_t count = 0;
  double volume_mm3 = 0;   ///< of all together
  double largest_mm3 = 0;  ///< volume of the largest
};

/// A scan as its levels see it, and what is left out.
struct KeptComponents {
  std::vector<MaskedScan> levels;  ///< outermost first; empty if cancelled
  DroppedComponents dropped;
  FilledCavities filled;
};

/// Leaves out, level by level from the outermost in, the components of the inside that the choice does not keep. What
/// further levels have in such a component goes with it, and is not listed. If there are several levels, an island of
/// region n that is left out becomes part of region n - 1 around it. Then fills the cavities that the choice does not
/// keep, with all that is in them: those of the inside of level n become part of region n. Throws Error: as
/// make_nested_level_sets(); input.components (nothing is left within one of the levels). Guarantees: a component that
/// is kept is one component afterwards, and there is no other, but that islands in a cavity that is filled are part of
/// what is around it; the scan's voxels are not touched. Costs a sweep as of make_level_set() for each level, another
/// where cavities are to be filled and something was left out, and two copies of the voxels for each level that changes
/// something.
KeptComponents keep_components(const Scan& scan, const NestedLevelSettings& settings, const ComponentChoice& choice,
                               const Progress& progress = Progress());

/// Cavities in what is kept, of any level, and the least volume among them, mm³.
struct SmallCavities {
  std::size_t count = 0;
  double least_mm3 = 0;
};

struct KeptLevelSets {
  std::unique_ptr<Domain> domain;  ///< null if progress.cancelled() became true
  SmallCavities cavities;
};

/// Does what make_nested_level_sets() does with the same settings, but for the components that are kept alone: the
/// boundary is that of the scan as it was read. cavities: those of less than cavity_mm3 that stay. Throws Error: as
/// make_nested_level_sets().
KeptLevelSets make_kept_level_sets(const Scan& scan, const NestedLevelSettings& settings, const KeptComponents& kept,
                                   double cavity_mm3, const Progress& progress = Progress());

}  // namespace scantet
