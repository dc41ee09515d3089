// The fields of a segmentation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scantet/base/frame.h"
#include "scantet/base/progress.h"
#include "scantet/base/run_account.h"
#include "scantet/base/stratum.h"
#include "scantet/base/trilinear.h"
#include "scantet/domain/facet_sizes.h"
#include "scantet/field/cell_walk.h"
#include "scantet/field/scan.h"
#include "scantet/labels/label_nodes.h"
#include "scantet/labels/label_settings.h"
#include "scantet/labels/label_values.h"

namespace scantet {

/// The fields that matter in one cell.
struct LabelCell {
  std::size_t count = 0;            ///< regions at its corners, 1 to 8
  std::array<Region, 8> regions{};  ///< ascending
  /// values[i] of regions[i]; the trilinear map of the cell from these is its field there.
  std::array<CellHeights, 8> values{};

  /// The region of the largest field at local coordinates u, each in [0, 1]; of several the smallest. This is what
  /// decides which region a point is in: of two regions by the sign of the map of difference(), of more by the maps of
  /// each.
  Region region_at(const Vec& u) const;
  /// values[1] - values[0]; for a cell of two regions.
  CellHeights difference() const;
};

/// A region's field made larger at the corners of a cell, at one of which it is the node's region.
struct LabelRise {
  std::array<int, 3> cell{};
  Region region = kOutside;
  double by = 0;
};

/// Each region has a field on the grid of the image, trilinear between voxel centres; a point belongs to the region
/// with the largest, of several to the smallest one. The image is padded by one node of kOutside on all sides, so every
/// other region is bounded. In a cell only the regions at its eight corners matter. The region of a node has the
/// largest field there, so the cells on both sides of a face agree on it. Immutable once made.
///
/// Memory: the labels in one byte for up to 256 regions, else in two, and about 4 % of a byte a voxel for blocks; with
/// smoothing 3/16 of a byte a voxel more, and for each node where regions meet 4 bytes and 6 for each region there (18
/// until it is fitted).
class LabelField {
 public:
  /// regions: ascending and distinct, the first kOutside. voxels: of each.
  /// values: at the nodes of all cells where regions meet; none: 1 for a node's region, 0 for others. is_fitted:
  /// whether these are of keep_volumes_of_facets().
  LabelField(const Frame& frame, LabelNodes nodes, std::vector<Region> regions, std::vector<std::uint64_t> voxels,
             std::optional<LabelValues> values, bool is_fitted = false)
      : frame_(frame),
        nodes_(std::move(nodes)),
        values_(std::move(values)),
        regions_(std::move(regions)),
        voxels_(std::move(voxels)),
        is_fitted_(is_fitted) {}

  /// Node index (of the image; the padding is at -1 and size) to world mm.
  const Frame& frame() const { return frame_; }
  /// Nodes of the image along each axis, without the padding; cells go from -1 to size - 1.
  const std::array<int, 3>& size() const { return nodes_.size(); }
  /// kOutside in the padding.
  Region region_of_node(int i, int j, int k) const { return regions_[nodes_.at(i, j, k)]; }
  /// Whether the cell between the nodes (i, j, k) and (i+1, j+1, k+1) has more than one region at its corners.
  bool is_mixed(int i, int j, int k) const;
  void cell(int i, int j, int k, LabelCell& out) const;

  /// All that there are, ascending; the first is kOutside, also if no voxel has it.
  const std::vector<Region>& regions() const { return regions_; }
  /// How many voxels each of regions() has.
  const std::vector<std::uint64_t>& voxels() const { return voxels_; }
  /// The region of a point in the padded box, in voxel units; of what is beyond kOutside.
  Region region_at(const Vec& index) const;
  /// The same field, but for numbers added to each region's values so that the volumes that facets leave to regions are
  /// those of their voxels (label_volumes.h); nodes keep their regions. Null if that is not for this field: it is for
  /// those of LabelSmoothing::keep that are not fitted yet.
  std::shared_ptr<const LabelField> fitted_to(const FacetSizes& facets) const;
  /// The same field, but for values that have risen as far as nodes keep their regions by a margin. Null if none has.
  std::shared_ptr<const LabelField> raised(std::span<const LabelRise> rises) const;
  /// The same field, but for numbers added away from where three regions or more meet, so that regions lose to each
  /// other what a mesh has too much of them (move_volumes()): excess_voxels, of each of regions() but the first, in
  /// voxels. Nothing is added around the places held, world mm; nodes keep their regions. Null unless is_fitted().
  std::shared_ptr<const LabelField> settled(std::span<const double> excess_voxels, std::span<const Point> held) const;
  bool can_be_fitted() const { return values_ && !values_->bends.empty(); }
  /// Whether it is of fitted_to(), or came of such a field.
  bool is_fitted() const { return is_fitted_; }
  /// Which blocks of cells have one region only.
  const LabelNodes& nodes() const { return nodes_; }

 private:
  Frame frame_;
  LabelNodes nodes_;
  std::optional<LabelValues> values_;
  std::vector<Region> regions_;
  std::vector<std::uint64_t> voxels_;
  bool is_fitted_;
};

/// What became of labels while their fields were made.
struct LabelAccount {
  std::vector<PhaseAccount> phases{};  ///< what smoothing took, of the stage "read"
  std::uint64_t changed = 0;           ///< voxels whose centres have another label than before
  std::vector<Region> lost{};          ///< regions that no voxel is left of
};

/// The fields of the labels of a scan. account: may be null. Throws
/// Error: as count_labels() and regions_of_labels(); input.labels (all voxels are background). Null if
/// progress.cancelled() became true.
std::shared_ptr<const LabelField> make_label_field(const Scan& scan, const LabelSettings& settings,
                                                   const Progress& progress = Progress(),
                                                   LabelAccount* account = nullptr);

}  // namespace scantet
