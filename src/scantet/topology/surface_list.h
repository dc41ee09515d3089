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
    if (first) last_ = {-1, 0};
    if (side != 0) {
      if (side != last_.side) add(side > 0 ? last_.part : part, side > 0 ? part : last_.part);
      last_ = {side, part};
    }
    if (last && last_.side > 0) add(0, last_.part);
  }

  /// Takes in those of another list, with the same numbers.
  void add(const SurfaceList& other) { pairs_.insert(other.pairs_.begin(), other.pairs_.end()); }

  /// number_of(part): its new number.
  template <class NumberOf>
  void renumber(const NumberOf& number_of) {
    std::unordered_set<std::uint64_t> pairs;
    for (const std::uint64_t pair : pairs_) {
      pairs.insert(key(number_of(static_cast<std::uint32_t>(pair >> 32)), number_of(static_cast<std::uint32_t>(pair))));
    }
    pairs_ = std::move(pairs);
    newest_ = kNone;
  }

  /// How many surfaces each of the parts has. None if they do not part space like the edges of a tree its nodes, as
  /// closed surfaces do: where nodes at the level lie between runs, a pair may be none of neighbours.
  std::vector<std::uint32_t> count(std::size_t parts) const {
    if (pairs_.size() + 1 != parts) return {};
    std::vector<std::uint32_t> counts(parts);
    for (const std::uint64_t pair : pairs_) {
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
  void add(std::uint32_t outside, std::uint32_t inside) {
    if (key(outside, inside) == newest_) return;
    newest_ = key(outside, inside);
    pairs_.insert(newest_);
  }

  struct Run {
    int side = -1;
    std::uint32_t part = 0;
  };
  Run last_;
  std::uint64_t newest_ = kNone;
  std::unordered_set<std::uint64_t> pairs_;
};

}  // namespace scantet
