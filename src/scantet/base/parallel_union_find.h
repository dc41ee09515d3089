// Disjoint sets that several threads join at once.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "scantet/base/parallel.h"

namespace scantet {

/// As UnionFind, for labels that several threads unite and look for at the same time: the smallest label stands for its
/// set, so the outcome depends neither on the order of the unions nor on the threads. A root is linked to a smaller one
/// by one exchange, or the union begins again (Anderson and Woll, Wait-free parallel algorithms for the union-find
/// problem, 1991).
class ParallelUnionFind {
 public:
  /// Labels 0 … count - 1, each in a set of its own.
  explicit ParallelUnionFind(std::size_t count) : parent_(count) {
    constexpr std::size_t kGrain = 65'536;
    parallel_for(count, kGrain, [&](std::size_t begin, std::size_t end) {
      std::iota(parent_.begin() + static_cast<std::ptrdiff_t>(begin),
                parent_.begin() + static_cast<std::ptrdiff_t>(end), static_cast<std::uint32_t>(begin));
    });
  }

  std::size_t size() const { return parent_.size(); }
  /// Whether the label stands for its set. Others may look for theirs meanwhile, but not unite any.
  bool is_root(std::uint32_t label) { return at(label).load(std::memory_order_relaxed) == label; }

  /// The smallest label of the set, as far as it has been united by now.
  std::uint32_t find(std::uint32_t label) {
    while (true) {
      std::uint32_t parent = at(label).load(std::memory_order_relaxed);
      if (parent == label) return label;
      const std::uint32_t above = at(parent).load(std::memory_order_relaxed);
      if (above != parent) at(label).compare_exchange_weak(parent, above, std::memory_order_relaxed);
      label = above;
    }
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    while (true) {
      a = find(a);
      b = find(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      std::uint32_t root = a;
      if (at(a).compare_exchange_strong(root, b, std::memory_order_relaxed)) return;
    }
  }

 private:
  std::atomic_ref<std::uint32_t> at(std::uint32_t label) { return std::atomic_ref(parent_[label]); }

  std::vector<std::uint32_t> parent_;  // never above the label itself
};

}  // namespace scantet
