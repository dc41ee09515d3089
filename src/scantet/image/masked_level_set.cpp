// Where no cell is shared the copy tells everything. Otherwise the field knows the shared cells, and answers there from
// the heights as they were read. Whole blocks are skipped by the copy's signs, which is right: a shared cell has both
// signs.
//
// The topology sweeps the copy, too. Along edges and through faces the copy joins what it should: two kept corners of a
// face that no edge joins have no corner left out beside them, so their face is as it was read; and the parts outside,
// which take in what is left out, meet it along edges. Through the body of a shared cell the heights as they were read
// decide.
#include "scantet/image/masked_level_set.h"

#include "scantet/field/voxel_field.h"
#include "scantet/image/trilinear_domain.h"

namespace scantet {
namespace {

template <class Voxel>
class MaskedField : public VoxelField<Voxel> {
 public:
  MaskedField(const MaskedScan& masked, const LevelSetSettings& settings, const Voxel* voxels)
      : VoxelField<Voxel>(masked.scan, settings, voxels), shared_(masked.shared) {}

  const SharedCell* shared(const CellIndex& cell) const { return shared_->find(cell); }

 private:
  std::shared_ptr<const SharedCells> shared_;
};

class MaskedHeightGrid final : public HeightGrid {
 public:
  MaskedHeightGrid(std::unique_ptr<HeightGrid> copy, std::shared_ptr<const SharedCells> shared)
      : HeightGrid(copy->size()), copy_(std::move(copy)), shared_(std::move(shared)) {}

  double height(int i, int j, int k) const override { return copy_->height(i, j, k); }
  CellHeights corners(int i, int j, int k) const override { return copy_->corners(i, j, k); }
  CellHeights field_corners(int i, int j, int k) const override {
    const SharedCell* shared = shared_->find({i, j, k});
    return shared != nullptr ? shared->heights : copy_->corners(i, j, k);
  }
  bool row_signs(int j, int k, std::uint64_t* words) const override { return copy_->row_signs(j, k, words); }
  bool row_zeros(int j, int k, std::uint64_t* words) const override { return copy_->row_zeros(j, k, words); }
  Extreme extreme(int begin, int end, int j, int k, bool highest) const override {
    return copy_->extreme(begin, end, j, k, highest);
  }

 private:
  std::unique_ptr<HeightGrid> copy_;
  std::shared_ptr<const SharedCells> shared_;
};

}  // namespace

std::unique_ptr<HeightGrid> make_masked_heights(const MaskedScan& masked, const LevelSetSettings& settings) {
  auto copy = make_height_grid(masked.scan, settings);
  if (masked.shared == nullptr) return copy;
  return std::make_unique<MaskedHeightGrid>(std::move(copy), masked.shared);
}

std::unique_ptr<Domain> make_masked_level_set(const MaskedScan& masked, const LevelSetSettings& settings,
                                              const Progress& progress) {
  const Scan& scan = masked.scan;
  if (masked.shared == nullptr) return make_level_set(scan, settings, progress);
  const LevelSetSettings checked = checked_settings(scan, settings);
  auto domain = std::visit(
      [&]<class Voxel>(const Voxel* voxels) -> std::unique_ptr<Domain> {
        using Field = MaskedField<Voxel>;
        return std::make_unique<TrilinearDomain<Field>>(
            scan.frame, scan.max_value - scan.min_value, Field(masked, checked, voxels),
            [&](const Field&) { return LevelTopology(make_masked_heights(masked, checked), scan.frame, progress); });
      },
      scan.voxels);
  if (progress.cancelled()) domain.reset();
  return domain;
}

}  // namespace scantet
