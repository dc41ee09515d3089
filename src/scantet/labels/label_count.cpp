// Voxels come in runs of one label, so a run is counted at a time: a table, or for labels far apart a map, is asked
// once a run.
#include "scantet/labels/label_count.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <type_traits>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/base/stratum.h"

namespace scantet {
namespace {

constexpr double kWidestTable = 1 << 20;    // from the least label to the greatest
constexpr std::size_t kMostLabels = 65535;  // so that 16 bits number them and the background

void check_range(const Scan& scan) {
  if (scan.min_value < 0) {
    throw Error(Fault::input, "input.labels", "the label " + number_text(scan.min_value) + " is negative",
                "labels are whole numbers from 0, the background, to 2147483647");
  }
  if (scan.max_value > std::numeric_limits<Region>::max()) {
    throw Error(Fault::input, "input.labels", "the label " + number_text(scan.max_value) + " is too large",
                "labels are whole numbers from 0, the background, to 2147483647");
  }
}

template <class Voxel>
void check_whole(const Voxel* values, std::int64_t count) {
  if constexpr (!std::is_integral_v<Voxel>) {
    for (std::int64_t n = 0; n < count; ++n) {
      if (values[n] == std::floor(values[n])) continue;
      throw Error(Fault::input, "input.labels", "the value " + number_text(values[n]) + " is no label",
                  "labels are whole numbers from 0, the background, to 2147483647");
    }
  }
}

template <class Voxel, class Add>
void for_each_run(const Voxel* values, std::int64_t count, const Add& add) {
  for (std::int64_t begin = 0; begin < count;) {
    std::int64_t end = begin + 1;
    while (end < count && values[end] == values[begin]) ++end;
    add(static_cast<std::int64_t>(values[begin]), static_cast<std::uint64_t>(end - begin));
    begin = end;
  }
}

}  // namespace

std::vector<LabelCount> count_labels(const Scan& scan) {
  check_range(scan);
  std::vector<LabelCount> labels;
  std::visit(
      [&](const auto* values) {
        const std::int64_t count = scan.voxel_count();
        check_whole(values, count);
        const auto least = static_cast<std::int64_t>(scan.min_value);
        if (scan.max_value - scan.min_value < kWidestTable) {
          std::vector<std::uint64_t> table(static_cast<std::size_t>(scan.max_value - scan.min_value) + 1);
          for_each_run(values, count, [&](std::int64_t label, std::uint64_t voxels) {
            table[static_cast<std::size_t>(label - least)] += voxels;
          });
          for (std::size_t n = 0; n < table.size(); ++n) {
            if (table[n] > 0) labels.push_back({least + static_cast<std::int64_t>(n), table[n]});
          }
          return;
        }
        std::map<std::int64_t, std::uint64_t> table;
        for_each_run(values, count, [&](std::int64_t label, std::uint64_t voxels) { table[label] += voxels; });
        for (const auto& [label, voxels] : table) labels.push_back({label, voxels});
      },
      scan.voxels);
  if (labels.size() > kMostLabels) {
    throw Error(Fault::input, "input.labels", "the image holds " + std::to_string(labels.size()) + " labels",
                "at most 65535 can be meshed");
  }
  return labels;
}

std::vector<std::int64_t> labels_of(const std::vector<LabelCount>& counts) {
  std::vector<std::int64_t> labels(counts.size());
  std::transform(counts.begin(), counts.end(), labels.begin(), [](const LabelCount& count) { return count.label; });
  return labels;
}

}  // namespace scantet
