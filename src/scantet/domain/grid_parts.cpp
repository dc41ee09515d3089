// Runs of neighbouring rows are compared by a walk along both. Nodes touch if their indices differ by 1 at most along
// each axis; of a row, the four rows before it that may touch it are looked at.
#include "scantet/domain/grid_parts.h"

#include <array>
#include <span>
#include <utility>

#include "scantet/base/union_find.h"

namespace scantet {
namespace {

enum class Reach { axes, corners };

class RunJoiner {
 public:
  RunJoiner(const std::vector<GridRun>& runs, const std::array<int, 3>& size)
      : runs_(runs), rows_(size[1]), layers_(size[2]) {
    row_begin_.assign(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(layers_) + 1, 0);
    for (const GridRun& run : runs) ++row_begin_[row(run.j, run.k) + 1];
    for (std::size_t n = 1; n < row_begin_.size(); ++n) row_begin_[n] += row_begin_[n - 1];
  }

  /// same(a, b): whether two runs may be of one set.
  template <class Same>
  UnionFind join(Reach reach, const Same& same) const {
    static constexpr std::array<std::pair<int, int>, 4> kBefore{{{-1, 0}, {0, -1}, {-1, -1}, {1, -1}}};
    const std::span<const std::pair<int, int>> before(kBefore.data(), reach == Reach::axes ? 2 : kBefore.size());
    const std::int32_t across = reach == Reach::axes ? 0 : 1;
    UnionFind sets(runs_.size());
    for (int k = 0; k < layers_; ++k) {
      for (int j = 0; j < rows_; ++j) {
        join_in_row(row(j, k), same, sets);
        for (const auto& [dj, dk] : before) {
          if (j + dj < 0 || j + dj >= rows_ || k + dk < 0) continue;
          join_rows(row(j, k), row(j + dj, k + dk), across, same, sets);
        }
      }
    }
    return sets;
  }

 private:
  std::size_t row(int j, int k) const {
    return static_cast<std::size_t>(k) * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(j);
  }

  template <class Same>
  void join_in_row(std::size_t row, const Same& same, UnionFind& sets) const {
    for (std::size_t a = row_begin_[row] + 1; a < row_begin_[row + 1]; ++a) {
      if (runs_[a - 1].end == runs_[a].begin && same(runs_[a - 1], runs_[a])) unite(a - 1, a, sets);
    }
  }

  template <class Same>
  void join_rows(std::size_t row, std::size_t other, std::int32_t across, const Same& same, UnionFind& sets) const {
    std::size_t b = row_begin_[other];
    for (std::size_t a = row_begin_[row]; a < row_begin_[row + 1]; ++a) {
      while (b < row_begin_[other + 1] && runs_[b].end + across <= runs_[a].begin) ++b;
      for (std::size_t c = b; c < row_begin_[other + 1] && runs_[c].begin < runs_[a].end + across; ++c) {
        if (same(runs_[a], runs_[c])) unite(a, c, sets);
      }
    }
  }

  static void unite(std::size_t a, std::size_t b, UnionFind& sets) {
    sets.unite(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
  }

  const std::vector<GridRun>& runs_;
  int rows_;
  int layers_;
  std::vector<std::size_t> row_begin_;  // of each row its first run; one more at the end
};

}  // namespace

GridParts find_parts(const RegionGrid& grid) {
  const RunJoiner joiner(grid.runs, grid.size);
  const auto same_part = [](const GridRun& a, const GridRun& b) { return a.part == b.part; };
  const auto same_region = [&](const GridRun& a, const GridRun& b) {
    return grid.parts[a.part].region == grid.parts[b.part].region;
  };
  GridParts parts;
  joiner.join(Reach::axes, same_region).number_sets(parts.joined);
  joiner.join(Reach::corners, same_part).number_sets(parts.pieces);
  UnionFind touching = joiner.join(Reach::corners, same_region);
  std::vector<std::int64_t> first(grid.parts.size(), -1);
  for (std::size_t n = 0; n < grid.runs.size(); ++n) {
    std::int64_t& of_part = first[grid.runs[n].part];
    if (of_part < 0) of_part = static_cast<std::int64_t>(n);
    touching.unite(static_cast<std::uint32_t>(of_part), static_cast<std::uint32_t>(n));
  }
  touching.number_sets(parts.touching);
  return parts;
}

GridGaps find_gaps(const RegionGrid& grid) {
  GridGaps gaps;
  std::size_t run = 0;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      std::int32_t begin = 0;
      const auto put = [&](std::int32_t end) {
        if (begin < end) gaps.runs.push_back({j, k, begin, end, 0});
      };
      for (; run < grid.runs.size() && grid.runs[run].j == j && grid.runs[run].k == k; ++run) {
        put(grid.runs[run].begin);
        begin = grid.runs[run].end;
      }
      put(grid.size[0]);
    }
  }
  std::vector<std::uint32_t> set;
  const std::uint32_t count = RunJoiner(gaps.runs, grid.size)
                                  .join(Reach::corners, [](const GridRun&, const GridRun&) { return true; })
                                  .number_sets(set);
  gaps.is_bounded.assign(count, 1);
  for (std::size_t n = 0; n < gaps.runs.size(); ++n) {
    GridRun& gap = gaps.runs[n];
    gap.part = set[n];
    const bool is_at_border = gap.begin == 0 || gap.end == grid.size[0] || gap.j == 0 || gap.j + 1 == grid.size[1] ||
                              gap.k == 0 || gap.k + 1 == grid.size[2];
    if (is_at_border) gaps.is_bounded[gap.part] = 0;
  }
  return gaps;
}

}  // namespace scantet
