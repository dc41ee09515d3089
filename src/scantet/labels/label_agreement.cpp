// Volumes are counted by samples in the cells where labels meet. Each stands for a cube, of which the label with the
// second largest value has a share if the two are close: so thin sheets along the grid, whose surfaces all lie
// between the same samples, have their volume, too. The shares tell how much volume a small change of the values moves:
// that gives each label's next number, a dozen times.
//
// On a face the largest field is at least the mean of the face's labels. So a label that is at none of the face's
// corners is not the largest if it does not exceed that mean at any corner.
#include "scantet/labels/label_agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "scantet/base/parallel.h"
#include "scantet/base/trilinear.h"
#include "scantet/labels/rank_set.h"

namespace scantet {
namespace {

constexpr std::size_t kPiece = 8192;  // nodes

/// Volumes of labels in the cells where labels meet, in samples.
struct VolumeCount {
  std::vector<double> excess;   ///< by label: samples that it has more than its nodes' shares
  std::vector<double> movable;  ///< samples that it would have more if its values were larger by 1, to first order

  explicit VolumeCount(std::size_t ranks) : excess(ranks), movable(ranks) {}
};

constexpr std::size_t kSamples = 3;  // a cell along each axis

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

/// By how much the difference of two fields changes across the cube of a sample, at the cell's centre.
double change_across(const CellHeights& a, const CellHeights& b) {
  constexpr double kLeast = 1e-3;  // of the margin
  Vec gradient;
  for (std::size_t c = 0; c < a.size(); ++c) {
    const double share = (a[c] - b[c]) / 4;
    for (int axis = 0; axis < 3; ++axis) gradient[axis] += (c >> axis & 1) != 0 ? share : -share;
  }
  return std::max(length(gradient) / kSamples, kLeast);
}

void count_cell(const LabelValues& values, const std::array<LabelRank, 8>& corners, int i, int j, int k,
                const std::vector<double>& added, VolumeCount& count) {
  constexpr double kShare = kSamples * kSamples * kSamples / 8.0;
  RankSet ranks;
  for (const LabelRank rank : corners) {
    ranks.insert(rank);
    count.excess[rank] -= kShare;
  }
  std::array<CellHeights, 8> fields;
  for (int c = 0; c < 8; ++c) {
    const std::size_t position = values.nodes.position(i + c % 2, j + c / 2 % 2, k + c / 4);
    CellHeights* field = fields.data();
    for (const LabelRank rank : ranks) {
      (*field++)[static_cast<std::size_t>(c)] = values.at(position, rank) + added[rank];
    }
  }
  std::array<SampleValues, 8> samples;
  for (std::size_t at = 0; at < ranks.size(); ++at) samples[at] = values_at_samples(fields[at]);
  std::pair<std::size_t, std::size_t> pair{};  // of the fields that `across` is of
  double across = 0;
  for (std::size_t n = 0; n < samples[0].size(); ++n) {
    std::array<double, 2> best{-1e300, -1e300};
    std::array<std::size_t, 2> who{};
    for (std::size_t at = 0; at < ranks.size(); ++at) {
      const double value = samples[at][n];
      if (value > best[0]) {
        best = {value, best[0]};
        who = {at, who[0]};
      } else if (value > best[1]) {
        best[1] = value;
        who[1] = at;
      }
    }
    const std::array<LabelRank, 2> rank{ranks.begin()[who[0]], ranks.begin()[who[1]]};
    if (const std::pair<std::size_t, std::size_t> now = std::minmax(who[0], who[1]); now != pair) {
      pair = now;
      across = change_across(fields[who[0]], fields[who[1]]);
    }
    const double share = std::min(1.0, 0.5 + (best[0] - best[1]) / across);
    count.excess[rank[0]] += share;
    count.excess[rank[1]] += 1 - share;
    if (share == 1) continue;
    for (const LabelRank r : rank) count.movable[r] += 1 / across;
  }
}

VolumeCount count_volumes(const LabelNodes& nodes, const LabelValues& values, const std::vector<double>& added) {
  constexpr std::size_t kLayers = 8;
  const auto layers = static_cast<std::size_t>(nodes.size()[2]) + 1;
  std::vector<VolumeCount> pieces((layers + kLayers - 1) / kLayers, VolumeCount(added.size()));
  parallel_for(layers, kLayers, [&](std::size_t begin, std::size_t end) {
    for (std::size_t layer = begin; layer < end; ++layer) {
      for_each_mixed_cell(nodes, static_cast<int>(layer) - 1, [&](int i, int j, int k) {
        count_cell(values, nodes.corners({i, j, k}), i, j, k, added, pieces[begin / kLayers]);
      });
    }
  });
  VolumeCount all(added.size());
  for (const VolumeCount& piece : pieces) {
    for (std::size_t n = 0; n < added.size(); ++n) {
      all.excess[n] += piece.excess[n];
      all.movable[n] += piece.movable[n];
    }
  }
  return all;
}

class FaceAgreement {
 public:
  FaceAgreement(const LabelNodes& nodes, LabelValues& values) : nodes_(nodes), values_(values) {}

  /// Return: how many values were lowered, each counted as often as it was.
  std::size_t run() {
    constexpr int kMostSweeps = 20;
    std::size_t all = 0;
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
      const std::size_t lowered = this->sweep();
      all += lowered;
      if (lowered == 0) break;
    }
    return all;
  }

 private:
  std::size_t sweep() {
    const std::vector<std::size_t> positions = values_.nodes.positions();
    std::vector<float> next = values_.values;
    std::vector<std::size_t> counts((positions.size() + kPiece - 1) / kPiece);
    parallel_for(positions.size(), kPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) {
        const std::uint32_t first = values_.first[n];
        const std::uint32_t last = values_.first[n + 1];
        if (last - first > 2) counts[begin / kPiece] += lower(values_.nodes.node_at(positions[n]), first, last, next);
      }
    });
    values_.values.swap(next);
    std::size_t all = 0;
    for (const std::size_t count : counts) all += count;
    return all;
  }

  /// Looks at the twelve faces around a node.
  std::size_t lower(const std::array<int, 3>& node, std::uint32_t first, std::uint32_t last,
                    std::vector<float>& next) const {
    std::size_t count = 0;
    for (std::size_t face = 0; face < 12; ++face) {
      const std::size_t u = (face / 4 + 1) % 3;
      const std::size_t v = (face / 4 + 2) % 3;
      std::array<int, 3> other = node;
      other[u] += face % 2 == 0 ? 1 : -1;
      other[v] += face % 4 < 2 ? 1 : -1;
      bool inside = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        inside = inside && other[axis] >= -1 && other[axis] <= nodes_.size()[axis];
      }
      if (!inside) continue;
      RankSet ranks;
      for (int corner = 0; corner < 4; ++corner) {
        std::array<int, 3> at = node;
        if (corner % 2 == 1) at[u] = other[u];
        if (corner / 2 == 1) at[v] = other[v];
        ranks.insert(nodes_.at(at[0], at[1], at[2]));
      }
      count += lower(ranks, first, last, next);
    }
    return count;
  }

  std::size_t lower(const RankSet& ranks, std::uint32_t first, std::uint32_t last, std::vector<float>& next) const {
    constexpr float kBelow = 1e-3F;
    if (ranks.size() < 2) return 0;
    float sum = 0;
    for (std::uint32_t e = first; e < last; ++e) sum += ranks.holds(values_.ranks[e]) ? values_.values[e] : 0;
    const float most = sum / static_cast<float>(ranks.size());
    std::size_t count = 0;
    for (std::uint32_t e = first; e < last; ++e) {
      if (ranks.holds(values_.ranks[e]) || next[e] <= most) continue;
      next[e] = most - kBelow;
      ++count;
    }
    return count;
  }

  const LabelNodes& nodes_;
  LabelValues& values_;
};

}  // namespace

void keep_volumes(const LabelNodes& nodes, LabelValues& values) {
  constexpr int kRounds = 12;
  constexpr double kMost = 0.25;
  constexpr double kCaution = 0.5;  // neighbours move as well
  if (values.ranks.empty()) return;
  const std::size_t ranks = std::size_t{*std::max_element(values.ranks.begin(), values.ranks.end())} + 1;
  std::vector<double> added(ranks);
  for (int round = 0; round < kRounds; ++round) {
    const VolumeCount count = count_volumes(nodes, values, added);
    for (std::size_t n = 0; n < ranks; ++n) {
      if (count.movable[n] == 0) continue;
      added[n] = std::clamp(added[n] - kCaution * count.excess[n] / count.movable[n], -kMost, kMost);
    }
  }
  for (std::size_t e = 0; e < values.values.size(); ++e) {
    values.values[e] += static_cast<float>(added[values.ranks[e]]);
  }
}

std::size_t agree_on_faces(const LabelNodes& nodes, LabelValues& values) {
  return FaceAgreement(nodes, values).run();
}

}  // namespace scantet
