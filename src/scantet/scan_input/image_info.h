// What there is to know about a scan, as sections for `scantet info`.
#pragma once

#include <vector>

#include "scantet/field/scan_statistics.h"
#include "scantet/field/values_at_level.h"
#include "scantet/image/kept_components.h"
#include "scantet/image/nested_level_sets.h"
#include "scantet/plugin/input_plugin.h"

namespace scantet {

/// Grid, orientation, pixel type, values, suggested level.
std::vector<InfoSection> describe_scan(const Scan& scan, const ScanStatistics& statistics, double suggested_level);

/// The grid alone, of images whose values are no grey levels.
InfoSection describe_grid(const Scan& scan);

/// For each level, which faces of the image the inside reaches there, and what else there is. settings.levels: from the
/// outermost in. at: of each. given: the user chose the levels.
std::vector<InfoSection> describe_levels(const Scan& scan, const NestedLevelSettings& settings,
                                         const std::vector<ValuesAtLevel>& at, bool given);

/// Counts and volumes of the components of each of the regions 1 to `regions`, and of the cavities.
std::vector<InfoSection> describe_regions(const Domain& domain, std::size_t regions);

/// What was left out as asked for, of each of the regions 1 to `regions` if there are several.
InfoSection describe_dropped(const DroppedComponents& dropped, std::size_t regions);

/// How many cavities were filled as asked for.
InfoSection describe_filled(const FilledCavities& filled);

/// How many cavities below --min-component stay, and the smallest of them.
void add_cavities(const SmallCavities& cavities, InfoSection& dropped);

}  // namespace scantet
