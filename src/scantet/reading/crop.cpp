// The voxels are copied row by row: the rest of the scan need not stay in memory.
#include "scantet/reading/crop.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/field/scan_from_memory.h"

namespace scantet {
namespace {

constexpr double kRounding = 1e-6;  // voxels: by so much a centre may be off a wall that it is meant to be on
constexpr int kDigits = 6;

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// A bound as typed: `free` if nothing is; nullopt if that is no number.
std::optional<double> bound_in(const std::string& text, double free) {
  if (text.empty()) return free;
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  return code == std::errc{} && stop == end && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

const char* unit_name(CropBox::Unit unit) {
  return unit == CropBox::Unit::mm ? "mm" : "voxels";
}

[[noreturn]] void refuse(const std::string& what, const std::string& remedy) {
  throw Error(Fault::usage, "usage.crop", what, remedy);
}

void check_ranges(const std::string& place, const CropBox& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (box.low[axis] <= box.high[axis]) continue;
    refuse(place + ": the range along " + "xyz"[axis] + " runs from " + number_text(box.low[axis], kDigits) + " to " +
               number_text(box.high[axis], kDigits) + " " + unit_name(box.unit) + ": backwards",
           "give the smaller bound first");
  }
}

/// The box that the voxel centres span, in the unit.
Box extent_of(const Scan& scan, CropBox::Unit unit) {
  const Vec last{scan.size[0] - 1.0, scan.size[1] - 1.0, scan.size[2] - 1.0};
  return unit == CropBox::Unit::mm ? scan.frame.world_box({0, 0, 0}, last) : Box{{0, 0, 0}, last};
}

[[noreturn]] void refuse_block(const Scan& scan, CropBox::Unit unit) {
  const Box image = extent_of(scan, unit);
  std::string extent;
  for (int n = 0; n < 3; ++n) {
    extent += (n == 0 ? "" : ",") + number_text(image.min[n], kDigits) + ":" + number_text(image.max[n], kDigits);
  }
  refuse(std::string(unit == CropBox::Unit::mm ? "--crop" : "--crop-voxels") +
             ": along an axis of the image the box holds fewer than two voxels",
         "the image's are within " + extent + " " + unit_name(unit));
}

/// The box in voxels, and within the image.
Box in_voxels(const Scan& scan, const CropBox& box) {
  Box within = extent_of(scan, box.unit);
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::size_t>(axis);
    within.min[axis] = std::max(box.low[n], within.min[axis]);
    within.max[axis] = std::min(box.high[n], within.max[axis]);
    if (!(within.min[axis] <= within.max[axis])) refuse_block(scan, box.unit);
  }
  if (box.unit == CropBox::Unit::voxels) return within;
  return scan.frame.index_box(within);
}

/// The voxels of a block of so many from the one at `low` on.
template <class Voxel>
std::vector<Voxel> block_of(const Scan& scan, const Voxel* voxels, const std::array<int, 3>& low,
                            const std::array<int, 3>& size) {
  std::vector<Voxel> block;
  block.reserve(static_cast<std::size_t>(size[0]) * size[1] * size[2]);
  for (int k = low[2]; k < low[2] + size[2]; ++k) {
    for (int j = low[1]; j < low[1] + size[1]; ++j) {
      const Voxel* row = voxels + (std::int64_t{k} * scan.size[1] + j) * scan.size[0] + low[0];
      block.insert(block.end(), row, row + size[0]);
    }
  }
  return block;
}

}  // namespace

CropBox read_crop(const std::string& place, const std::string& text, CropBox::Unit unit) {
  CropBox box;
  box.unit = unit;
  const std::vector<std::string> ranges = parts_of(text, ',');
  bool is_box = ranges.size() == 3;
  for (std::size_t axis = 0; axis < 3 && is_box; ++axis) {
    const std::vector<std::string> bounds = parts_of(ranges[axis], ':');
    is_box = bounds.size() == 2;
    if (!is_box) break;
    const auto low = bound_in(bounds[0], -CropBox::kFree);
    const auto high = bound_in(bounds[1], CropBox::kFree);
    is_box = low && high;
    if (is_box) {
      box.low[axis] = *low;
      box.high[axis] = *high;
    }
  }
  if (!is_box) {
    refuse(place + ": \"" + text + "\" is not a box",
           std::string("give a range along each axis, ") +
               (unit == CropBox::Unit::mm ? "-40:40,-60:20,0:80" : "10:90,20:120,0:40") +
               "; a bound that is left out is that of the image: :,:,20:");
  }
  check_ranges(place, box);
  return box;
}

Scan cropped(const Scan& scan, const CropBox& box) {
  check_ranges(box.unit == CropBox::Unit::mm ? "--crop" : "--crop-voxels", box);
  const Box index = in_voxels(scan, box);
  std::array<int, 3> low{};
  std::array<int, 3> size{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::size_t>(axis);
    low[n] = std::max(0, static_cast<int>(std::ceil(index.min[axis] - kRounding)));
    size[n] = std::min(scan.size[n] - 1, static_cast<int>(std::floor(index.max[axis] + kRounding))) - low[n] + 1;
    if (size[n] < 2) refuse_block(scan, box.unit);
  }
  if (size == scan.size) return scan;
  const Frame frame({scan.frame.column(0), scan.frame.column(1), scan.frame.column(2)},
                    scan.frame.to_world({double(low[0]), double(low[1]), double(low[2])}));
  Scan result = std::visit(
      [&](const auto* voxels) { return make_scan(block_of(scan, voxels, low, size), size, frame); }, scan.voxels);
  result.format = scan.format;
  result.header_of_labels = scan.header_of_labels;
  result.segments = scan.segments;
  result.overlapping = scan.overlapping;
  return result;
}

}  // namespace scantet
