// Private: the cells that a search has met.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "scantet/delaunay/triangulation_impl.h"

namespace scantet::engine {

/// A set of cells that is emptied often. It stays in the cache of the thread that searches; marks at the cells
/// themselves would send their cache lines to and fro between the threads.
class CellSet {
 public:
  CellSet() : slots_(std::size_t{1} << kFirstBits, 0) {}

  void clear() {
    count_ = 0;
    search_ += std::uint64_t{1} << 32;
    if (search_ != 0) return;
    slots_.assign(slots_.size(), 0);
    search_ = std::uint64_t{1} << 32;
  }
  bool contains(CellId c) const { return slots_[slot_of(c)] == (search_ | c); }
  /// Pre: the cell is not in it.
  void insert(CellId c) {
    if (2 * ++count_ > slots_.size()) grow();
    slots_[slot_of(c)] = search_ | c;
  }

 private:
  static constexpr unsigned kFirstBits = 7;

  /// The slot where the cell is or would be.
  std::size_t slot_of(CellId c) const {
    std::size_t slot = c * 0x9e3779b1U >> shift_;  // Fibonacci hashing, with linear probing
    while (slots_[slot] != (search_ | c) && slots_[slot] >= search_) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  void grow() {
    const std::vector<std::uint64_t> before = std::exchange(slots_, std::vector<std::uint64_t>(2 * slots_.size(), 0));
    --shift_;
    for (const std::uint64_t entry : before) {
      if (entry >= search_) slots_[slot_of(static_cast<CellId>(entry))] = entry;
    }
  }

  std::vector<std::uint64_t> slots_;  // the number of the search that put a cell there, then the cell
  std::size_t count_ = 0;
  std::uint64_t search_ = std::uint64_t{1} << 32;  // greater than the numbers of earlier searches
  unsigned shift_ = 32 - kFirstBits;
};

}  // namespace scantet::engine
