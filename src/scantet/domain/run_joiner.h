// Which runs of a grid hang together.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "scantet/base/union_find.h"
#include "scantet/domain/run_rows.h"

namespace scantet {

/// Which nodes may be joined: neighbours along an axis, or all that touch, whose indices differ by 1 at most along
/// each.
enum class Reach { axes, corners };

/// Sets of runs, by their indices. same(a, b): whether two runs that touch may be of one set. Runs of two rows are
/// compared by a walk along both; of a row, the rows before it that may touch it are looked at: two along axes, four of
/// all.
template <class Same>
UnionFind join_runs(const RunRows& rows, Reach reach, const Same& same) {
  static constexpr std::array<std::pair<int, int>, 4> kBefore{{{-1, 0}, {0, -1}, {-1, -1}, {1, -1}}};
  const std::span<const std::pair<int, int>> before(kBefore.data(), reach == Reach::axes ? 2 : kBefore.size());
  const std::int32_t across = reach == Reach::axes ? 0 : 1;
  const std::vector<GridRun>& runs = rows.runs();
  UnionFind sets(runs.size());
  const auto join = [&](std::size_t a, std::size_t b) {
    if (same(runs[a], runs[b])) sets.unite(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
  };
  const auto join_rows = [&](std::size_t row, std::size_t other) {
    std::size_t b = rows.begin(other);
    for (std::size_t a = rows.begin(row); a < rows.end(row); ++a) {
      while (b < rows.end(other) && runs[b].end + across <= runs[a].begin) ++b;
      for (std::size_t c = b; c < rows.end(other) && runs[c].begin < runs[a].end + across; ++c) join(a, c);
    }
  };
  for (std::size_t n = 1; n < runs.size(); ++n) {
    const bool touch = runs[n - 1].k == runs[n].k && runs[n - 1].j == runs[n].j && runs[n - 1].end == runs[n].begin;
    if (touch) join(n - 1, n);
  }
  for (int k = 0; k < rows.layers(); ++k) {
    for (int j = 0; j < rows.rows(); ++j) {
      for (const auto& [dj, dk] : before) {
        if (j + dj < 0 || j + dj >= rows.rows() || k + dk < 0) continue;
        join_rows(rows.row(j, k), rows.row(j + dj, k + dk));
      }
    }
  }
  return sets;
}

}  // namespace scantet
