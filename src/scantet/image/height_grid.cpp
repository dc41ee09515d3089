// One class per voxel type, so that the sweeps above it are compiled once; its virtual calls are per row and per cell
// of interest, never per voxel.
#include "scantet/image/height_grid.h"

#include <algorithm>

#include "scantet/image/padded_grid.h"

namespace scantet {
namespace {

template <class Voxel>
class TypedHeightGrid final : public HeightGrid {
 public:
  TypedHeightGrid(const Scan& scan, const Voxel* voxels, const LevelSetSettings& settings)
      : HeightGrid(scan.size), owner_(scan.owner), grid_(padded_grid(scan, voxels, settings)) {}

  double height(int i, int j, int k) const override { return grid_.height(i, j, k); }
  CellHeights corners(int i, int j, int k) const override { return grid_.corners(i, j, k); }

  void row_signs(int j, int k, std::uint64_t* words) const override {
    std::fill_n(words, row_words(), 0);
    if (j < 0 || j >= grid_.size[1] || k < 0 || k >= grid_.size[2]) return;
    const Voxel* row = grid_.voxels + grid_.offset(0, j, k);
    for (int begin = 0; begin < grid_.size[0]; begin += 64) {
      const int count = std::min(64, grid_.size[0] - begin);
      std::uint64_t bits = 0;
      for (int n = 0; n < count; ++n) bits |= std::uint64_t{is_inside(row[begin + n])} << n;
      words[begin / 64] |= bits << 1;
      if (bits >> 63) words[begin / 64 + 1] |= 1;
    }
  }

  Extreme extreme(int begin, int end, int j, int k, bool highest) const override {
    const Voxel* row = grid_.voxels + grid_.offset(0, j, k);
    const bool largest = highest == (grid_.sign > 0);
    const Voxel* found = largest ? std::max_element(row + begin, row + end) : std::min_element(row + begin, row + end);
    const int i = static_cast<int>(found - row);
    return {i, grid_.height(i, j, k)};
  }

 private:
  /// The same as height > 0: a difference of two doubles has the sign of their comparison.
  bool is_inside(Voxel value) const {
    return grid_.sign > 0 ? static_cast<double>(value) > grid_.level : static_cast<double>(value) < grid_.level;
  }

  std::shared_ptr<const void> owner_;
  PaddedGrid<Voxel> grid_;
};

}  // namespace

std::unique_ptr<HeightGrid> make_height_grid(const Scan& scan, const LevelSetSettings& settings) {
  return std::visit(
      [&](const auto* voxels) -> std::unique_ptr<HeightGrid> {
        using Voxel = std::remove_cvref_t<decltype(*voxels)>;
        return std::make_unique<TypedHeightGrid<Voxel>>(scan, voxels, settings);
      },
      scan.voxels);
}

}  // namespace scantet
