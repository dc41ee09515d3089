// The volumes that labels' fields have, counted by samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "scantet/base/frame.h"
#include "scantet/domain/facet_sizes.h"
#include "scantet/labels/label_values.h"

namespace scantet {

/// Volumes of labels in the cells where labels meet, in samples, of which a cell has kVolumeSamples.
struct VolumeCount {
  std::vector<double> excess;                         ///< by label: samples that it has more than its nodes' shares
  std::unordered_map<std::uint32_t, double> movable;  ///< by volume_key(): samples that go from one to the other label
                                                      ///< if its values fall by 1 against the other's, to first order

  explicit VolumeCount(std::size_t ranks) : excess(ranks) {}
};

inline constexpr std::size_t kVolumeSamples = 27;

/// Two ranks, the lower one in the upper half.
std::uint32_t volume_key(LabelRank a, LabelRank b);

/// What volumes are counted of.
struct CountedFields {
  const LabelNodes& nodes;
  const LabelValues& fields;         ///< all but the values; `added` has an entry for each rank
  const std::vector<float>& values;  ///< in place of those of fields
  const std::vector<bool>* held{};   ///< by the number of the node, whether its values will stay: a cell with such
                                     ///< nodes counts for less in what is movable; null: none will
};

/// The volumes that the fields have.
VolumeCount count_volumes(const CountedFields& counted);

/// The volumes that facets leave to the fields' regions. fields.bends: known. frame: of the nodes.
VolumeCount count_volumes_of_facets(const CountedFields& counted, const Frame& frame, const FacetSizes& facets);

}  // namespace scantet
