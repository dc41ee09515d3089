// In a grey image a value between two others comes up where they meet: the scanner blurs the step from one to the
// other, so that it passes through the value, and noise takes on all values. A value that comes up in this way has few
// neighbours like itself. In a label map each value fills a place of its own, and any two values may be neighbours,
// also two with others between them. So two shares are asked for: how many of the values fill places (most of their
// voxels have neighbours of the same value on half of their sides or more), and how many of the pairs of neighbours
// that differ leave out a value that occurs and lies between theirs. Noise fails the first test, the levels of a smooth
// field fail the second. So do labels that lie in each other like shells, in order, but their levels do make sense.
#include "scantet/field/label_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <type_traits>

namespace scantet {
namespace {

constexpr std::size_t kMostLabels = 4096;     // of a map that only its values tell
constexpr std::size_t kFewValues = 64;        // that are worth a question whether they name things
constexpr std::size_t kOfAMask = 2;           // values
constexpr double kWidestTable = 1 << 20;      // values from the smallest to the largest
constexpr double kFillingShare = 0.7;         // of the values
constexpr double kLeapingShare = 0.5;         // of the neighbours that differ
constexpr std::int64_t kSampled = 1'000'000;  // voxels whose neighbours are looked at, about

/// The voxels of each value; empty if one is not whole.
template <class Voxel>
std::vector<Label> count_labels(const Voxel* values, const Scan& scan) {
  const std::int64_t count = scan.voxel_count();
  std::vector<Label> labels;
  if constexpr (!std::is_integral_v<Voxel>) {
    if (!std::all_of(values, values + count, [](Voxel v) { return v == std::floor(v); })) return labels;
  }
  if (scan.max_value - scan.min_value < kWidestTable) {
    std::vector<std::uint64_t> table(static_cast<std::size_t>(scan.max_value - scan.min_value) + 1);
    for (std::int64_t n = 0; n < count; ++n) {
      ++table[static_cast<std::size_t>(static_cast<double>(values[n]) - scan.min_value)];
    }
    for (std::size_t n = 0; n < table.size(); ++n) {
      if (table[n] > 0) labels.push_back({scan.min_value + static_cast<double>(n), table[n]});
    }
    return labels;
  }
  if (scan.header_of_labels.empty()) return labels;  // too far apart for a table, and the header names none
  std::map<Voxel, std::uint64_t> table;
  for (std::int64_t n = 0; n < count; ++n) ++table[values[n]];
  for (const auto& [value, voxels] : table) labels.push_back({static_cast<double>(value), voxels});
  return labels;
}

/// How values sit beside each other.
struct Neighbours {
  double filling = 0;  ///< share of the values that fill places
  double leaping = 0;  ///< share of the pairs that differ and leave out a value
};

template <class Voxel>
Neighbours look_at_neighbours(const Voxel* values, const Scan& scan, const std::vector<Label>& labels) {
  std::vector<std::uint32_t> rank(static_cast<std::size_t>(scan.max_value - scan.min_value) + 1);
  for (std::size_t n = 0; n < labels.size(); ++n) {
    rank[static_cast<std::size_t>(labels[n].value - scan.min_value)] = static_cast<std::uint32_t>(n);
  }
  const auto rank_of = [&](Voxel v) { return rank[static_cast<std::size_t>(static_cast<double>(v) - scan.min_value)]; };
  struct Tally {
    std::uint64_t voxels = 0;
    std::uint64_t at_home = 0;  // with neighbours of the same value on half of the sides or more
  };
  std::vector<Tally> tallies(labels.size());
  std::uint64_t differing = 0;
  std::uint64_t leaping = 0;
  const std::array<std::int64_t, 3> step{1, scan.size[0], std::int64_t{scan.size[0]} * scan.size[1]};
  const std::int64_t rows = std::int64_t{scan.size[1]} * scan.size[2];
  const std::int64_t stride = 1 + scan.voxel_count() / kSampled;  // rows; a fixed choice, so that the answer is
  for (std::int64_t row = 0; row < rows; row += stride) {
    std::array<int, 3> at{0, static_cast<int>(row % scan.size[1]), static_cast<int>(row / scan.size[1])};
    const Voxel* v = values + row * scan.size[0];
    for (; at[0] < scan.size[0]; ++at[0], ++v) {
      int sides = 0;
      int same = 0;
      for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        if (side % 2 == 0 ? at[axis] == 0 : at[axis] + 1 == scan.size[axis]) continue;
        const Voxel other = v[side % 2 == 0 ? -step[axis] : step[axis]];
        ++sides;
        same += other == *v;
        if (other == *v) continue;
        ++differing;
        const std::int64_t apart = std::int64_t{rank_of(*v)} - rank_of(other);
        leaping += apart < -1 || apart > 1;
      }
      Tally& tally = tallies[rank_of(*v)];
      ++tally.voxels;
      tally.at_home += 2 * same >= sides;
    }
  }
  std::size_t seen = 0;
  std::size_t filling = 0;
  for (const Tally& tally : tallies) {
    seen += tally.voxels > 0;
    filling += tally.voxels > 0 && 2 * tally.at_home >= tally.voxels;
  }
  if (differing == 0) return {};
  return {static_cast<double>(filling) / static_cast<double>(seen),
          static_cast<double>(leaping) / static_cast<double>(differing)};
}

/// The values, at most kFewValues of them; more, or one that is not whole: none.
template <class Voxel>
std::vector<Voxel> few_values_of(const Voxel* values, std::int64_t count) {
  std::vector<Voxel> few;
  for (std::int64_t n = 0; n < count; ++n) {
    if (n > 0 && values[n] == values[n - 1]) continue;
    const auto place = std::lower_bound(few.begin(), few.end(), values[n]);
    if (place != few.end() && *place == values[n]) continue;
    if constexpr (!std::is_integral_v<Voxel>) {
      if (values[n] != std::floor(values[n])) return {};
    }
    if (few.size() == kFewValues) return {};
    few.insert(place, values[n]);
  }
  return few;
}

}  // namespace

std::optional<int> few_whole_values(const Scan& scan) {
  return std::visit(
      [&](const auto* values) -> std::optional<int> {
        const std::size_t count = few_values_of(values, scan.voxel_count()).size();
        if (count <= kOfAMask) return std::nullopt;
        return static_cast<int>(count);
      },
      scan.voxels);
}

std::optional<LabelMap> find_labels(const Scan& scan) {
  return std::visit(
      [&](const auto* values) -> std::optional<LabelMap> {
        std::vector<Label> labels = count_labels(values, scan);
        if (labels.size() <= kOfAMask) return std::nullopt;
        if (!scan.header_of_labels.empty()) return LabelMap{scan.header_of_labels, std::move(labels)};
        if (labels.size() > kMostLabels) return std::nullopt;
        const Neighbours beside = look_at_neighbours(values, scan, labels);
        if (beside.filling < kFillingShare || beside.leaping < kLeapingShare) return std::nullopt;
        return LabelMap{"its " + std::to_string(labels.size()) +
                            " values are whole numbers that fill places of their own, and meet without those between",
                        std::move(labels)};
      },
      scan.voxels);
}

}  // namespace scantet
