// Which parts of a level set's two sides have a surface between them.
#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

namespace scantet {

/// The surfaces of a level set as pairs of the parts that they lie between, found where runs of nodes along x follow
/// each other: a closed surface is crossed by the line from a node within it to infinity.
class SurfaceList {
 public:
  /// Takes the next run of a row. first, last: it is that of the row; side: 1 above the level, -1 below it, 0 at it;
  /// part: of that side, 0 the unbounded outside.
  void add_run(bool first, bool last, int side, std::uint32_t part) {
    if (first) last_ = {-1, 0, false};
    if (side == 0) {
      last_.at_level = true;
    } else {
      if (side != last_.side) {
        const std::uint64_t pair = side > 0 ? key(last_.part, part) : key(part, last_.part);
        if (last_.at_level) {
          doubtful_.insert(pair);
        } else {
          add(pair);
        }
      }
      last_ = {side, part, false};
    }
    if (last && last_.side > 0) (last_.at_level ? doubtful_ : pairs_).insert(key(0, last_.part));
  }

  /// Takes in those of another list, with the same numbers.
  void add(const SurfaceList& other) {
    pairs_.insert(other.pairs_.begin(), other.pairs_.end());
    doubtful_.insert(other.doubtful_.begin(), other.doubtful_.end());
  }

  /// number_of(part): its new number.
  template <class NumberOf>
  void renumber(const NumberOf& number_of) {
    for (std::unordered_set<std::uint64_t>* pairs : {&pairs_, &doubtful_}) {
      std::unordered_set<std::uint64_t> renumbered;
      for (const std::uint64_t pair : *pairs) {
        const std::uint32_t outside = number_of(static_cast<std::uint32_t>(pair >> 32));
        renumbered.insert(key(outside, number_of(static_cast<std::uint32_t>(pair))));
      }
      *pairs = std::move(renumbered);
    }
    newest_ = kNone;
  }

  /// How many surfaces each of the parts has. Closed surfaces part space like the edges of a tree its nodes; none if
  /// these do not: where nodes at the level lie between two runs, those need not be neighbours.
  std::vector<std::uint32_t> count(std::size_t parts) const {
    std::unordered_set<std::uint64_t> pairs = pairs_;
    if (pairs.size() + 1 < parts) pairs.insert(doubtful_.begin(), doubtful_.end());
    if (pairs.size() + 1 != parts) return {};
    std::vector<std::uint32_t> counts(parts);
    for (const std::uint64_t pair : pairs) {
      ++counts[pair >> 32];
      ++counts[static_cast<std::uint32_t>(pair)];
    }
    return counts;
  }

 private:
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};

  static std::uint64_t key(std::uint32_t outside, std::uint32_t inside) {
    return std::uint64_t{outside} << 32 | inside;
  }
  void add(std::uint64_t pair) {
    if (pair != newest_) pairs_.insert(pair);
    newest_ = pair;
  }

  struct Run {
    int side = -1;
    std::uint32_t part = 0;
    bool at_level = false;  // nodes at the level have come since
  };
  Run last_;
  std::uint64_t newest_ = kNone;
  std::unordered_set<std::uint64_t> pairs_;
  std::unordered_set<std::uint64_t> doubtful_;  // with nodes at the level between the runs
};

}  // namespace scantet
