#include "dense_grid.h"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <vector>

#include "scantet/base/error.h"
#include "scantet/base/memory.h"
#include "scantet/base/options.h"
#include "scantet/field/scan_from_memory.h"

namespace vdb {
namespace {

/// Fills what the box has of a cube of `side` nodes from the node at `from` on; value(x, y, z): counted from there.
template <class Value, class At>
void fill(std::vector<Value>& voxels, const Index& size, const Index& from, int side, const At& value) {
  Index begin{};
  Index end{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    begin[axis] = std::max(from[axis], 0);
    end[axis] = std::min(from[axis] + side, size[axis]);
  }
  for (int z = begin[2]; z < end[2]; ++z) {
    for (int y = begin[1]; y < end[1]; ++y) {
      const auto row = static_cast<std::size_t>(z) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(y);
      Value* const voxel = voxels.data() + row * static_cast<std::size_t>(size[0]);
      for (int x = begin[0]; x < end[0]; ++x) voxel[x] = value(x - from[0], y - from[1], z - from[2]);
    }
  }
}

template <class Value>
scantet::Scan dense(const Grid& grid, const SparseValues<Value>& values) {
  Index size{};
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    size[axis] = values.size[axis] - grid.first[axis];
    count *= static_cast<std::size_t>(size[axis]);
  }
  std::vector<Value> voxels(count, values.background);
  const auto from = [&](const Index& block) {
    return Index{block[0] * kBlockSide - grid.first[0], block[1] * kBlockSide - grid.first[1],
                 block[2] * kBlockSide - grid.first[2]};
  };
  for (const Tile<Value>& tile : values.tiles) {
    fill(voxels, size, from(tile.block), tile.side * kBlockSide, [&](int, int, int) { return tile.value; });
  }
  for (const Leaf<Value>& leaf : values.leaves) {
    fill(voxels, size, from(leaf.block), kBlockSide,
         [&](int x, int y, int z) { return leaf.values[(x * kBlockSide + y) * kBlockSide + z]; });
  }
  const scantet::Frame& frame = grid.frame;
  const scantet::Vec first{double(grid.first[0]), double(grid.first[1]), double(grid.first[2])};
  scantet::Scan scan = scantet::make_scan(std::move(voxels), size,
                                          {{frame.column(0), frame.column(1), frame.column(2)}, frame.to_world(first)});
  scan.format = "OpenVDB";
  return scan;
}

/// Whether a grid of `voxels` in its box has so few of its own that it is not worth the memory of all. A tile is one
/// value, whatever its size: a file of some kilobytes may have one of 10¹⁰ voxels.
template <class Value>
bool is_nearly_empty(const SparseValues<Value>& values, double voxels) {
  constexpr double kSmall = 1 << 27;  // voxels that need no question
  constexpr double kLeastShare = 1e-3;
  constexpr double kBlock = kBlockSide * kBlockSide * kBlockSide;
  return voxels > kSmall && kBlock * static_cast<double>(values.leaves.size()) < kLeastShare * voxels;
}

}  // namespace

bool holds_whole_numbers(const Grid& grid) {
  return std::visit([]<class Value>(const SparseValues<Value>&) { return std::is_integral_v<Value>; }, grid.values);
}

std::optional<scantet::Scan> dense_scan(const Grid& grid, const std::string& file) {
  return std::visit(
      [&](const auto& values) -> std::optional<scantet::Scan> {
        double voxels = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const int nodes = values.size[axis] - grid.first[axis];
          if (nodes < 2) return std::nullopt;
          voxels *= nodes;
        }
        if (grid.min_value == grid.max_value) return std::nullopt;
        const std::string box =
            file + ": the box of grid " + grid.head.name + " has " + scantet::number_text(voxels) + " voxels, and ";
        if (voxels > std::numeric_limits<std::int32_t>::max()) {
          throw scantet::Error(scantet::Fault::input, "input.too_large",
                               box + "2147483647 are the most that are looked at one by one", "clip or resample it");
        }
        if (is_nearly_empty(values, voxels)) {
          throw scantet::Error(scantet::Fault::input, "input.too_large",
                               box + "not one in a thousand of them has a value of its own",
                               "remove what lies far from the rest, clip the grid, or resample it");
        }
        constexpr double kMostOfMemory = 0.5;  // reading, counting and meshing need the rest
        if (voxels * sizeof(values.background) > kMostOfMemory * scantet::physical_bytes()) {
          throw scantet::Error(scantet::Fault::input, "input.too_large",
                               box + "take more than half of this machine's memory", "clip or resample it");
        }
        return dense(grid, values);
      },
      grid.values);
}

}  // namespace vdb
