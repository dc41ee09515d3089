// 3D Slicer keeps segments that do not overlap in one layer, and opens another for one that does. Its keys are lines of
// the NRRD header, which ends at an empty line. When it merges segments itself, the later one overwrites the earlier.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <type_traits>

#include "scantet/field/scan_from_memory.h"
#include "scantet/reading/segment_layers_impl.h"

namespace scantet {
namespace {

constexpr std::int64_t kLargestLabel = std::numeric_limits<std::int32_t>::max();

[[noreturn]] void refuse(const std::string& path, const std::string& fault, const std::string& remedy) {
  throw Error(Fault::input, "input.labels", "'" + path + "': " + fault, remedy);
}

/// Keys and values of one segment.
using Keys = std::map<std::string, std::string>;

/// By the number of the segment.
std::map<int, Keys> keys_of_segments(const std::string& path) {
  constexpr std::size_t kLongestHeader = 1 << 22;
  constexpr std::size_t kPrefix = 7;  // "Segment"
  std::map<int, Keys> segments;
  std::istringstream lines(first_bytes(path, kLongestHeader));
  std::string line;
  for (bool first = true; std::getline(lines, line); first = false) {
    line.erase(line.find_last_not_of('\r') + 1);
    if (line.empty() || (first && line.rfind("NRRD", 0) != 0)) break;
    const std::size_t sign = line.find(":=");
    const std::size_t part = line.find('_');
    if (line.rfind("Segment", 0) != 0 || sign == std::string::npos || part == std::string::npos || part > sign) {
      continue;
    }
    int number = 0;
    const auto [stop, code] = std::from_chars(line.data() + kPrefix, line.data() + part, number);
    if (code != std::errc{} || stop != line.data() + part || number < 0) continue;
    segments[number][line.substr(part + 1, sign - part - 1)] = line.substr(sign + 2);
  }
  return segments;
}

/// The colour of three numbers from 0 to 1.
std::optional<Color> color_of_shares(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  std::array<double, 3> shares{};
  for (double& share : shares) {
    if (!(stream >> share) || !(share >= 0 && share <= 1)) return std::nullopt;
  }
  const auto part = [](double share) { return static_cast<std::uint8_t>(std::lround(255 * share)); };
  return Color{part(shares[0]), part(shares[1]), part(shares[2])};
}

/// A whole number from `least` to `most` behind a key of a segment; `otherwise` if there is none.
std::int64_t number_of(const std::string& path, int segment, const Keys& keys, const std::string& key,
                       std::int64_t otherwise, std::int64_t least, std::int64_t most) {
  const auto found = keys.find(key);
  if (found == keys.end()) return otherwise;
  const std::string& text = found->second;
  std::int64_t number = 0;
  const auto [stop, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code == std::errc{} && stop == text.data() + text.size() && number >= least && number <= most) return number;
  constexpr std::size_t kLongest = 40;
  refuse(path,
         "Segment" + std::to_string(segment) + "_" + key + " is '" + text.substr(0, kLongest) +
             "', no whole number from " + std::to_string(least) + " to " + std::to_string(most),
         "save the segmentation again, or correct its header");
}

/// What a value in each layer stands for: the place of its segment in the list, from 1 on.
using Places = std::vector<std::map<std::int64_t, std::uint32_t>>;

/// Voxels by the place of their segment in the list, 0 being that of none.
struct VoxelCounts {
  std::vector<std::uint64_t> before;  ///< in the layers
  std::vector<std::uint64_t> after;   ///< in the label map
  std::uint64_t overlapping = 0;      ///< in several segments
};

template <class Label, class Voxel>
std::vector<Label> merged(const Voxel* values, std::size_t count, std::size_t layers, bool interleaved,
                          const Places& places, const std::vector<Label>& label_of, VoxelCounts& counts,
                          const std::string& path) {
  std::vector<Label> labels(count);
  for (std::size_t n = 0; n < count; ++n) {
    std::uint32_t last = 0;
    int segments = 0;
    for (std::size_t layer = 0; layer < layers; ++layer) {
      const Voxel value = interleaved ? values[n * layers + layer] : values[layer * count + n];
      if (value == 0) continue;
      const auto place = places[layer].find(static_cast<std::int64_t>(value));
      if (place == places[layer].end()) {
        refuse(path,
               "layer " + std::to_string(layer) + " has voxels of the value " + std::to_string(value) +
                   ", and the header names no such segment there",
               "save the segmentation again, or correct its header");
      }
      last = std::max(last, place->second);
      ++counts.before[place->second];
      ++segments;
    }
    counts.overlapping += segments > 1 ? 1 : 0;
    ++counts.after[last];
    labels[n] = label_of[last];
  }
  return labels;
}

template <class Label>
Scan scan_of(std::vector<Label> labels, const std::array<int, 3>& size, const Frame& frame, const std::string& path,
             bool may_be_constant) {
  const auto kept = std::make_shared<const std::vector<Label>>(std::move(labels));
  Scan scan;
  scan.size = size;
  scan.frame = frame;
  scan.voxels = kept->data();
  scan.owner = kept;
  look_at_voxels(scan, "'" + path + "'", may_be_constant);
  return scan;
}

}  // namespace

std::vector<HeaderSegment> segments_of_slicer(const std::string& path, std::int64_t layers) {
  const std::map<int, Keys> found = keys_of_segments(path);
  const bool in_layers =
      std::any_of(found.begin(), found.end(), [](auto& one) { return one.second.contains("Layer"); });
  std::vector<HeaderSegment> segments;
  for (const auto& [number, keys] : found) {
    if (!keys.contains("ID") && !keys.contains("LabelValue")) continue;
    HeaderSegment named;
    named.segment.label = number_of(path, number, keys, "LabelValue", 1, 1, kLargestLabel);
    const auto own_layer = in_layers || layers == 1 ? 0 : static_cast<std::int64_t>(segments.size());
    named.layer = number_of(path, number, keys, "Layer", std::min(own_layer, layers - 1), 0, layers - 1);
    if (const auto name = keys.find("Name"); name != keys.end()) named.segment.name = name->second;
    if (const auto color = keys.find("Color"); color != keys.end()) {
      named.segment.color = color_of_shares(color->second);
    }
    segments.push_back(std::move(named));
  }
  return segments;
}

Scan merge_layers(const VoxelPointer& voxels, const std::array<int, 3>& size, const Frame& frame,
                  const std::vector<HeaderSegment>& segments, std::int64_t layers, bool interleaved,
                  const std::string& path, bool may_be_constant) {
  Places places(static_cast<std::size_t>(layers));
  std::vector<ScanSegment> named;
  std::vector<std::int64_t> values;
  for (const HeaderSegment& one : segments) {
    named.push_back(one.segment);
    values.push_back(one.segment.label);
    places[static_cast<std::size_t>(one.layer)][one.segment.label] = static_cast<std::uint32_t>(named.size());
  }
  std::sort(values.begin(), values.end());
  const bool distinct = std::adjacent_find(values.begin(), values.end()) == values.end();
  std::vector<std::int32_t> label_of{0};
  for (ScanSegment& segment : named) {
    if (!distinct) segment.label = static_cast<std::int64_t>(label_of.size());
    label_of.push_back(static_cast<std::int32_t>(segment.label));
  }
  VoxelCounts counts{std::vector<std::uint64_t>(label_of.size()), std::vector<std::uint64_t>(label_of.size())};
  const auto count =
      static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]);
  Scan scan = std::visit(
      [&]<class Voxel>(const Voxel* all) -> Scan {
        if constexpr (std::is_integral_v<Voxel>) {
          const auto merge = [&](const auto& labels) {
            return scan_of(
                merged(all, count, static_cast<std::size_t>(layers), interleaved, places, labels, counts, path), size,
                frame, path, may_be_constant);
          };
          constexpr std::int32_t kShort = std::numeric_limits<std::uint16_t>::max();
          if (*std::max_element(label_of.begin(), label_of.end()) > kShort) return merge(label_of);
          return merge(std::vector<std::uint16_t>(label_of.begin(), label_of.end()));
        }
        refuse(path, "its layers are no whole numbers", "save the segmentation again");
      },
      voxels);
  for (std::size_t n = 0; n < named.size(); ++n) {
    named[n].voxels = counts.before[n + 1];
    named[n].covered = counts.before[n + 1] - counts.after[n + 1];
  }
  scan.segments = std::move(named);
  scan.overlapping = counts.overlapping;
  return scan;
}

void check_labels(const Scan& scan, const std::string& path) {
  std::set<double> known{0};
  for (const ScanSegment& segment : scan.segments) known.insert(static_cast<double>(segment.label));
  std::visit(
      [&](const auto* voxels) {
        double last = 0;
        for (std::int64_t n = 0; n < scan.voxel_count(); ++n) {
          const auto value = static_cast<double>(voxels[n]);  // labels are exact, and other values become none
          if (value == last) continue;
          if (!known.contains(value)) {
            std::ostringstream text;
            text << std::setprecision(std::numeric_limits<double>::max_digits10) << value;
            refuse(path, "it has voxels of the value " + text.str() + ", and the header names no such segment",
                   "save the segmentation again, or correct its header");
          }
          last = value;
        }
      },
      scan.voxels);
}

}  // namespace scantet
