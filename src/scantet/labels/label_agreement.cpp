// On a face the largest field is at least the mean of the face's labels. So a label that is at none of the face's
// corners is not the largest if it does not exceed that mean at any corner. What is asked of a node hangs on the labels
// around it and on its own values alone.
#include "scantet/labels/label_agreement.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "scantet/base/parallel.h"
#include "scantet/labels/rank_set.h"

namespace scantet {
namespace {

constexpr std::size_t kPiece = 8192;  // nodes

class FaceAgreement {
 public:
  FaceAgreement(const LabelNodes& nodes, float below, LabelValues& values)
      : nodes_(nodes), below_(below), values_(values) {}

  /// Return: how many values were lowered, each counted as often as it was.
  std::size_t run() {
    const std::vector<std::size_t> positions = values_.nodes.positions();
    std::vector<std::size_t> counts((positions.size() + kPiece - 1) / kPiece);
    parallel_for(positions.size(), kPiece, [&](std::size_t begin, std::size_t end) {
      std::vector<float> next;
      for (std::size_t n = begin; n < end; ++n) {
        const std::size_t first = values_.first[n];
        const Entries entries{{values_.ranks.data() + first, values_.first[n + 1] - first},
                              {values_.values.data() + first, values_.first[n + 1] - first}};
        if (entries.ranks.size() <= 2) continue;
        counts[begin / kPiece] += settle(values_.nodes.node_at(positions[n]), entries, next);
      }
    });
    return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  }

 private:
  /// Of a node.
  struct Entries {
    std::span<const LabelRank> ranks;
    std::span<float> values;
  };

  /// Lowers the values of a node until it need not be done any more. next: memory to reuse.
  std::size_t settle(const std::array<int, 3>& node, const Entries& entries, std::vector<float>& next) const {
    constexpr int kMostSweeps = 20;
    std::size_t all = 0;
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
      next.assign(entries.values.begin(), entries.values.end());
      const std::size_t lowered = lower(node, entries, next);
      if (lowered == 0) break;
      std::copy(next.begin(), next.end(), entries.values.begin());
      all += lowered;
    }
    return all;
  }

  /// Looks at the twelve faces around a node.
  std::size_t lower(const std::array<int, 3>& node, const Entries& entries, std::vector<float>& next) const {
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
      count += lower(ranks, entries, next);
    }
    return count;
  }

  std::size_t lower(const RankSet& ranks, const Entries& entries, std::vector<float>& next) const {
    constexpr float kRounding = 1e-3F;  // of what a value is lowered by
    if (ranks.size() < 2) return 0;
    float sum = 0;
    for (std::size_t e = 0; e < next.size(); ++e) sum += ranks.holds(entries.ranks[e]) ? entries.values[e] : 0;
    const float most = sum / static_cast<float>(ranks.size()) - below_;
    std::size_t count = 0;
    for (std::size_t e = 0; e < next.size(); ++e) {
      if (ranks.holds(entries.ranks[e]) || next[e] <= most + kRounding * below_) continue;
      next[e] = most;
      ++count;
    }
    return count;
  }

  const LabelNodes& nodes_;
  float below_;
  LabelValues& values_;
};

}  // namespace

std::size_t agree_on_faces(const LabelNodes& nodes, float below, LabelValues& values) {
  return FaceAgreement(nodes, below, values).run();
}

}  // namespace scantet
