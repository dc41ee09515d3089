#include "scantet/labels/label_settings.h"

#include <algorithm>
#include <limits>

#include "scantet/base/error.h"

namespace scantet {

std::vector<Region> regions_of_labels(const std::vector<std::int64_t>& labels, const LabelSettings& settings) {
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
