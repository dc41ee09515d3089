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
};

/// Asks the maps as they were read, for one that is cut or smoothed no longer tells. Values must be from 0 to 1; those
/// of 8-bit integers are taken for 255ths, or for percents if all maps are of them and nowhere come to more than 127
/// together, so that as 255ths they would leave no voxel to a tissue. Throws Error: input.grid (the maps are not on one
/// grid: says which), input.probabilities (there is no map, or a value is out of that range).
MapUnits find_map_units(std::span<const Scan> maps);

/// One map a tissue, on one grid: the n-th is region n + 1, and a point belongs to the one whose map is largest there;
/// the background's probability is what they leave of 1. Values that smoothing took out of the range count as its ends.
/// units: as find_map_units() has them, a divisor for each map. Throws Error: input.grid (as there),
/// input.probabilities (there is no map, or no voxel has a tissue). Null if progress.cancelled() became true.
std::shared_ptr<const LabelField> make_probability_field(std::span<const Scan> maps, const MapUnits& units,
                                                         const Progress& progress);

/// The same of maps as they were read. Throws Error: as both.
std::shared_ptr<const LabelField> make_probability_field(std::span<const Scan> maps, const Progress& progress);

/// The regions without a voxel, ascending: tissues that are nowhere the most likely.
std::vector<Region> regions_without_voxels(const LabelField& field);

}  // namespace scantet
