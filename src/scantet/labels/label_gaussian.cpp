// One label after the other, each within its box: three passes of a kernel along the axes.
#include "scantet/labels/label_gaussian.h"

#include <algorithm>
#include <cmath>

#include "scantet/base/parallel.h"

namespace scantet {
namespace {

/// Nodes from low to high, both included.
struct NodeBox {
  std::array<int, 3> low{1, 1, 1};
  std::array<int, 3> high{};

  bool empty() const { return low[0] > high[0]; }
  std::size_t side(std::size_t axis) const { return static_cast<std::size_t>(high[axis] - low[axis]) + 1; }
  std::size_t count() const { return side(0) * side(1) * side(2); }
};

/// Symmetric weights from the middle outward, of sum 1 over both sides; those that reach across an image of so many
/// nodes are left out.
std::vector<float> kernel_of(double sigma, int nodes) {
  constexpr double kReach = 3.5;
  std::vector<double> weights;
  double sum = 0;
  for (int n = 0; n <= std::ceil(kReach * sigma); ++n) {
    if (n > nodes + 1) break;
    weights.push_back(sigma > 0 ? std::exp(-0.5 * n * n / (sigma * sigma)) : 1);
    sum += (n == 0 ? 1 : 2) * weights.back();
  }
  std::vector<float> kernel;
  kernel.reserve(weights.size());
  for (const double weight : weights) kernel.push_back(static_cast<float>(weight / sum));
  return kernel;
}

class Blur {
 public:
  Blur(const LabelNodes& nodes, std::size_t ranks, const std::array<double, 3>& sigma) : nodes_(nodes), boxes_(ranks) {
    for (std::size_t axis = 0; axis < 3; ++axis) kernels_[axis] = kernel_of(sigma[axis], nodes.size()[axis]);
    find_boxes();
  }

  /// Hands on the shares of the label where they are not 0.
  void for_each_row_of(LabelRank rank, const ShareRow& act) {
    const NodeBox& box = boxes_[rank];
    if (box.empty()) return;
    shares_.assign(box.count(), 0);
    for_each_row(box, [&](int j, int k, std::size_t first) {
      for (int i = box.low[0]; i <= box.high[0]; ++i) {
        shares_[first++] = nodes_.at(i, j, k) == rank ? 1.0F : 0.0F;
      }
    });
    for (std::size_t axis = 0; axis < 3; ++axis) pass(box, axis);
    for_each_row(box, [&](int j, int k, std::size_t first) {
      act(box.low[0], j, k, std::span<const float>(shares_).subspan(first, box.side(0)));
    });
  }

 private:
  void find_boxes() {
    const auto& size = nodes_.size();
    for (int k = 0; k < size[2]; ++k) {
      for (int j = 0; j < size[1]; ++j) {
        for (int i = 0; i < size[0]; ++i) {
          const LabelRank rank = nodes_.at(i, j, k);
          if (rank == 0) continue;
          NodeBox& box = boxes_[rank];
          const std::array<int, 3> node{i, j, k};
          const bool first = box.empty();
          for (std::size_t axis = 0; axis < 3; ++axis) {
            box.low[axis] = first ? node[axis] : std::min(box.low[axis], node[axis]);
            box.high[axis] = first ? node[axis] : std::max(box.high[axis], node[axis]);
          }
        }
      }
    }
    for (NodeBox& box : boxes_) {
      if (box.empty()) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const int reach = static_cast<int>(kernels_[axis].size()) - 1;
        box.low[axis] = std::max(-1, box.low[axis] - reach);
        box.high[axis] = std::min(size[axis], box.high[axis] + reach);
      }
    }
  }

  /// act(j, k, place of the row's first node in shares_).
  template <class Act>
  void for_each_row(const NodeBox& box, const Act& act) const {
    constexpr std::size_t kRows = 64;
    parallel_for(box.side(1) * box.side(2), kRows, [&](std::size_t begin, std::size_t end) {
      for (std::size_t row = begin; row < end; ++row) {
        act(box.low[1] + static_cast<int>(row % box.side(1)), box.low[2] + static_cast<int>(row / box.side(1)),
            row * box.side(0));
      }
    });
  }

  void pass(const NodeBox& box, std::size_t axis) {
    const std::vector<float>& kernel = kernels_[axis];
    if (kernel.size() < 2) return;
    const std::size_t stride = axis == 0 ? 1 : axis == 1 ? box.side(0) : box.side(0) * box.side(1);
    const auto along = static_cast<std::ptrdiff_t>(box.side(axis));
    passed_.resize(shares_.size());
    constexpr std::size_t kNodes = 16384;
    parallel_for(shares_.size(), kNodes, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) {
        const auto at = static_cast<std::ptrdiff_t>(n / stride % box.side(axis));
        float sum = kernel[0] * shares_[n];
        for (std::size_t step = 1; step < kernel.size(); ++step) {
          const auto offset = static_cast<std::ptrdiff_t>(step);
          if (at - offset >= 0) sum += kernel[step] * shares_[n - step * stride];
          if (at + offset < along) sum += kernel[step] * shares_[n + step * stride];
        }
        passed_[n] = sum;
      }
    });
    shares_.swap(passed_);
  }

  const LabelNodes& nodes_;
  std::array<std::vector<float>, 3> kernels_;
  std::vector<NodeBox> boxes_;  // by rank: the nodes in its reach
  std::vector<float> shares_;   // of the label that is looked at
  std::vector<float> passed_;
};

}  // namespace

SharedLabels blur_labels(const LabelNodes& nodes, std::size_t ranks, const std::array<double, 3>& sigma,
                         const Progress& progress) {
  Blur blur(nodes, ranks, sigma);
  return share_labels(
      nodes.size(), ranks, [&](LabelRank rank, const ShareRow& act) { blur.for_each_row_of(rank, act); }, progress);
}

}  // namespace scantet
