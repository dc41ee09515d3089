#include "scantet/domain/grid_parts.h"

#include "scantet/base/union_find.h"
#include "scantet/domain/run_joiner.h"

namespace scantet {

GridParts find_parts(const RegionGrid& grid) {
  const RunRows rows(grid.runs, grid.size);
  const auto same_part = [](const GridRun& a, const GridRun& b) { return a.part == b.part; };
  const auto same_region = [&](const GridRun& a, const GridRun& b) {
    return grid.parts[a.part].region == grid.parts[b.part].region;
  };
  GridParts parts;
  join_runs(rows, Reach::axes, same_region).number_sets(parts.joined);
  join_runs(rows, Reach::corners, same_part).number_sets(parts.pieces);
  UnionFind touching = join_runs(rows, Reach::corners, same_region);
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
  const auto all_may = [](const GridRun&, const GridRun&) { return true; };
  const std::uint32_t count = join_runs(RunRows(gaps.runs, grid.size), Reach::corners, all_may).number_sets(set);
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
