// What the plugin knows of a grid of a .vdb file once it is read; no OpenVDB in sight.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scantet/base/frame.h"
#include "sparse_field.h"

namespace vdb {

/// What the head of a grid says.
struct GridHead {
  std::string name;        ///< unique in the file
  std::string value_type;  ///< "float", "vec3s", "ptdataidx32" …
  std::string grid_class;  ///< "level set", "fog volume", "staggered", "unknown"
  bool level_set = false;
  bool supported = false;  ///< a scalar type that read_grid() takes
  bool mask = false;       ///< of yes and no, read as 1 and 0
  bool affine = true;      ///< else the transform is a frustum's
};

/// The values of a grid. Index (0, 0, 0) of `frame` and `values` is the grid's own index `origin`: the first node of
/// the box of all voxels that are active or differ from the background, moved down to a multiple of 8.
struct Grid {
  GridHead head;
  scantet::Frame frame;  ///< 1 unit is 1 mm
  Index origin{};
  Index first{};  ///< of `frame`: the first node of the box before it was moved
  std::variant<SparseValues<float>, SparseValues<double>, SparseValues<std::int32_t>, SparseValues<std::int64_t>>
      values;
  double min_value = 0;  ///< of all voxels and the background
  double max_value = 0;
  double background = 0;
  std::int64_t active_voxels = 0;
  std::int64_t memory_bytes = 0;  ///< of the tree
};

/// The heads of all grids of a file, in its order.
/// Throws Error(Fault::input): input.not_found, input.empty, input.format (not a .vdb file), input.corrupt (truncated
/// or damaged), input.grid (no grid in it).
std::vector<GridHead> read_heads(const std::string& file);

/// Reads a grid; nullopt: the only one of a supported type.
/// Throws Error: as read_heads(), usage.grid (no grid of that name; or none named though there are several: the message
/// lists them), and with Fault::input: input.grid (nothing but background, or no scalar type), input.frame (frustum, or
/// axes that do not span space), input.nan (where the first is), input.too_large (more than 8,184 voxels along an
/// axis).
Grid read_grid(const std::string& file, const std::optional<std::string>& name);

}  // namespace vdb
