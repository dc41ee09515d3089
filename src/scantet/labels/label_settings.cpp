#include "scantet/labels/label_settings.h"

#include <algorithm>
#include <limits>
#include <string>

#include "scantet/base/error.h"

namespace scantet {
namespace {

void check_regions(const LabelSettings& settings) {
  for (const auto& [label, region] : settings.region_of) {
    if (region >= kOutside) continue;
    throw Error(Fault::usage, "usage.labels",
                "the label " + std::to_string(label) + " is to become the region " + std::to_string(region) +
                    ", which is below 0",
                "regions are greater than 0; 0 is the background");
  }
}

}  // namespace

std::vector<Region> regions_of_labels(const std::vector<std::int64_t>& labels, const LabelSettings& settings) {
  check_regions(settings);
  std::vector<Region> regions;
  Region largest = kOutside;
  for (const std::int64_t label : labels) {
    const auto given = settings.region_of.find(label);
    Region region = kOutside;
    if (given != settings.region_of.end()) {
      region = given->second;
    } else if (label != settings.background && settings.keep_others) {
      region = static_cast<Region>(label);
    }
    regions.push_back(region);
    largest = std::max(largest, region);
  }
  const bool zero_is_kept = settings.background != 0 && settings.keep_others && settings.region_of.count(0) == 0;
  if (!labels.empty() && labels.front() == 0 && zero_is_kept) {
    if (largest == std::numeric_limits<Region>::max()) {
      throw Error(Fault::input, "input.labels", "the label 0 finds no number for its region",
                  "say which region it becomes");
    }
    regions.front() = largest + 1;
  }
  return regions;
}

}  // namespace scantet
