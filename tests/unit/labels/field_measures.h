// What tests measure of a field of labels.
#pragma once

#include <algorithm>
#include <limits>
#include <map>

#include "scantet/labels/label_field.h"

namespace scantet::test {

/// The volume of each region in voxels, by so many samples a cell along each axis: many, for surfaces that lie along
/// the grid meet all samples of a layer at once.
inline std::map<Region, double> volumes(const LabelField& field, int samples) {
  std::map<Region, double> all;
  LabelCell cell;
  for (int k = -1; k < field.size()[2]; ++k) {
    for (int j = -1; j < field.size()[1]; ++j) {
      for (int i = -1; i < field.size()[0]; ++i) {
        if (!field.is_mixed(i, j, k)) {
          all[field.region_of_node(i, j, k)] += 1;
          continue;
        }
        field.cell(i, j, k, cell);
        for (int n = 0; n < samples * samples * samples; ++n) {
          const Vec u{(n % samples + 0.5) / samples, (n / samples % samples + 0.5) / samples,
                      (n / samples / samples + 0.5) / samples};
          all[cell.region_at(u)] += 1.0 / (samples * samples * samples);
        }
      }
    }
  }
  return all;
}

/// The volume's error in parts of the voxels'.
inline double volume_error(const LabelField& field, Region region, int samples = 5) {
  for (std::size_t n = 0; n < field.regions().size(); ++n) {
    if (field.regions()[n] == region) {
      const auto voxels = static_cast<double>(field.voxels()[n]);
      return volumes(field, samples).at(region) / voxels - 1;
    }
  }
  return 1;
}

/// By how much each node's own label wins there at least.
inline double least_margin(const LabelField& field) {
  double least = std::numeric_limits<double>::infinity();
  LabelCell cell;
  for (int k = -1; k < field.size()[2]; ++k) {
    for (int j = -1; j < field.size()[1]; ++j) {
      for (int i = -1; i < field.size()[0]; ++i) {
        field.cell(i, j, k, cell);
        for (std::size_t c = 0; c < 8; ++c) {
          const int corner = static_cast<int>(c);
          const Region own = field.region_of_node(i + corner % 2, j + corner / 2 % 2, k + corner / 4);
          const auto at = static_cast<std::size_t>(
              std::find(cell.regions.begin(), cell.regions.begin() + cell.count, own) - cell.regions.begin());
          for (std::size_t n = 0; n < cell.count; ++n) {
            if (n != at) least = std::min(least, cell.values[at][c] - cell.values[n][c]);
          }
        }
      }
    }
  }
  return least;
}

}  // namespace scantet::test
