// Maps are read where they lie, row by row: no copy of them is made.
#include "scantet/labels/probability_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/base/parallel.h"
#include "scantet/labels/label_shares.h"

namespace scantet {
namespace {

/// Whether voxels are where those of the other map are, to a thousandth of the shortest step.
bool same_grid(const Scan& a, const Scan& b) {
  constexpr double kShare = 1e-3;
  if (a.size != b.size) return false;
  const double most_mm = kShare * a.frame.min_spacing_mm();
  for (int corner = 0; corner < 8; ++corner) {
    Vec index;
    for (int axis = 0; axis < 3; ++axis) {
      index[axis] = (corner >> axis & 1) == 1 ? a.size[static_cast<std::size_t>(axis)] - 1 : 0;
    }
    if (distance(a.frame.to_world(index), b.frame.to_world(index)) > most_mm) return false;
  }
  return true;
}

std::string name_of_map(std::size_t n) {
  return "the map of tissue " + std::to_string(n + 1);
}

void check_grids(std::span<const Scan> maps) {
  if (maps.empty()) {
    throw Error(Fault::input, "input.probabilities", "there is no map of a tissue", "give a map for each tissue");
  }
  for (std::size_t n = 1; n < maps.size(); ++n) {
    if (same_grid(maps.front(), maps[n])) continue;
    throw Error(Fault::input, "input.grid", name_of_map(n) + " is not on the grid of the first one",
                "resample it to that grid: voxels and their places in the world must be the same");
  }
}

void check_range(const Scan& map, double divisor, std::size_t n) {
  constexpr double kRounding = 1e-3;
  if (map.min_value >= -kRounding && map.max_value <= divisor + kRounding) return;
  throw Error(Fault::input, "input.probabilities",
              name_of_map(n) + " has values from " + number_text(map.min_value) + " to " + number_text(map.max_value) +
                  ": these are no probabilities",
              "give values from 0 to 1, or 8-bit integers from 0 to 255; of a series in time extract one volume");
}

bool are_masks(std::span<const Scan> maps) {
  return std::all_of(maps.begin(), maps.end(), [](const Scan& map) {
    return std::holds_alternative<const std::uint8_t*>(map.voxels) && map.max_value <= 1;
  });
}

/// Of maps on one grid that are no masks.
bool are_percents(std::span<const Scan> maps) {
  constexpr unsigned kMost = 127;
  std::vector<std::uint32_t> sums(static_cast<std::size_t>(maps.front().voxel_count()));
  for (const Scan& map : maps) {
    const auto* const values = std::get_if<const std::uint8_t*>(&map.voxels);
    if (values == nullptr) return false;
    for (std::size_t n = 0; n < sums.size(); ++n) sums[n] += (*values)[n];
  }
  return *std::max_element(sums.begin(), sums.end()) <= kMost;
}

/// Adds the probabilities in a row of a map.
void add_row(const Scan& map, double divisor, std::size_t row, std::vector<float>& shares) {
  std::visit(
      [&](const auto* values) {
        const auto* const first = values + row * shares.size();
        for (std::size_t i = 0; i < shares.size(); ++i) {
          shares[i] += std::clamp(static_cast<float>(first[i]) / static_cast<float>(divisor), 0.0F, 1.0F);
        }
      },
      map.voxels);
}

/// Hands on the rows of a region's maps, added up.
void hand_on(std::span<const Scan> maps, const MapUnits& units, std::span<const Region> regions, Region region,
             const ShareRow& act) {
  const std::array<int, 3>& size = maps.front().size;
  const auto rows = static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]);
  constexpr std::size_t kRows = 64;
  parallel_for(rows, kRows, [&](std::size_t begin, std::size_t end) {
    std::vector<float> shares(static_cast<std::size_t>(size[0]));
    for (std::size_t row = begin; row < end; ++row) {
      std::fill(shares.begin(), shares.end(), 0.0F);
      for (std::size_t n = 0; n < maps.size(); ++n) {
        if (regions[n] == region) add_row(maps[n], units.divisors[n], row, shares);
      }
      for (float& share : shares) share = std::min(share, 1.0F);
      act(0, static_cast<int>(row) % size[1], static_cast<int>(row) / size[1], shares);
    }
  });
}

/// The background and the regions of maps, ascending.
std::vector<Region> all_regions(std::span<const Region> of_maps) {
  std::vector<Region> regions(of_maps.begin(), of_maps.end());
  regions.push_back(kOutside);
  std::sort(regions.begin(), regions.end());
  regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
  return regions;
}

}  // namespace

MapUnits find_map_units(std::span<const Scan> maps) {
  check_grids(maps);
  MapUnits units;
  units.masks = are_masks(maps);
  units.percents = !units.masks && are_percents(maps);
  for (const Scan& map : maps) {
    const bool bytes = std::holds_alternative<const std::uint8_t*>(map.voxels);
    units.divisors.push_back(!bytes || units.masks ? 1 : units.percents ? 100 : 255);
    check_range(map, units.divisors.back(), units.divisors.size() - 1);
  }
  return units;
}

std::shared_ptr<const LabelField> make_probability_field(std::span<const Scan> maps, const Progress& progress) {
  std::vector<Region> regions(maps.size());
  std::iota(regions.begin(), regions.end(), 1);
  return make_probability_field(maps, find_map_units(maps), regions, progress);
}

std::shared_ptr<const LabelField> make_probability_field(std::span<const Scan> maps, const MapUnits& units,
                                                         std::span<const Region> of_maps, const Progress& progress) {
  assert(units.divisors.size() == maps.size() && of_maps.size() == maps.size());
  check_grids(maps);
  const std::array<int, 3>& size = maps.front().size;
  std::vector<Region> regions = all_regions(of_maps);
  const ShareSource source = [&](LabelRank rank, const ShareRow& act) {
    hand_on(maps, units, of_maps, regions[rank], act);
  };
  SharedLabels shared = share_labels(size, regions.size(), source, progress);
  if (progress.cancelled()) return nullptr;
  std::vector<std::uint64_t> voxels(regions.size());
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) ++voxels[shared.nodes.at(i, j, k)];
    }
  }
  if (std::all_of(voxels.begin() + 1, voxels.end(), [](std::uint64_t count) { return count == 0; })) {
    throw Error(Fault::input, "input.probabilities", "nowhere is a tissue more likely than the background",
                "check that the maps are probabilities of tissues");
  }
  return std::make_shared<const LabelField>(maps.front().frame, std::move(shared.nodes), std::move(regions),
                                            std::move(voxels), std::move(shared.values));
}

std::vector<Region> regions_without_voxels(const LabelField& field) {
  std::vector<Region> regions;
  for (std::size_t n = 0; n < field.regions().size(); ++n) {
    if (field.regions()[n] != kOutside && field.voxels()[n] == 0) regions.push_back(field.regions()[n]);
  }
  return regions;
}

}  // namespace scantet
