// One class per voxel type, so that the sweeps above it are compiled once; its virtual calls are per row and per cell
// of interest, never per voxel.
#include "scantet/field/height_grid.h"

#include <algorithm>

#include "scantet/field/padded_grid.h"

namespace scantet {
namespace {

template <class Voxel>
class TypedHeightGrid final : public HeightGrid {
 public:
  TypedHeightGrid(const Scan& scan, const Voxel* voxels, const LevelSetSettings& settings)
      : HeightGrid(scan.size), owner_(scan.owner), grid_(padded_grid(scan, voxels, settings)) {}

  double height(int i, int j, int k) const override { return grid_.height(i, j, k); }
  CellHeights corners(int i, int j, int k) const override { return grid_.corners(i, j, k); }

  bool row_signs(int j, int k, std::uint64_t* words) const override {
    grid_.row_signs(j, k, words);
    return std::any_of(words, words + grid_.row_words(), [](std::uint64_t word) { return word != 0; });
  }

  bool row_zeros(int j, int k, std::uint64_t* words) const override { return grid_.row_zeros(j, k, words); }

  Extreme extreme(int begin, int end, int j, int k, bool highest) const override {
    const Voxel* row = grid_.voxels + grid_.offset(0, j, k);
    const bool largest = highest == (grid_.sign > 0);
    const Voxel* found = largest ? std::max_element(row + begin, row + end) : std::min_element(row + begin, row + end);
    const int i = static_cast<int>(found - row);
    return {i, grid_.height(i, j, k)};
  }

 private:
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
