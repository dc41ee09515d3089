#include "scantet/verification/scan_labels.h"

#include <algorithm>
#include <cstdint>
#include <map>

#include "scantet/base/parallel.h"
#include "scantet/labels/label_count.h"
#include "scantet/labels/label_field.h"

namespace scantet {
namespace {

class ScanLabels final : public LabelSource {
 public:
  ScanLabels(const Scan& scan, const LabelSettings& settings, const Progress& progress)
      : size_(scan.size), frame_(scan.frame) {
    if (settings.smoothing != LabelSmoothing::none) field_ = make_label_field(scan, settings, progress);
    if (settings.smoothing == LabelSmoothing::gaussian) return;
    const std::vector<std::int64_t> labels = labels_of(count_labels(scan));
    const std::vector<Region> regions = regions_of_labels(labels, settings);
    const auto row = static_cast<std::size_t>(size_[0]);
    regions_.resize(row * static_cast<std::size_t>(size_[1]) * static_cast<std::size_t>(size_[2]));
    std::visit(
        [&](const auto* voxels) {
          parallel_for(regions_.size(), 4096, [&](std::size_t begin, std::size_t end) {
            for (std::size_t v = begin; v < end; ++v) {
              const auto at = std::lower_bound(labels.begin(), labels.end(), static_cast<std::int64_t>(voxels[v]));
              regions_[v] = regions[static_cast<std::size_t>(at - labels.begin())];
            }
          });
        },
        scan.voxels);
  }

  bool is_whole() const { return field_ != nullptr || !regions_.empty(); }
  const std::array<int, 3>& size() const override { return size_; }
  const Frame& frame() const override { return frame_; }

  Region region_of(int i, int j, int k) const override {
    if (i < 0 || j < 0 || k < 0 || i >= size_[0] || j >= size_[1] || k >= size_[2]) return kOutside;
    if (regions_.empty()) return field_->region_of_node(i, j, k);
    const auto row = static_cast<std::size_t>(size_[0]);
    const auto line = static_cast<std::size_t>(k) * static_cast<std::size_t>(size_[1]) + static_cast<std::size_t>(j);
    return regions_[line * row + static_cast<std::size_t>(i)];
  }

  void cell(int i, int j, int k, LabelCellValues& out) const override {
    if (field_ != nullptr) {
      LabelCell cell;
      field_->cell(i, j, k, cell);
      out.count = cell.count;
      out.regions = cell.regions;
      for (std::size_t n = 0; n < cell.count; ++n) {
        for (std::size_t c = 0; c < 8; ++c) out.values[n][c] = cell.values[n][c];
      }
      return;
    }
    std::array<Region, 8> corners{};
    for (int c = 0; c < 8; ++c) {
      corners[static_cast<std::size_t>(c)] = region_of(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
    }
    out.regions = corners;
    std::sort(out.regions.begin(), out.regions.end());
    out.count = static_cast<std::size_t>(std::unique(out.regions.begin(), out.regions.end()) - out.regions.begin());
    for (std::size_t n = 0; n < out.count; ++n) {
      for (std::size_t c = 0; c < 8; ++c) out.values[n][c] = corners[c] == out.regions[n] ? 1 : 0;
    }
  }

 private:
  std::array<int, 3> size_;
  Frame frame_;
  std::shared_ptr<const LabelField> field_;  // null: no smoothing
  std::vector<Region> regions_;              // of voxels; empty: those of the field
};

}  // namespace

std::unique_ptr<LabelSource> scan_labels(const Scan& scan, const LabelSettings& settings, const Progress& progress) {
  auto labels = std::make_unique<ScanLabels>(scan, settings, progress);
  if (progress.cancelled() || !labels->is_whole()) return nullptr;
  return labels;
}

std::vector<std::pair<Region, double>> values_at(const LabelSource& labels, const std::array<int, 3>& voxel) {
  const auto& [i, j, k] = voxel;
  const Region here = labels.region_of(i, j, k);
  const auto is_mixed = [&](int x, int y, int z, int width) {
    for (int n = 0; n < width * width * width; ++n) {
      if (labels.region_of(x + n % width, y + n / width % width, z + n / (width * width)) != here) return true;
    }
    return false;
  };
  if (!is_mixed(i - 1, j - 1, k - 1, 3)) return {};
  std::map<Region, double> values;
  LabelCellValues cell;
  for (int c = 0; c < 8; ++c) {
    const std::array<int, 3> low{i - (c & 1), j - (c >> 1 & 1), k - (c >> 2)};
    if (!is_mixed(low[0], low[1], low[2], 2)) continue;
    labels.cell(low[0], low[1], low[2], cell);
    for (std::size_t n = 0; n < cell.count; ++n) values[cell.regions[n]] = cell.values[n][static_cast<std::size_t>(c)];
  }
  return {values.begin(), values.end()};
}

}  // namespace scantet
