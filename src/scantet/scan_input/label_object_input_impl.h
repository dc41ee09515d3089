// What segmentations and probability maps have in common once they are fields of labels. Private to scan_input.
#pragma once

#include <map>
#include <string>

#include "scantet/labels/label_choice.h"
#include "scantet/labels/label_object.h"
#include "scantet/plugin/input_plugin.h"
#include "scantet/scan_input/label_input.h"

namespace scantet {

/// What a job wants to know of the object on the grid of the scan.
OpenedDomain opened_of(LabelObject&& object, const Scan& scan);

/// What --labels, --background and --label-names mean for these labels or tissues. known: names and colours that come
/// with them, which those of --label-names overrule. Throws Error: as read_label_choice(), read_label_table() and
/// settings_of().
LabelSettings chosen_labels(const LabelOptions& options, LabelTable known, const std::vector<LabelCount>& labels);

/// That so many, at least one, are background as they were not chosen. word: "label", "tissue".
std::string note_on_dropped(std::size_t count, const std::string& word);

/// Adds of each region its name, voxels, volume, connected parts and neighbours. word: "label", "tissue".
void add_regions(const RegionGrid& grid, const std::map<Region, std::string>& names, const std::string& word,
                 InfoSection& section);

}  // namespace scantet
