// Which labels a segmentation holds.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/field/scan.h"

namespace scantet {

/// A label and how many voxels have it.
struct LabelCount {
  std::int64_t label = 0;
  std::uint64_t voxels = 0;
};

/// Every label of the scan, ascending. Throws Error (input.labels): a value is negative, no whole number, or above
/// 2³¹ - 1; there are more than 65,535 labels.
std::vector<LabelCount> count_labels(const Scan& scan);

/// The labels without the counts, in the same order.
std::vector<std::int64_t> labels_of(const std::vector<LabelCount>& counts);

}  // namespace scantet
