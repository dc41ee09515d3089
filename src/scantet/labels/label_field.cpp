// Each field is 1 at the voxel centres of its label and 0 at the others, unless it is to be smoothed.
#include "scantet/labels/label_field.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/base/parallel.h"
#include "scantet/base/phase_clock.h"
#include "scantet/labels/label_count.h"
#include "scantet/labels/label_gaussian.h"
#include "scantet/labels/label_margins.h"
#include "scantet/labels/label_smoothing.h"
#include "scantet/labels/label_volumes.h"

namespace scantet {
namespace {

constexpr double kWidestTable = 1 << 20;

/// Ranks by label: a table if labels are close to each other, else a search.
class RankOfLabel {
 public:
  RankOfLabel(const std::vector<std::int64_t>& labels, const std::vector<LabelRank>& ranks)
      : labels_(labels), ranks_(ranks) {
    if (static_cast<double>(labels.back() - labels.front()) >= kWidestTable) return;
    table_.resize(static_cast<std::size_t>(labels.back() - labels.front()) + 1);
    for (std::size_t n = 0; n < labels.size(); ++n) {
      table_[static_cast<std::size_t>(labels[n] - labels.front())] = ranks[n];
    }
  }
  LabelRank operator()(std::int64_t label) const {
    if (!table_.empty()) return table_[static_cast<std::size_t>(label - labels_.front())];
    return ranks_[static_cast<std::size_t>(std::lower_bound(labels_.begin(), labels_.end(), label) - labels_.begin())];
  }

 private:
  const std::vector<std::int64_t>& labels_;
  const std::vector<LabelRank>& ranks_;
  std::vector<LabelRank> table_;
};

void fill(const Scan& scan, const RankOfLabel& rank_of, LabelNodes& nodes) {
  const auto rows = static_cast<std::size_t>(scan.size[1]) * static_cast<std::size_t>(scan.size[2]);
  constexpr std::size_t kRows = 64;
  std::visit(
      [&](const auto* values) {
        parallel_for(rows, kRows, [&](std::size_t begin, std::size_t end) {
          std::vector<LabelRank> ranks(static_cast<std::size_t>(scan.size[0]));
          for (std::size_t row = begin; row < end; ++row) {
            const auto* v = values + row * ranks.size();
            for (std::size_t i = 0; i < ranks.size(); ++i) {
              ranks[i] = i > 0 && v[i] == v[i - 1] ? ranks[i - 1] : rank_of(static_cast<std::int64_t>(v[i]));
            }
            nodes.set_row(static_cast<int>(row) % scan.size[1], static_cast<int>(row) / scan.size[1], ranks.data());
          }
        });
      },
      scan.voxels);
}

/// Puts the distinct ones of the corners into `ranks`, ascending. Returns how many there are.
std::size_t distinct(const std::array<LabelRank, 8>& corners, std::array<LabelRank, 8>& ranks) {
  std::size_t count = 0;
  for (const LabelRank rank : corners) {
    std::size_t at = count;
    while (at > 0 && ranks[at - 1] > rank) --at;
    if (at > 0 && ranks[at - 1] == rank) continue;
    for (std::size_t n = count++; n > at; --n) ranks[n] = ranks[n - 1];
    ranks[at] = rank;
  }
  return count;
}

/// Counts the nodes of each rank anew, and those that had another one.
void recount(const LabelNodes& before, const LabelNodes& nodes, const std::vector<Region>& regions,
             std::vector<std::uint64_t>& voxels, LabelAccount& account) {
  std::fill(voxels.begin(), voxels.end(), 0);
  for (int k = 0; k < nodes.size()[2]; ++k) {
    for (int j = 0; j < nodes.size()[1]; ++j) {
      for (int i = 0; i < nodes.size()[0]; ++i) {
        const LabelRank rank = nodes.at(i, j, k);
        ++voxels[rank];
        account.changed += rank != before.at(i, j, k) ? 1 : 0;
      }
    }
  }
  for (std::size_t rank = 1; rank < regions.size(); ++rank) {
    if (voxels[rank] == 0) account.lost.push_back(regions[rank]);
  }
  if (account.lost.size() + 1 < regions.size()) return;
  throw Error(Fault::input, "input.labels", "smoothing leaves no voxel of any label", "smooth less");
}

/// Values as the settings ask for them; none for ones and zeros. A Gaussian changes nodes and voxels, too.
std::optional<LabelValues> smoothed(const LabelSettings& settings, const Frame& frame,
                                    const std::vector<Region>& regions, LabelNodes& nodes,
                                    std::vector<std::uint64_t>& voxels, LabelAccount& account,
                                    const Progress& progress) {
  if (settings.smoothing == LabelSmoothing::none) return std::nullopt;
  Progress nobody;
  PhaseClock phase(account.phases, nobody);
  phase.begin("read", "label smoothing");
  if (settings.smoothing == LabelSmoothing::keep) return smooth_labels(nodes, progress);
  std::array<double, 3> sigma{};
  double extent_mm = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::size_t>(axis);
    sigma[n] = settings.gaussian_mm / frame.spacing_mm(axis);
    extent_mm = std::max(extent_mm, nodes.size()[n] * frame.spacing_mm(axis));
  }
  if (!(settings.gaussian_mm < extent_mm)) {
    throw Error(Fault::usage, "usage.smooth",
                "labels are to be smoothed by " + number_text(settings.gaussian_mm) + " mm, and the image is only " +
                    number_text(extent_mm) + " mm long",
                "a voxel or two take the steps away: here " + number_text(frame.min_spacing_mm()) +
                    " mm or twice that; --label-smoothing keep changes no label");
  }
  SharedLabels blurred = blur_labels(nodes, regions.size(), sigma, progress);
  if (progress.cancelled()) return std::nullopt;
  recount(nodes, blurred.nodes, regions, voxels, account);
  nodes = std::move(blurred.nodes);
  return std::move(blurred.values);
}

}  // namespace

Region LabelCell::region_at(const Vec& u) const {
  if (count == 1) return regions[0];
  if (count == 2) return regions[trilinear(difference(), u) > 0 ? 1 : 0];
  std::size_t best = 0;
  double most = trilinear(values[0], u);
  for (std::size_t i = 1; i < count; ++i) {
    const double value = trilinear(values[i], u);
    if (value > most) {
      most = value;
      best = i;
    }
  }
  return regions[best];
}

CellHeights LabelCell::difference() const {
  CellHeights d;
  for (std::size_t corner = 0; corner < d.size(); ++corner) d[corner] = values[1][corner] - values[0][corner];
  return d;
}

bool LabelField::is_mixed(int i, int j, int k) const {
  if (!nodes_.small_is_mixed({i, j, k})) return false;
  const std::array<LabelRank, 8> ranks = nodes_.corners({i, j, k});
  return !std::all_of(ranks.begin() + 1, ranks.end(), [&](LabelRank rank) { return rank == ranks[0]; });
}

void LabelField::cell(int i, int j, int k, LabelCell& out) const {
  const std::array<LabelRank, 8> corners = nodes_.corners({i, j, k});
  std::array<LabelRank, 8> ranks;
  out.count = distinct(corners, ranks);
  for (std::size_t n = 0; n < out.count; ++n) {
    out.regions[n] = regions_[ranks[n]];
    if (values_ && out.count > 1) continue;
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
      out.values[n][corner] = corners[corner] == ranks[n] ? 1 : 0;
    }
  }
  if (!values_ || out.count == 1) return;
  // Memory is what takes time here: all of it is asked for before any is used.
  const LabelValues& values = *values_;
  std::array<std::size_t, 8> entries;
  for (std::size_t row = 0; row < 4; ++row) {
    // The next node of the row is of this cell, too, so its values follow.
    const int y = j + static_cast<int>(row & 1);
    const int z = k + static_cast<int>(row >> 1);
    const std::size_t node = values.nodes.number_of(values.nodes.position(i, y, z));
    entries[2 * row] = values.first[node];
    entries[2 * row + 1] = values.first[node + 1];
  }
  for (std::size_t corner = 0; corner < 8; ++corner) {
    std::size_t entry = entries[corner];
    for (std::size_t n = 0; n < out.count; ++n, ++entry) {
      while (values.ranks[entry] != ranks[n]) ++entry;
      out.values[n][corner] = static_cast<double>(values.values[entry]);
    }
  }
}

Region LabelField::region_at(const Vec& index) const {
  if (!in_padded_box(index, size())) return kOutside;
  const CellIndex at = cell_of(index, size());
  if (!nodes_.small_is_mixed(at)) return region_of_node(at[0], at[1], at[2]);
  LabelCell fields;
  cell(at[0], at[1], at[2], fields);
  return fields.region_at(local_in(at, index));
}

std::shared_ptr<const LabelField> LabelField::fitted_to(const FacetSizes& facets) const {
  if (!can_be_fitted()) return nullptr;
  LabelValues values = *values_;
  const auto fit = [&] {
    keep_volumes_of_facets(nodes_, frame_, facets, values);
    keep_margins(nodes_, values);
  };
  fit();
  if (are_volumes_off(nodes_, frame_, facets, values, voxels_)) fit();  // thin parts got thicker: others have room
  values.bends = {};
  return std::make_shared<const LabelField>(frame_, nodes_, regions_, voxels_, std::move(values), true);
}

std::shared_ptr<const LabelField> LabelField::settled(std::span<const double> excess_voxels,
                                                      std::span<const Point> held) const {
  if (!is_fitted_) return nullptr;
  std::vector<double> excess(excess_voxels.begin(), excess_voxels.end());
  excess[0] = -std::accumulate(excess.begin() + 1, excess.end(), 0.0);
  std::vector<Vec> places;
  for (const Point& p : held) {
    if (const Vec index = frame_.to_index(p); in_padded_box(index, size())) places.push_back(index);
  }
  LabelValues values = *values_;
  move_volumes(nodes_, excess, places, values);
  return std::make_shared<const LabelField>(frame_, nodes_, regions_, voxels_, std::move(values), true);
}

std::shared_ptr<const LabelField> LabelField::raised(std::span<const LabelRise> rises) const {
  constexpr float kMargin = 0.1F;
  if (!values_) return nullptr;
  LabelValues values = *values_;
  bool has_changed = false;
  for (const LabelRise& rise : rises) {
    const auto found = std::lower_bound(regions_.begin(), regions_.end(), rise.region);
    if (found == regions_.end() || *found != rise.region) continue;
    const auto rank = static_cast<LabelRank>(found - regions_.begin());
    const std::array<LabelRank, 8> corners = nodes_.corners(rise.cell);
    if (!is_mixed(rise.cell[0], rise.cell[1], rise.cell[2])) continue;
    if (std::find(corners.begin(), corners.end(), rank) == corners.end()) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const int i = rise.cell[0] + (corner & 1);
      const int j = rise.cell[1] + (corner >> 1 & 1);
      const int k = rise.cell[2] + (corner >> 2);
      const std::size_t position = values.nodes.position(i, j, k);
      const LabelRank own = nodes_.at(i, j, k);
      float& value = values.values[values.entry_of(position, rank)];
      float most = value + static_cast<float>(rise.by);
      if (own != rank) most = std::min(most, values.values[values.entry_of(position, own)] - kMargin);
      if (!(most > value)) continue;
      value = most;
      has_changed = true;
    }
  }
  if (!has_changed) return nullptr;
  return std::make_shared<const LabelField>(frame_, nodes_, regions_, voxels_, std::move(values), is_fitted_);
}

std::shared_ptr<const LabelField> make_label_field(const Scan& scan, const LabelSettings& settings,
                                                   const Progress& progress, LabelAccount* account) {
  const std::vector<LabelCount> counts = count_labels(scan);
  const std::vector<std::int64_t> labels = labels_of(counts);
  const std::vector<Region> region_of = regions_of_labels(labels, settings);
  std::map<Region, std::uint64_t> voxels_of{{kOutside, 0}};
  for (std::size_t n = 0; n < counts.size(); ++n) voxels_of[region_of[n]] += counts[n].voxels;
  if (voxels_of.size() == 1) {
    throw Error(Fault::input, "input.labels", "all voxels are background, so there is nothing to mesh",
                "choose labels that the image holds");
  }
  std::vector<Region> regions;
  std::vector<std::uint64_t> voxels;
  for (const auto& [region, count] : voxels_of) {
    regions.push_back(region);
    voxels.push_back(count);
  }
  std::vector<LabelRank> ranks;
  ranks.reserve(region_of.size());
  for (const Region region : region_of) {
    ranks.push_back(static_cast<LabelRank>(std::lower_bound(regions.begin(), regions.end(), region) - regions.begin()));
  }
  LabelNodes nodes(scan.size, regions.size());
  fill(scan, RankOfLabel(labels, ranks), nodes);
  if (progress.cancelled()) return nullptr;
  nodes.find_blocks();
  if (progress.cancelled()) return nullptr;
  LabelAccount own;
  LabelAccount& told = account == nullptr ? own : *account;
  std::optional<LabelValues> values = smoothed(settings, scan.frame, regions, nodes, voxels, told, progress);
  if (progress.cancelled()) return nullptr;
  return std::make_shared<const LabelField>(scan.frame, std::move(nodes), std::move(regions), std::move(voxels),
                                            std::move(values));
}

}  // namespace scantet
