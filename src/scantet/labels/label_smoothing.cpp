// Each label has a field on a band of nodes: those of the cells where it meets others, and the six neighbours of these.
// The fields minimise their bending energy there, the sum of the squared second differences, under the constraint that
// at each node the value of its own label exceeds every other one by a margin. Nothing else fixes the scale: a field of
// large slope costs nothing where its interface can be flat, so nodes near to an interface do not bend it. As the
// margin is the same on both sides, thin sheets keep their thickness. (The squared Laplacian will not do: on a thin
// band waves of any length cost nothing, as there are harmonic ones.)
//
// The quadratic program is solved by projected gradients with Nesterov's momentum. Long waves, above all the slope
// itself, would come slowly; so it starts from means over neighbours, many times steeper than the margin asks for, and
// takes a fixed number of steps. Short waves, and with them thin parts, are settled by then.
#include "scantet/labels/label_smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "scantet/base/large_pages.h"
#include "scantet/base/neighbors.h"
#include "scantet/base/parallel.h"
#include "scantet/labels/label_margins.h"
#include "scantet/labels/label_volumes.h"
#include "scantet/labels/rank_set.h"

namespace scantet {
namespace {

constexpr std::size_t kPiece = 8192;  // nodes
constexpr float kMargin = 2;
constexpr float kStep = 1.0F / 144;  // over the largest eigenvalue of the squared second differences
constexpr int kSteps = 100;
constexpr int kStartSweeps = 20;   // of means over neighbours
constexpr float kStartScale = 48;  // how much steeper the fields start than the margin asks for

/// Labels of nodes, ascending at each.
struct RankLists {
  std::vector<std::uint32_t> first;  ///< of each node, one more at the end
  std::vector<LabelRank> ranks;

  std::span<const LabelRank> of(std::size_t node) const {
    return std::span(ranks).subspan(first[node], first[node + 1] - first[node]);
  }
};

/// ranks_of(n): a RankSet, of the n-th node.
template <class RanksOf>
RankLists list_ranks(std::size_t nodes, const RanksOf& ranks_of) {
  RankLists lists;
  lists.first.assign(nodes + 1, 0);
  lists.ranks =
      parallel_collect<LabelRank>(nodes, kPiece, [&](std::size_t begin, std::size_t end, std::vector<LabelRank>& out) {
        for (std::size_t n = begin; n < end; ++n) {
          const RankSet ranks = ranks_of(n);
          lists.first[n + 1] = static_cast<std::uint32_t>(ranks.size());
          out.insert(out.end(), ranks.begin(), ranks.end());
        }
      });
  std::partial_sum(lists.first.begin(), lists.first.end(), lists.first.begin());
  return lists;
}

class Smoothing {
 public:
  explicit Smoothing(const LabelNodes& nodes) : nodes_(nodes), inner_(nodes.size()), band_(nodes.size()) {
    find_band();
    find_entries();
    find_neighbors();
  }

  void solve(const Progress& progress);
  /// To be called last.
  LabelValues result();

 private:
  void find_band();
  void find_entries();
  void find_neighbors();
  std::uint32_t entry_of(const std::array<int, 3>& node, LabelRank rank) const;
  RankSet ranks_around(const std::array<int, 3>& node) const;
  bool in_grid(const std::array<int, 3>& node) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (node[axis] < -1 || node[axis] > nodes_.size()[axis]) return false;
    }
    return true;
  }
  void start();
  void find_bends();
  float slope(std::uint32_t entry) const;
  void descend(float momentum);
  void project(std::size_t node, LargeVector<float>& values) const;

  const LabelNodes& nodes_;
  NodeSet inner_;  // of cells where labels meet
  NodeSet band_;
  RankLists around_;                                     // by inner node: its label and those of the 26 around it
  std::vector<std::size_t> positions_;                   // of the band
  std::vector<std::uint32_t> first_;                     // entry of each node of the band, one more at the end
  std::vector<LabelRank> ranks_;                         // by entry
  std::vector<std::uint32_t> own_;                       // by node, its own label's entry
  LargeVector<std::array<std::uint32_t, 6>> neighbors_;  // by entry: entries of the same label, or none_
  std::uint32_t none_ = 0;                               // an entry more than there are, which stays 0
  LargeVector<float> x_;
  LargeVector<float> before_;
  LargeVector<float> ahead_;
  LargeVector<std::array<float, 6>> bends_;  // by entry: second differences along x, y, z, and across xy, yz, zx
};

void Smoothing::find_band() {
  for (int layer = -1; layer < nodes_.size()[2]; ++layer) {
    for_each_mixed_cell(nodes_, layer, [&](int i, int j, int k) {
      for (int c = 0; c < 8; ++c) inner_.insert(inner_.position(i + c % 2, j + c / 2 % 2, k + c / 4));
    });
  }
  inner_.number();
  for (const std::size_t position : inner_.positions()) {
    band_.insert(position);
    for (int direction = 0; direction < 6; ++direction) {
      const std::array<int, 3> node = axis_neighbor(inner_.node_at(position), direction);
      if (in_grid(node)) band_.insert(band_.position(node[0], node[1], node[2]));
    }
  }
  band_.number();
  positions_ = band_.positions();
}

/// The labels of a node of a mixed cell and of the 26 nodes around it.
RankSet Smoothing::ranks_around(const std::array<int, 3>& node) const {
  RankSet ranks;
  for (const NeighborOffset& offset : kNeighborhood) {
    const std::array<int, 3> there{node[0] + offset[0], node[1] + offset[1], node[2] + offset[2]};
    ranks.insert(in_grid(there) ? nodes_.at(there[0], there[1], there[2]) : LabelRank{0});
  }
  return ranks;
}

void Smoothing::find_entries() {
  const std::vector<std::size_t> inner = inner_.positions();
  around_ = list_ranks(inner.size(), [&](std::size_t n) { return ranks_around(inner_.node_at(inner[n])); });
  RankLists lists = list_ranks(positions_.size(), [&](std::size_t n) {
    RankSet ranks;
    const auto insert_those_around = [&](std::size_t position) {
      if (!inner_.holds(position)) return;
      for (const LabelRank rank : around_.of(inner_.number_of(position))) ranks.insert(rank);
    };
    insert_those_around(positions_[n]);
    const std::array<int, 3> node = band_.node_at(positions_[n]);
    for (int direction = 0; direction < 6; ++direction) {
      const std::array<int, 3> there = axis_neighbor(node, direction);
      if (in_grid(there)) insert_those_around(inner_.position(there[0], there[1], there[2]));
    }
    return ranks;
  });
  first_ = std::move(lists.first);
  ranks_ = std::move(lists.ranks);
}

void Smoothing::find_neighbors() {
  none_ = static_cast<std::uint32_t>(ranks_.size());
  own_.resize(positions_.size());
  neighbors_.resize(ranks_.size() + 1);
  neighbors_.back().fill(none_);
  x_.resize(ranks_.size() + 1);
  x_.back() = 0;
  parallel_for(positions_.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const std::array<int, 3> node = band_.node_at(positions_[n]);
      const LabelRank own = nodes_.at(node[0], node[1], node[2]);
      for (std::uint32_t entry = first_[n]; entry < first_[n + 1]; ++entry) {
        x_[entry] = ranks_[entry] == own ? kMargin / 2 : -kMargin / 2;
        if (ranks_[entry] == own) own_[n] = entry;
        for (int direction = 0; direction < 6; ++direction) {
          neighbors_[entry][static_cast<std::size_t>(direction)] =
              entry_of(axis_neighbor(node, direction), ranks_[entry]);
        }
      }
    }
  });
}

/// The entry of a label at a node, or none_.
std::uint32_t Smoothing::entry_of(const std::array<int, 3>& node, LabelRank rank) const {
  if (!in_grid(node)) return none_;
  const std::size_t position = band_.position(node[0], node[1], node[2]);
  if (!band_.holds(position)) return none_;
  const std::size_t n = band_.number_of(position);
  for (std::uint32_t entry = first_[n]; entry < first_[n + 1]; ++entry) {
    if (ranks_[entry] == rank) return entry;
  }
  return none_;
}

/// Means over neighbours, steeper than the margin asks for: what is slow to come from the margin alone.
void Smoothing::start() {
  ahead_ = x_;
  for (int sweep = 0; sweep < kStartSweeps; ++sweep) {
    parallel_for(ranks_.size(), 8 * kPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin; e < end; ++e) {
        float sum = 2 * x_[e];
        float weight = 2;
        for (const std::uint32_t neighbor : neighbors_[e]) {
          sum += x_[neighbor];
          weight += neighbor == none_ ? 0 : 1;
        }
        ahead_[e] = sum / weight;
      }
    });
    x_.swap(ahead_);
  }
  for (float& x : x_) x *= kStartScale;
  parallel_for(positions_.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) project(n, x_);
  });
}

void Smoothing::solve(const Progress& progress) {
  start();
  before_ = x_;
  ahead_ = x_;
  bends_.resize(x_.size());
  bends_.back().fill(0);
  double t = 1;
  for (int step = 0; step < kSteps && !progress.cancelled(); ++step) {
    find_bends();
    const double next = (1 + std::sqrt(1 + 4 * t * t)) / 2;
    descend(static_cast<float>((t - 1) / next));
    t = next;
  }
  ahead_ = x_;
  find_bends();
}

/// Of ahead_.
void Smoothing::find_bends() {
  constexpr auto kCross = static_cast<float>(std::numbers::sqrt2);  // as xy and yx are alike
  parallel_for(ranks_.size(), 8 * kPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const std::array<std::uint32_t, 6>& around = neighbors_[e];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t low = around[2 * axis];
        const std::uint32_t high = around[2 * axis + 1];
        const bool whole = low != none_ && high != none_;
        bends_[e][axis] = whole ? ahead_[low] + ahead_[high] - 2 * ahead_[e] : 0;
        const std::uint32_t beside = around[2 * ((axis + 1) % 3) + 1];
        const std::uint32_t across = neighbors_[high][2 * ((axis + 1) % 3) + 1];
        const bool face = high != none_ && beside != none_ && across != none_;
        bends_[e][3 + axis] = face ? kCross * (ahead_[e] + ahead_[across] - ahead_[high] - ahead_[beside]) : 0;
      }
    }
  });
}

/// Half the slope of the energy at an entry.
float Smoothing::slope(std::uint32_t e) const {
  constexpr auto kCross = static_cast<float>(std::numbers::sqrt2);
  const std::array<std::uint32_t, 6>& around = neighbors_[e];
  const std::array<float, 6>& here = bends_[e];
  float slope = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t low = around[2 * axis];
    const std::size_t beside = 2 * ((axis + 1) % 3);
    const std::array<float, 6>& below = bends_[low];
    slope += below[axis] + bends_[around[2 * axis + 1]][axis] - 2 * here[axis];
    slope += kCross * (here[3 + axis] - below[3 + axis] - bends_[around[beside]][3 + axis] +
                       bends_[neighbors_[low][beside]][3 + axis]);
  }
  return slope;
}

/// A step down from ahead_ to x_, and what was x_ to before_; ahead_ gets ahead of x_ by as much of that.
void Smoothing::descend(float momentum) {
  before_.swap(x_);
  parallel_for(positions_.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      for (std::uint32_t e = first_[n]; e < first_[n + 1]; ++e) x_[e] = ahead_[e] - kStep * slope(e);
      project(n, x_);
      for (std::uint32_t e = first_[n]; e < first_[n + 1]; ++e) ahead_[e] = x_[e] + momentum * (x_[e] - before_[e]);
    }
  });
}

/// Moves the values at a node to the nearest ones that keep its label. The own value rises to a mean with those too
/// large, which fall. The mean is found by Newton's method from below, so those too large become fewer each time.
void Smoothing::project(std::size_t node, LargeVector<float>& values) const {
  const std::uint32_t begin = first_[node];
  const std::uint32_t end = first_[node + 1];
  const std::uint32_t own = own_[node];
  float level = values[own];
  for (std::size_t last = end - begin;;) {
    float sum = values[own];
    std::size_t above = 0;
    for (std::uint32_t e = begin; e < end; ++e) {
      if (e == own || values[e] + kMargin <= level) continue;
      sum += values[e] + kMargin;
      ++above;
    }
    if (above == 0 || above >= last) break;  // rounding may not let it fall
    level = sum / static_cast<float>(1 + above);
    last = above;
  }
  for (std::uint32_t e = begin; e < end; ++e) {
    if (e != own && values[e] + kMargin > level) values[e] = level - kMargin;
  }
  values[own] = level;
}

/// What cells need: the values at inner nodes of the labels around them, for a margin of 1, and how they bend.
LabelValues Smoothing::result() {
  const std::vector<std::size_t> inner = inner_.positions();
  LabelValues out;
  out.values.resize(around_.ranks.size());
  out.bends.resize(around_.ranks.size());
  parallel_for(inner.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      std::uint32_t e = first_[band_.number_of(inner[n])];
      for (std::uint32_t place = around_.first[n]; place < around_.first[n + 1]; ++place, ++e) {
        while (ranks_[e] != around_.ranks[place]) ++e;
        out.values[place] = x_[e] / kMargin;
        out.bends[place] = {bends_[e][0] / kMargin, bends_[e][1] / kMargin, bends_[e][2] / kMargin};
      }
    }
  });
  out.nodes = std::move(inner_);
  out.first = std::move(around_.first);
  out.ranks = std::move(around_.ranks);
  return out;
}

}  // namespace

LabelValues smooth_labels(const LabelNodes& nodes, const Progress& progress) {
  LabelValues values;
  {
    Smoothing smoothing(nodes);
    smoothing.solve(progress);
    if (progress.cancelled()) return {};
    values = smoothing.result();
  }
  keep_volumes(nodes, values);
  keep_margins(nodes, values);
  return values;
}

}  // namespace scantet
