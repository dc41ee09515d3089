// Images whose values name things: no level lies between them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scantet/field/scan.h"

namespace scantet {

/// A value and how many voxels have it.
struct Label {
  double value = 0;
  std::uint64_t voxels = 0;
};

/// What an image holds that is a label map.
struct LabelMap {
  std::string reason;         ///< why it is one, as the end of "… is a label map: "
  std::vector<Label> labels;  ///< every value of the image, ascending
};

/// Whether the scan is a label map. It is one if its header says so (Scan::header_of_labels), or if its values are few,
/// whole, and without gradual transitions. nullopt: it is none, or that cannot be told. A scan of no more than two
/// values (a mask) is never one, whatever its header says. Looks at every voxel once, and at the neighbours of about a
/// million.
std::optional<LabelMap> find_labels(const Scan& scan);

/// How many values the scan has, if they are whole and from 3 to 64: numbers that may name things, which only who made
/// them knows. nullopt: they are more, or fewer as in a mask, or one is not whole.
std::optional<int> few_whole_values(const Scan& scan);

}  // namespace scantet
