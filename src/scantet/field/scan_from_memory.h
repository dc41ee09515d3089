// Scans of voxels that are in memory already.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/frame.h"
#include "scantet/field/scan.h"

namespace SCANTET_API scantet {

/// A scan of voxels in memory. They are looked at once, for their range, and not copied.
///
/// voxels: size[0]·size[1]·size[2] values, x fastest, in one of the ten types of VoxelPointer. They must stay as they
/// are as long as the scan, a copy of it, or a domain made from one of these lives.
/// size: voxels along each axis, each ≥ 2. frame: index (of voxel centres) to world, mm, LPS.
/// owner: is kept as long as any of these lives, and so should keep the voxels; null: the caller sees to that.
/// format: what the scan is called in messages and reports: "memory", "ITK image".
/// Throws Error (Fault::input): input.pixel_type (the pointer is null), input.dimension (fewer than two voxels along an
/// axis), input.nan (NaN or infinite voxels: how many and where the first is), input.constant (all voxels are equal),
/// input.range (values beyond ±1e100).
Scan make_scan(const VoxelPointer& voxels, const std::array<int, 3>& size, const Frame& frame,
               std::shared_ptr<const void> owner = nullptr, std::string format = "memory");

/// Throws Error: input.dimension (so many values are not size[0]·size[1]·size[2]).
void check_voxel_count(std::size_t count, const std::array<int, 3>& size);

/// The same of values that the scan keeps itself. Throws Error: as the other, and as check_voxel_count().
template <class Voxel>
Scan make_scan(std::vector<Voxel> values, const std::array<int, 3>& size, const Frame& frame) {
  check_voxel_count(values.size(), size);
  const auto kept = std::make_shared<const std::vector<Voxel>>(std::move(values));
  return make_scan(VoxelPointer{kept->data()}, size, frame, kept);
}

/// "uint8", "int16", "float": what people call the type that VoxelPointer has at that index, 0 … 9.
const char* pixel_type_name(std::size_t index);

/// Sets pixel_type, min_value and max_value by the voxels. name: of the scan, in messages. Pre: size and voxels are
/// set, and there is at least one voxel. Throws Error: input.nan (NaN or infinite voxels); input.constant (all voxels
/// are equal), unless may_be_constant; input.range (values beyond ±1e100).
void look_at_voxels(Scan& scan, const std::string& name, bool may_be_constant = false);

}  // namespace scantet
