// Which runs of a grid hang together.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "scantet/base/union_find.h"
#include "scantet/domain/run_rows.h"

namespace scantet {

/// Which nodes may be joined: neighbours along an axis, or all that touch, whose indices differ by 1 at most along
/// each.
enum class Reach { axes, corners };

/// Joins runs of neighbouring rows by a walk along both. Of a row, the rows before it that may touch it are looked at:
/// two along axes, four of all.
template <class Same>
class RunJoiner {
 public:
  /// same(a, b): whether two runs that touch may be of one set.
  RunJoiner(const RunRows& rows, Reach reach, const Same& same)
      : rows_(rows), across_(reach == Reach::axes ? 0 : 1), same_(same), sets_(rows.runs().size()) {
    static constexpr std::array<std::pair<int, int>, 4> kBefore{{{-1, 0}, {0, -1}, {-1, -1}, {1, -1}}};
    const std::span<const std::pair<int, int>> before(kBefore.data(), reach == Reach::axes ? 2 : kBefore.size());
    for (int k = 0; k < rows.layers(); ++k) {
      for (int j = 0; j < rows.rows(); ++j) {
        join_in_row(rows.row(j, k));
        for (const auto& [dj, dk] : before) {
          if (j + dj < 0 || j + dj >= rows.rows() || k + dk < 0) continue;
          join_rows(rows.row(j, k), rows.row(j + dj, k + dk));
        }
      }
    }
  }

  /// The sets of the runs, by their indices.
  UnionFind take_sets() { return std::move(sets_); }

 private:
  void join_in_row(std::size_t row) {
    const auto& runs = rows_.runs();
    for (std::size_t a = rows_.begin(row) + 1; a < rows_.end(row); ++a) {
      if (runs[a - 1].end == runs[a].begin && same_(runs[a - 1], runs[a])) unite(a - 1, a);
    }
  }

  void join_rows(std::size_t row, std::size_t other) {
    const auto& runs = rows_.runs();
    std::size_t b = rows_.begin(other);
    for (std::size_t a = rows_.begin(row); a < rows_.end(row); ++a) {
      while (b < rows_.end(other) && runs[b].end + across_ <= runs[a].begin) ++b;
      for (std::size_t c = b; c < rows_.end(other) && runs[c].begin < runs[a].end + across_; ++c) {
        if (same_(runs[a], runs[c])) unite(a, c);
      }
    }
  }

  void unite(std::size_t a, std::size_t b) {
    sets_.unite(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
  }

  const RunRows& rows_;
  std::int32_t across_;
  const Same& same_;
  UnionFind sets_;
};

/// Sets of runs, by their indices. same(a, b): whether two runs that touch may be of one set.
template <class Same>
UnionFind join_runs(const RunRows& rows, Reach reach, const Same& same) {
  return RunJoiner<Same>(rows, reach, same).take_sets();
}

}  // namespace scantet
