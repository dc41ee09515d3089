// What segmentations and probability maps have in common once they are fields of labels. Private to scan_input.
#pragma once

#include <map>
#include <string>

#include "scantet/labels/label_object.h"
#include "scantet/plugin/input_plugin.h"

namespace scantet {

/// What a job wants to know of the object on the grid of the scan.
OpenedDomain opened_of(LabelObject&& object, const Scan& scan);

/// Adds of each region its name, voxels, volume, connected parts and neighbours. word: "label", "tissue".
void add_regions(const RegionGrid& grid, const std::map<Region, std::string>& names, const std::string& word,
                 InfoSection& section);

}  // namespace scantet
