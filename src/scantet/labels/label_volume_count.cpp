// Each sample stands for a cube, of which the label with the second largest value has a share if the two are close: so
// thin sheets along the grid, whose surfaces all lie between the same samples, have their volume, too.
//
// A facet whose corners lie on an interface of principal curvatures k1 and k2 is, over its area, 3/16·R²·(k1 + k2) from
// it, R being its circumradius (a triangle of equal sides, to second order). The sum of the curvatures is the second
// derivative of the fields' difference along the interface, over its slope. Where an interface turns as far as a facet
// is wide, refinement makes smaller facets; how much smaller, and the mean radius, are measured on atlases
// (docs/algorithm.md).
#include "scantet/labels/label_volume_count.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scantet/base/parallel.h"
#include "scantet/base/trilinear.h"
#include "scantet/labels/rank_set.h"

namespace scantet {
namespace {

constexpr std::size_t kSamples = 3;  // a cell along each axis
static_assert(kSamples * kSamples * kSamples == kVolumeSamples);

/// A field at the samples of a cell, x first: trilinear(), one axis after the other.
using SampleValues = std::array<double, kSamples * kSamples * kSamples>;
SampleValues values_at_samples(const CellHeights& h) {
  const auto place = [](std::size_t n) { return (static_cast<double>(n) + 0.5) / kSamples; };
  std::array<double, 4 * kSamples> x;
  for (std::size_t edge = 0; edge < 4; ++edge) {
    for (std::size_t n = 0; n < kSamples; ++n) x[edge * kSamples + n] = mix(h[2 * edge], h[2 * edge + 1], place(n));
  }
  constexpr std::size_t kFace = kSamples * kSamples;
  std::array<double, 2 * kFace> xy;
  for (std::size_t n = 0; n < kFace; ++n) {
    const std::size_t at = n % kSamples;
    xy[n] = mix(x[at], x[kSamples + at], place(n / kSamples));
    xy[kFace + n] = mix(x[2 * kSamples + at], x[3 * kSamples + at], place(n / kSamples));
  }
  SampleValues values;
  for (std::size_t n = 0; n < values.size(); ++n) {
    values[n] = mix(xy[n % kFace], xy[kFace + n % kFace], place(n / kFace));
  }
  return values;
}

/// The slope at the centre of a cell, in values a voxel.
Vec slope_of(const CellHeights& d) {
  Vec slope;
  for (std::size_t c = 0; c < d.size(); ++c) {
    for (int axis = 0; axis < 3; ++axis) slope[axis] += (c >> axis & 1) != 0 ? d[c] / 4 : -d[c] / 4;
  }
  return slope;
}

/// The interface of two labels in a cell.
struct Bend {
  double slope = 0;  ///< of the fields' difference, values a mm
  double along = 0;  ///< the sum of its second derivatives along the interface, values a mm²
};

/// What facets cut off interfaces.
class FacetCut {
 public:
  FacetCut(const Frame& frame, const FacetSizes& facets) : frame_(frame), facets_(facets) {
    for (int axis = 0; axis < 3; ++axis) per_mm_[axis] = 1 / frame.spacing_mm(axis);
  }

  /// bends: second differences of d along each axis, in the mean. Axes count as if at right angles.
  Bend bend_of(const CellHeights& d, const Vec& bends) const {
    const Vec step = slope_of(d);
    const Vec slope{step.x * per_mm_.x, step.y * per_mm_.y, step.z * per_mm_.z};
    Bend bend{length(slope), 0};
    if (!(bend.slope > 0)) return bend;
    const Vec normal = (1 / bend.slope) * slope;
    for (int axis = 0; axis < 3; ++axis) {
      const int next = (axis + 1) % 3;
      bend.along += (1 - normal[axis] * normal[axis]) * bends[axis] * per_mm_[axis] * per_mm_[axis];
      bend.along -= 2 * normal[axis] * normal[next] * twist(d, axis, next) * per_mm_[axis] * per_mm_[next];
    }
    return bend;
  }

  /// How far facets are from an interface in the mean, mm, where the sum of its principal curvatures is this, per mm.
  double depth_mm(const CellIndex& cell, double curvature) const {
    constexpr double kRadius = 0.78;     // of a facet over that of the largest surface ball, in the mean
    constexpr double kOfDistance = 0.4;  // the mean over facets that are up to that distance off
    const Point centre = frame_.to_world({cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5});
    const double radius_mm = kRadius * facets_.alpha * facets_.size.size_at(centre);
    const double turn = radius_mm * curvature;  // by how much the interface turns over a facet
    const double most_mm = kOfDistance * facets_.distance_mm;
    return std::clamp(3.0 / 16 * radius_mm * turn / (1 + turn * turn), -most_mm, most_mm);
  }

 private:
  /// The mixed second difference.
  static double twist(const CellHeights& d, int axis, int other) {
    double twist = 0;
    for (std::size_t c = 0; c < d.size(); ++c) twist += (c >> axis & 1) == (c >> other & 1) ? d[c] / 2 : -d[c] / 2;
    return twist;
  }

  const Frame& frame_;
  const FacetSizes& facets_;
  Vec per_mm_;  // voxels
};

/// Counts the volumes that labels have with a number added to the values of each.
class VolumeCounter {
 public:
  /// cut: null for the volumes that the fields have, else for those that facets leave.
  VolumeCounter(const CountedFields& counted, const FacetCut* cut)
      : nodes_(counted.nodes), values_(counted.fields), now_(counted.values), held_(counted.held), cut_(cut) {}

  VolumeCount count() const {
    const std::size_t ranks = values_.added.size();
    constexpr std::size_t kLayers = 2 * kBlock;
    const auto layers = static_cast<std::size_t>(nodes_.size()[2]) + 1;
    std::vector<VolumeCount> pieces((layers + kLayers - 1) / kLayers, VolumeCount(ranks));
    parallel_for(layers, kLayers, [&](std::size_t begin, std::size_t end) {
      VolumeCount& piece = pieces[begin / kLayers];
      Patches patches;
      for (std::size_t layer = begin; layer < end; ++layer) {
        for_each_mixed_cell(nodes_, static_cast<int>(layer) - 1, [&](int i, int j, int k) {
          count_cell({i, j, k}, piece, patches);
        });
      }
      for (const auto& [place, patch] : patches) {
        const double samples = patch.area * cut_->depth_mm(patch.cell, patch.bent / patch.area);
        piece.excess[patch.ranks[0]] += samples;
        piece.excess[patch.ranks[1]] -= samples;
      }
    });
    VolumeCount all(ranks);
    for (const VolumeCount& piece : pieces) {
      for (std::size_t n = 0; n < ranks; ++n) all.excess[n] += piece.excess[n];
      for (const auto& [key, samples] : piece.movable) all.movable[key] += samples;
    }
    return all;
  }

 private:
  static constexpr std::size_t kBlock = 4;  // cells

  /// The interface of two labels in a block of cells: in one cell alone its curvature is mostly noise.
  struct Patch {
    CellIndex cell;                  // one of the block
    std::array<LabelRank, 2> ranks;  // the lower one first
    double area = 0;                 // samples a mm
    double bent = 0;                 // area times the sum of the principal curvatures
  };
  using Patches = std::unordered_map<std::uint64_t, Patch>;  // by block and volume_key()

  /// The labels at the corners of a cell, and their fields there.
  struct Cell {
    CellIndex at;
    RankSet ranks;
    std::array<CellHeights, 8> fields;
    std::array<std::array<std::size_t, 8>, 8> entries;  // of fields, in the values
    double free = 1;                                    // share of the corners that are not held
  };

  Cell load(const CellIndex& at) const {
    Cell cell{at, {}, {}, {}};
    for (const LabelRank rank : nodes_.corners(at)) cell.ranks.insert(rank);
    for (std::size_t c = 0; c < 8; ++c) {
      const auto bit = [&](std::size_t axis) { return at[axis] + static_cast<int>(c >> axis & 1); };
      const std::size_t position = values_.nodes.position(bit(0), bit(1), bit(2));
      if (held_ != nullptr && (*held_)[values_.nodes.number_of(position)]) cell.free -= 0.125;
      std::size_t n = 0;
      for (const LabelRank rank : cell.ranks) {
        const std::size_t entry = values_.entry_of(position, rank);
        cell.fields[n][c] = static_cast<double>(now_[entry]);
        cell.entries[n][c] = entry;
        ++n;
      }
    }
    return cell;
  }

  /// What holds for two fields in all of a cell.
  struct Pair {
    std::pair<std::size_t, std::size_t> fields{};  // the lower number first
    double across = 0;                             // by how much their difference changes over the cube of a sample
    double movable = 0;                            // so far
  };

  static CellHeights difference(const Cell& cell, const Pair& pair) {
    CellHeights d;
    for (std::size_t c = 0; c < d.size(); ++c) {
      d[c] = cell.fields[pair.fields.first][c] - cell.fields[pair.fields.second][c];
    }
    return d;
  }

  void add_to_patch(const Cell& cell, const Pair& pair, const std::array<LabelRank, 2>& ranks, Patches& patches) const {
    Vec bends;
    for (std::size_t c = 0; c < 8; ++c) {
      const auto& a = values_.bends[cell.entries[pair.fields.first][c]];
      const auto& b = values_.bends[cell.entries[pair.fields.second][c]];
      for (std::size_t axis = 0; axis < 3; ++axis) bends[static_cast<int>(axis)] += (a[axis] - b[axis]) / 8.0;
    }
    const Bend bend = cut_->bend_of(difference(cell, pair), bends);
    if (!(bend.slope > 0)) return;
    const auto block = [&](std::size_t axis) { return static_cast<std::uint64_t>(cell.at[axis] + 1) / kBlock; };
    const std::uint64_t place = (block(2) % 2) << 30 | block(1) << 15 | block(0);
    Patch& patch =
        patches.try_emplace(place << 32 | volume_key(ranks[0], ranks[1]), Patch{cell.at, ranks}).first->second;
    patch.area += pair.movable * bend.slope;
    patch.bent += pair.movable * bend.along;
  }

  void count_cell(const CellIndex& at, VolumeCount& count, Patches& patches) const {
    constexpr double kShare = kVolumeSamples / 8.0;
    constexpr double kLeast = 1e-3;  // of the margin
    for (const LabelRank rank : nodes_.corners(at)) count.excess[rank] -= kShare;
    const Cell cell = load(at);
    std::array<SampleValues, 8> samples;
    for (std::size_t n = 0; n < cell.ranks.size(); ++n) samples[n] = values_at_samples(cell.fields[n]);
    Pair pair;
    const auto end_pair = [&] {
      if (pair.movable == 0) return;
      const std::array ranks{cell.ranks.begin()[pair.fields.first], cell.ranks.begin()[pair.fields.second]};
      count.movable[volume_key(ranks[0], ranks[1])] += pair.movable;
      if (cut_ != nullptr) add_to_patch(cell, pair, ranks, patches);
    };
    for (std::size_t n = 0; n < samples[0].size(); ++n) {
      std::array<double, 2> best{-1e300, -1e300};
      std::array<std::size_t, 2> who{};
      for (std::size_t field = 0; field < cell.ranks.size(); ++field) {
        const double value = samples[field][n];
        if (value > best[0]) {
          best = {value, best[0]};
          who = {field, who[0]};
        } else if (value > best[1]) {
          best[1] = value;
          who[1] = field;
        }
      }
      if (const std::pair<std::size_t, std::size_t> now = std::minmax(who[0], who[1]); now != pair.fields) {
        end_pair();
        pair = {now};
        pair.across = std::max(length(slope_of(difference(cell, pair))) / kSamples, kLeast);
      }
      const double share = std::min(1.0, 0.5 + (best[0] - best[1]) / pair.across);
      count.excess[cell.ranks.begin()[who[0]]] += share;
      count.excess[cell.ranks.begin()[who[1]]] += 1 - share;
      if (share < 1) pair.movable += cell.free / pair.across;
    }
    end_pair();
  }

  const LabelNodes& nodes_;
  const LabelValues& values_;
  const std::vector<float>& now_;
  const std::vector<bool>* held_;
  const FacetCut* cut_;
};

}  // namespace

std::uint32_t volume_key(LabelRank a, LabelRank b) {
  return std::uint32_t{std::min(a, b)} << 16 | std::max(a, b);
}

VolumeCount count_volumes(const CountedFields& counted) {
  return VolumeCounter(counted, nullptr).count();
}

VolumeCount count_volumes_of_facets(const CountedFields& counted, const Frame& frame, const FacetSizes& facets) {
  const FacetCut cut(frame, facets);
  return VolumeCounter(counted, &cut).count();
}

}  // namespace scantet
