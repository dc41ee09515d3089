// Every voxel is looked at once. That all are finite is seen in the same pass as their range; only where one is not,
// another pass counts them.
#include "scantet/field/scan_from_memory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <type_traits>

#include "scantet/base/error.h"

namespace scantet {
namespace {

constexpr const char* kTypeNames[] = {"int8",   "uint8", "int16",  "uint16", "int32",
                                      "uint32", "int64", "uint64", "float",  "double"};

constexpr double kLargestValue = 1e100;

template <class T>
void check_finite(const T* values, const Scan& scan, const std::string& name) {
  const std::int64_t count = scan.voxel_count();
  const auto good = [](T value) { return std::isfinite(value); };
  const std::int64_t bad = count - std::count_if(values, values + count, good);
  if (bad == 0) return;
  const std::int64_t first = std::find_if_not(values, values + count, good) - values;
  const std::int64_t row = first / scan.size[0];
  std::ostringstream message;
  message << bad << " voxels of " << name << " are NaN or infinite, the first at index (" << first % scan.size[0]
          << ", " << row % scan.size[1] << ", " << row / scan.size[1] << ")";
  throw Error(Fault::input, "input.nan", message.str(), "replace them with a value on the outside of the level");
}

template <class T>
void find_range(const T* values, Scan& scan, const std::string& name, bool may_be_constant) {
  const std::int64_t count = scan.voxel_count();
  T low = values[0];
  T high = values[0];
  bool finite = true;
  for (std::int64_t i = 0; i < count; ++i) {
    low = std::min(low, values[i]);
    high = std::max(high, values[i]);
    if constexpr (std::is_floating_point_v<T>) finite &= std::abs(values[i]) <= std::numeric_limits<T>::max();
  }
  if constexpr (std::is_floating_point_v<T>) {
    if (!finite) check_finite(values, scan, name);
  }
  if (low == high && !may_be_constant) {
    std::ostringstream message;
    message << "every voxel of " << name << " has the value " << +low;
    throw Error(Fault::input, "input.constant", message.str(), "check the export: there is nothing to mesh");
  }
  scan.min_value = static_cast<double>(low);
  scan.max_value = static_cast<double>(high);
  if (std::max(std::abs(scan.min_value), std::abs(scan.max_value)) > kLargestValue) {
    throw Error(Fault::input, "input.range",
                name + " has values beyond 1e100: products of their differences are no numbers", "scale its values");
  }
}

std::string text_of(const std::array<int, 3>& size) {
  return std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]) + " voxels";
}

}  // namespace

const char* pixel_type_name(std::size_t index) {
  return kTypeNames[index];
}

void look_at_voxels(Scan& scan, const std::string& name, bool may_be_constant) {
  scan.pixel_type = pixel_type_name(scan.voxels.index());
  std::visit([&](const auto* values) { find_range(values, scan, name, may_be_constant); }, scan.voxels);
}

void check_voxel_count(std::size_t count, const std::array<int, 3>& size) {
  const double expected = double(size[0]) * double(size[1]) * double(size[2]);
  if (static_cast<double>(count) == expected) return;
  throw Error(Fault::input, "input.dimension", std::to_string(count) + " values for " + text_of(size),
              "give one value a voxel");
}

Scan make_scan(const VoxelPointer& voxels, const std::array<int, 3>& size, const Frame& frame,
               std::shared_ptr<const void> owner, std::string format) {
  if (std::visit([](const auto* values) { return values == nullptr; }, voxels)) {
    throw Error(Fault::input, "input.pixel_type", "the scan (" + format + ") has no voxels",
                "give a pointer to its values");
  }
  if (*std::min_element(size.begin(), size.end()) < 2) {
    throw Error(Fault::input, "input.dimension",
                "the scan (" + format + ") has " + text_of(size) + "; at least 2 are needed along each axis",
                "give a volume");
  }
  Scan scan;
  scan.size = size;
  scan.frame = frame;
  scan.voxels = voxels;
  scan.owner = std::move(owner);
  scan.format = std::move(format);
  look_at_voxels(scan, "the scan (" + scan.format + ")");
  return scan;
}

}  // namespace scantet
