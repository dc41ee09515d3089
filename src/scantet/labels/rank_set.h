// The labels around a place.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>

#include "scantet/labels/label_nodes.h"

namespace scantet {

/// A few ranks, ascending: at most those of seven nodes and of all around these.
class RankSet {
 public:
  void insert(LabelRank rank) {
    auto* at = std::lower_bound(ranks_.begin(), ranks_.begin() + count_, rank);
    if (at != ranks_.begin() + count_ && *at == rank) return;
    assert(size() < ranks_.size());
    std::copy_backward(at, ranks_.begin() + count_, ranks_.begin() + count_ + 1);
    *at = rank;
    ++count_;
  }
  bool holds(LabelRank rank) const { return std::binary_search(begin(), end(), rank); }
  std::size_t size() const { return static_cast<std::size_t>(count_); }
  const LabelRank* begin() const { return ranks_.begin(); }
  const LabelRank* end() const { return ranks_.begin() + count_; }

 private:
  std::array<LabelRank, 7 * 27 + 1> ranks_;
  int count_ = 0;
};

}  // namespace scantet
