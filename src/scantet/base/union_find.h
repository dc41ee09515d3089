// Disjoint sets of labels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace scantet {

/// Labels 0, 1, 2 … in disjoint sets. The smallest label stands for its set, so the outcome does not depend on the
/// order of the unions.
class UnionFind {
 public:
  UnionFind() = default;
  /// Labels 0 … count - 1, each in a set of its own.
  explicit UnionFind(std::size_t count) {
    while (parent_.size() < count) add();
  }

  /// Adds a label, one more than the last, in a set of its own.
  void add() { parent_.push_back(size()); }
  std::uint32_t size() const { return static_cast<std::uint32_t>(parent_.size()); }

  /// The smallest label of the set.
  std::uint32_t find(std::uint32_t label) {
    while (parent_[label] != label) label = parent_[label] = parent_[parent_[label]];
    return label;
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a < b) {
      parent_[b] = a;
    } else {
      parent_[a] = b;
    }
  }

  /// Numbers the sets 0, 1, 2 … by their smallest label. Return: number of sets, and the number of each label's set in
  /// `numbers`. The object is empty afterwards: its memory becomes the answer.
  std::uint32_t number_sets(std::vector<std::uint32_t>& numbers) {
    std::uint32_t count = 0;
    // A parent is never above its child, so it already holds its set's number when the child is reached.
    for (std::uint32_t label = 0; label < size(); ++label) {
      parent_[label] = parent_[label] == label ? count++ : parent_[parent_[label]];
    }
    numbers = std::move(parent_);
    parent_.clear();
    return count;
  }

 private:
  std::vector<std::uint32_t> parent_;  // never above the label itself
};

}  // namespace scantet
