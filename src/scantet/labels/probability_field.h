// The fields of tissues that are given as probabilities.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/field/scan.h"
#include "scantet/labels/label_field.h"

namespace scantet {

/// What the values of maps mean.
struct MapUnits {
  std::vector<double> divisors;  ///< of each map what its values are divided by to be probabilities: 1, 100 or 255
  bool percents = false;         ///< whether the maps are percents
  bool masks = false;            ///< whether the maps are 8-bit masks of 0 and 1
};

/// Asks the maps as they were read, for one that is cut or smoothed no longer tells. Values must be from 0 to 1; those
/// of 8-bit integers are taken for 255ths; or if all maps are of them, for masks if none is above 1, and for percents
/// if they nowhere come to more than 127 together: as 255ths these would leave no voxel to a tissue. Throws Error:
/// input.grid (the maps are not on one grid: says which), input.probabilities (there is no map, or a value is out of
/// that range).
MapUnits find_map_units(std::span<const Scan> maps);

/// Maps on one grid. regions: of each map the region, > 0, whose probability it has; that of several maps has their
/// sum. A point belongs to the region that is most likely there; the background's probability is what they leave of 1.
/// Values that smoothing took out of the range count as its ends. units: as find_map_units() has them, a divisor for
/// each map. Throws Error: input.grid (as there), input.probabilities (there is no map, or no voxel has a tissue). Null
/// if progress.cancelled() became true.
std::shared_ptr<const LabelField> make_probability_field(std::span<const Scan> maps, const MapUnits& units,
                                                         std::span<const Region> regions, const Progress& progress);

/// The same of maps as they were read, the n-th of which is region n + 1. Throws Error: as both.
std::shared_ptr<const LabelField> make_probability_field(std::span<const Scan> maps, const Progress& progress);

/// The regions without a voxel, ascending: tissues that are nowhere the most likely.
std::vector<Region> regions_without_voxels(const LabelField& field);

}  // namespace scantet
