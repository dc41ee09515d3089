// Private: the facets of a few tets by their directed edges.
#pragma once

#include <array>
#include <cstdint>

#include "scantet/delaunay/triangulation_impl.h"

namespace scantet::engine {

/// The facets of a few tets by the directed edges between their vertices, which are numbered as they come. It is a
/// matrix that needs no clearing, because every edge that is asked for has been put in before.
class EdgeTable {
 public:
  using Number = std::uint8_t;
  static constexpr Number kMost = 32;  ///< vertices

  void clear() {
    vertices_.fill(kNone);
    count_ = 0;
  }
  /// The number of a vertex; kMost if there are too many.
  Number number_of(PointId v) {
    std::size_t slot = v * 0x9e3779b1U >> (32 - kSlotBits);  // Fibonacci hashing, with linear probing
    while (vertices_[slot] != v) {
      if (vertices_[slot] == kNone) {
        if (count_ == kMost) return kMost;
        vertices_[slot] = v;
        numbers_[slot] = count_++;
        break;
      }
      slot = (slot + 1) % kSlots;
    }
    return numbers_[slot];
  }
  FacetCode& facet(Number from, Number to) { return facets_[std::size_t{from} * kMost + to]; }

 private:
  static constexpr unsigned kSlotBits = 7;
  static constexpr std::size_t kSlots = std::size_t{1} << kSlotBits;
  std::array<PointId, kSlots> vertices_;
  std::array<Number, kSlots> numbers_;
  std::array<FacetCode, std::size_t{kMost} * kMost> facets_;
  Number count_ = 0;
};

}  // namespace scantet::engine
