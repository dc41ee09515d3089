// The runs of a grid, row by row.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "scantet/domain/region_grid.h"

namespace scantet {

/// Where the runs of each row begin. A row is the nodes of one j and one k; rows are numbered in the order of the runs.
class RunRows {
 public:
  /// runs: ascending by k, j and begin, and not empty; they must outlive this. size: nodes along each axis.
  RunRows(const std::vector<GridRun>& runs, const std::array<int, 3>& size)
      : runs_(runs), rows_(static_cast<std::size_t>(size[1])), layers_(static_cast<std::size_t>(size[2])) {
    begin_.assign(rows_ * layers_ + 1, 0);
    for (const GridRun& run : runs) ++begin_[row(run.j, run.k) + 1];
    for (std::size_t n = 1; n < begin_.size(); ++n) begin_[n] += begin_[n - 1];
  }

  const std::vector<GridRun>& runs() const { return runs_; }
  int rows() const { return static_cast<int>(rows_); }      ///< of a layer
  int layers() const { return static_cast<int>(layers_); }  ///< of the grid
  std::size_t row(int j, int k) const { return static_cast<std::size_t>(k) * rows_ + static_cast<std::size_t>(j); }
  std::size_t begin(std::size_t row) const { return begin_[row]; }
  std::size_t end(std::size_t row) const { return begin_[row + 1]; }

  /// The run that has node i of a row, if there is one.
  std::optional<std::size_t> find(int i, std::size_t row) const {
    const auto first = runs_.begin() + static_cast<std::ptrdiff_t>(begin(row));
    const auto last = runs_.begin() + static_cast<std::ptrdiff_t>(end(row));
    const auto found = std::upper_bound(first, last, i, [](int at, const GridRun& run) { return at < run.end; });
    if (found == last || found->begin > i) return std::nullopt;
    return static_cast<std::size_t>(found - runs_.begin());
  }
  /// The run that has a node; one must.
  std::size_t run_at(int i, int j, int k) const {
    const std::optional<std::size_t> found = find(i, row(j, k));
    assert(found);
    return *found;
  }

 private:
  const std::vector<GridRun>& runs_;
  std::size_t rows_;
  std::size_t layers_;
  std::vector<std::size_t> begin_;  // of each row its first run; one more at the end
};

}  // namespace scantet
