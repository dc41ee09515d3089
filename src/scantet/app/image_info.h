// What there is to know about a scan, as sections for `scantet info`.
#pragma once

#include <vector>

#include "scantet/domain/input_plugin.h"
#include "scantet/image/level_set.h"
#include "scantet/image/scan_statistics.h"

namespace scantet {

/// Grid, orientation, pixel type, values, suggested level.
std::vector<InfoSection> describe_scan(const Scan& scan, const ScanStatistics& statistics, double suggested_level);

/// The level looked at and which faces of the image the inside reaches there. given: the user chose the level.
InfoSection describe_border(const Scan& scan, const LevelSetSettings& settings, bool given);

/// Counts and volumes of the components and cavities of a level set.
InfoSection describe_components(const Domain& domain);

}  // namespace scantet
