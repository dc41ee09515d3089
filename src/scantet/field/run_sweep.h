// Labels the nodes of a padded grid run by run, layer by layer, holding no more than three layers.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "scantet/base/union_find.h"
#include "scantet/field/height_grid.h"

namespace scantet {

/// Which nodes of one layer are inside. Row r holds the nodes with j = r - 1, position p of it those with i = p - 1.
struct SignLayer {
  int words = 0;                     ///< of each row's signs
  int width = 0;                     ///< positions in a row
  int rows = 0;                      ///< with the padding's
  std::vector<std::uint64_t> signs;  ///< bit p of a row is set: inside
  std::vector<std::uint8_t> some;    ///< of each row: whether any bit is set

  SignLayer() = default;
  explicit SignLayer(const HeightGrid& grid)
      : words(grid.row_words()),
        width(grid.size()[0] + 2),
        rows(grid.size()[1] + 2),
        signs(static_cast<std::size_t>(words) * rows),
        some(rows) {}

  void read_row(const HeightGrid& grid, int row, int k) {
    std::uint64_t* row_begin = signs.data() + static_cast<std::size_t>(row) * words;
    const bool had_some = some[row];
    some[row] = grid.row_signs(row - 1, k, row_begin);
    if (had_some && !some[row]) std::fill_n(row_begin, words, 0);
  }
  const std::uint64_t* row_signs(int row) const { return signs.data() + static_cast<std::size_t>(row) * words; }
};

/// Label of the nodes that are joined to the padding as far as the sweep has seen.
inline constexpr std::uint32_t kUnboundedLabel = 0;

/// One layer of nodes as runs along x: maximal stretches of nodes above the level, below it, or at it. The first and
/// the last of a row are below (the padding sees to that).
struct RunLayer : SignLayer {
  explicit RunLayer(const HeightGrid& grid) : SignLayer(grid), reached(grid) {}

  SignLayer reached;       ///< which nodes are at the level or above it
  bool has_zeros = false;  ///< whether some are at the level

  std::vector<std::uint32_t> row_begin;  ///< first run of each row, and the end
  std::vector<std::int32_t> start;       ///< first position of each run
  std::vector<std::int8_t> side;         ///< of each run: 1 above, -1 below, 0 at the level
  std::vector<std::uint32_t> label;  ///< of each run; labels of one component may differ; kUnboundedLabel at the level

  std::int32_t end_of(int row, std::uint32_t run) const {
    return run + 1 < row_begin[row + 1] ? start[run + 1] : width;
  }
  /// The label of node (i, j) of the layer.
  std::uint32_t label_at(int i, int j) const;
};

/// Goes through the layers k = first … last, within -1 … size[2]. Two sweeps of the same layers give the same labels,
/// so that one sweep can use what another has found out about them.
class RunSweep {
 public:
  RunSweep(const HeightGrid& grid, int first, int last);

  /// Moves on to the next layer and labels its runs; false after the last layer. `sets`, if given, gets every new
  /// label, and unites the labels of nodes that an edge of the grid joins, both above the level or both below it. It
  /// must hold kUnboundedLabel before the first call.
  bool advance(UnionFind* sets);

  /// Index of the layer that advance() made; then that layer, and the one and the two before it.
  int k() const { return k_; }
  const RunLayer& layer(int back = 0) const { return layers_[(k_ + 4 - back) % 3]; }

 private:
  bool find_zeros(int j);
  void add_row(RunLayer& layer, int row);
  void link(RunLayer& layer, int row, const RunLayer& other, int other_row, UnionFind* sets) const;

  const HeightGrid& grid_;
  std::array<std::vector<std::uint64_t>, 5> zeros_;  // of rows, scratch
  std::array<RunLayer, 3> layers_;
  int first_;
  int last_;
  int k_;
  std::uint32_t next_label_ = kUnboundedLabel + 1;
};

}  // namespace scantet
