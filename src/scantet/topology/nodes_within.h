// Which nodes of a grid lie within a closed surface.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scantet/base/frame.h"
#include "scantet/base/triangle_surface.h"

namespace scantet {

/// A bit for each node of a grid, rows along x in words of their own.
class NodeBits {
 public:
  /// All clear. size: nodes along each axis.
  explicit NodeBits(const std::array<int, 3>& size);

  int words() const { return words_; }
  const std::array<int, 3>& size() const { return size_; }
  /// Node i of a row is bit (i + 1) % 64 of word (i + 1) / 64, as in HeightGrid::row_signs().
  const std::uint64_t* row(int j, int k) const { return bits_.data() + begin_of(j, k); }
  std::uint64_t* row(int j, int k) { return bits_.data() + begin_of(j, k); }

 private:
  std::size_t begin_of(int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size_[1]) + static_cast<std::size_t>(j)) *
           static_cast<std::size_t>(words_);
  }

  std::array<int, 3> size_;
  int words_;
  std::vector<std::uint64_t> bits_;
};

/// The nodes that lines along x reach from outside through an odd number of facets. Each line is moved aside by next to
/// nothing, so that it meets no edge; a node on the surface may count either way. On all threads.
/// surface: closed, that is each edge has an even number of facets; parts beyond the grid do not matter. frame: of the
/// grid's indices.
NodeBits nodes_within(const TriangleSurface& surface, const Frame& frame, const std::array<int, 3>& size);

}  // namespace scantet
