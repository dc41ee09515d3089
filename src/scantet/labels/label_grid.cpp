// Rows are cut into runs of one region, and neighbours along axes are joined (run_joiner.h). What an edge of the grid
// joins the field joins, too, as along an edge no other region's field is the largest between two nodes of one. Across
// faces and cells only the field can tell; there are few such cells.
#include "scantet/labels/label_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "scantet/base/parallel.h"
#include "scantet/base/union_find.h"
#include "scantet/domain/grid_parts.h"
#include "scantet/domain/run_joiner.h"

namespace scantet {
namespace {

constexpr std::size_t kLayers = 4;  // of the grid that a thread looks at in a piece

std::uint32_t index(std::size_t n) {
  return static_cast<std::uint32_t>(n);
}

/// The runs of all regions but kOutside.
std::vector<GridRun> find_runs(const LabelField& field) {
  const auto& size = field.size();
  std::vector<GridRun> runs;
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0];) {
        const LabelRank rank = field.nodes().at(i, j, k);
        const int begin = i;
        while (i < size[0] && field.nodes().at(i, j, k) == rank) ++i;
        if (rank != 0) runs.push_back({j, k, begin, i, 0});
      }
    }
  }
  return runs;
}

class PartFinder {
 public:
  explicit PartFinder(const LabelField& field)
      : field_(field), runs_(find_runs(field)), rows_(runs_, field.size()), sets_(joined_along_axes()) {}

  void find(RegionGrid& grid) {
    join_in_cells();
    number(grid);
  }

  /// The same of parts that are connected along axes.
  void find_along_axes(RegionGrid& grid) { number(grid); }

 private:
  void number(RegionGrid& grid) {
    std::vector<std::uint32_t> part_of;
    grid.parts.reserve(sets_.number_sets(part_of));
    for (std::size_t n = 0; n < runs_.size(); ++n) {
      GridRun& run = runs_[n];
      run.part = part_of[n];
      if (run.part == grid.parts.size()) grid.parts.push_back({region_of(run), 0, {run.begin, run.j, run.k}});
      grid.parts[run.part].nodes += static_cast<std::uint64_t>(run.end - run.begin);
    }
    grid.runs = std::move(runs_);
  }
  Region region_of(const GridRun& run) const { return field_.region_of_node(run.begin, run.j, run.k); }
  UnionFind joined_along_axes() const {
    return join_runs(rows_, Reach::axes,
                     [&](const GridRun& a, const GridRun& b) { return region_of(a) == region_of(b); });
  }

  void join_in_cells() {
    for (int k = 0; k + 1 < field_.size()[2]; ++k) {
      for_each_mixed_cell(field_.nodes(), k, [&](int i, int j, int) {
        const auto& size = field_.size();
        if (i < 0 || j < 0 || i + 1 >= size[0] || j + 1 >= size[1]) return;
        join_in_cell(i, j, k);
      });
    }
  }
  /// Joins corners of one region that are not joined yet.
  void join_in_cell(int i, int j, int k) {
    const std::array<LabelRank, 8> ranks = field_.nodes().corners({i, j, k});
    bool is_looked_at = false;
    for (unsigned a = 0; a < 8; ++a) {
      for (unsigned b = a + 1; b < 8; ++b) {
        if (ranks[a] != ranks[b] || ranks[a] == 0) continue;
        const std::uint32_t run_a = run_of_corner(i, j, k, a);
        const std::uint32_t run_b = run_of_corner(i, j, k, b);
        if (sets_.find(run_a) == sets_.find(run_b)) continue;
        if (!is_looked_at) look_at(i, j, k);
        is_looked_at = true;
        if (lattice_sets_.find(lattice_corner(a)) == lattice_sets_.find(lattice_corner(b))) sets_.unite(run_a, run_b);
      }
    }
  }
  std::uint32_t run_of_corner(int i, int j, int k, unsigned corner) const {
    return index(rows_.run_at(i + static_cast<int>(corner & 1), j + static_cast<int>(corner >> 1 & 1),
                              k + static_cast<int>(corner >> 2)));
  }

  static constexpr std::uint32_t kSteps = 8;
  static constexpr std::uint32_t kSide = kSteps + 1;
  static constexpr std::size_t kPoints = std::size_t{kSide} * kSide * kSide;
  static std::uint32_t lattice_corner(unsigned corner) {
    return ((corner >> 2) * kSteps * kSide + (corner >> 1 & 1) * kSteps) * kSide + (corner & 1) * kSteps;
  }
  /// Joins neighbours of one region on a lattice in the cell.
  void look_at(int i, int j, int k) {
    field_.cell(i, j, k, cell_);
    lattice_sets_ = UnionFind(kPoints);
    std::array<Region, kPoints> regions{};
    for (std::size_t n = 0; n < regions.size(); ++n) {
      const std::array<std::size_t, 3> at{n % kSide, n / kSide % kSide, n / kSide / kSide};
      regions[n] = cell_.region_at({static_cast<double>(at[0]) / kSteps, static_cast<double>(at[1]) / kSteps,
                                    static_cast<double>(at[2]) / kSteps});
      std::size_t stride = 1;
      for (const std::size_t coordinate : at) {
        if (coordinate > 0 && regions[n - stride] == regions[n]) lattice_sets_.unite(index(n), index(n - stride));
        stride *= kSide;
      }
    }
  }

  const LabelField& field_;
  std::vector<GridRun> runs_;
  RunRows rows_;
  UnionFind sets_;
  LabelCell cell_;
  UnionFind lattice_sets_{0};
};

/// Of each of the field's regions, in cells of the grid.
std::vector<double> field_volumes(const LabelField& field) {
  constexpr int kSamples = 6;  // a cell along each axis
  constexpr double kShare = 1.0 / (kSamples * kSamples * kSamples);
  const std::vector<Region>& regions = field.regions();
  const auto layers = static_cast<std::size_t>(field.size()[2]) + 1;
  std::vector<std::vector<double>> pieces((layers + kLayers - 1) / kLayers, std::vector<double>(regions.size()));
  parallel_for(layers, kLayers, [&](std::size_t begin, std::size_t end) {
    std::vector<double>& excess = pieces[begin / kLayers];  // over the nodes' shares
    LabelCell cell;
    for (std::size_t layer = begin; layer < end; ++layer) {
      for_each_mixed_cell(field.nodes(), static_cast<int>(layer) - 1, [&](int i, int j, int k) {
        for (const LabelRank rank : field.nodes().corners({i, j, k})) excess[rank] -= 1.0 / 8;
        field.cell(i, j, k, cell);
        std::array<int, 8> counts{};
        for (int n = 0; n < kSamples * kSamples * kSamples; ++n) {
          const Region at = cell.region_at({(n % kSamples + 0.5) / kSamples, (n / kSamples % kSamples + 0.5) / kSamples,
                                            (n / kSamples / kSamples + 0.5) / kSamples});
          ++counts[static_cast<std::size_t>(
              std::lower_bound(cell.regions.begin(), cell.regions.begin() + static_cast<std::ptrdiff_t>(cell.count),
                               at) -
              cell.regions.begin())];
        }
        for (std::size_t n = 0; n < cell.count; ++n) {
          const auto rank = std::lower_bound(regions.begin(), regions.end(), cell.regions[n]) - regions.begin();
          assert(static_cast<std::size_t>(rank) < regions.size() &&
                 regions[static_cast<std::size_t>(rank)] == cell.regions[n]);
          excess[static_cast<std::size_t>(rank)] += kShare * counts[n];
        }
      });
    }
  });
  std::vector<double> volumes(field.voxels().begin(), field.voxels().end());
  for (const std::vector<double>& piece : pieces) {
    for (std::size_t n = 0; n < volumes.size(); ++n) volumes[n] += piece[n];
  }
  return volumes;
}

}  // namespace

namespace {

/// The grid but for its parts and runs. volumes: of the field's regions, in voxels.
RegionGrid grid_with(const LabelField& field, const std::vector<double>& volumes) {
  RegionGrid grid;
  grid.frame = field.frame();
  grid.size = field.size();
  const double cell_mm3 = std::abs(field.frame().determinant_mm3());
  for (std::size_t n = 0; n < volumes.size(); ++n) {
    if (field.regions()[n] == kOutside || field.voxels()[n] == 0) continue;
    grid.regions.push_back({field.regions()[n], field.voxels()[n], volumes[n] * cell_mm3});
  }
  return grid;
}

/// Adds parts of kOutside, and their runs behind the others: those that do not come to the border of the grid.
void add_cavities(RegionGrid& grid) {
  const GridGaps gaps = find_gaps(grid);
  std::vector<std::uint32_t> part_of(gaps.is_bounded.size());
  for (std::size_t n = 0; n < part_of.size(); ++n) {
    part_of[n] = static_cast<std::uint32_t>(grid.parts.size());
    if (gaps.is_bounded[n] != 0) grid.parts.emplace_back();
  }
  for (GridRun gap : gaps.runs) {
    if (gaps.is_bounded[gap.part] == 0) continue;
    gap.part = part_of[gap.part];
    grid.parts[gap.part].nodes += static_cast<std::uint64_t>(gap.end - gap.begin);
    grid.runs.push_back(gap);
  }
}

}  // namespace

RegionGrid region_grid(const LabelField& field) {
  RegionGrid grid = grid_with(field, field_volumes(field));
  PartFinder(field).find(grid);
  return grid;
}

RegionGrid grid_of_voxels(const LabelField& field) {
  RegionGrid grid = grid_with(field, {field.voxels().begin(), field.voxels().end()});
  PartFinder(field).find_along_axes(grid);
  return grid;
}

std::vector<GridPart> small_parts(const LabelField& field, std::uint64_t most_nodes) {
  RegionGrid grid;
  grid.size = field.size();
  PartFinder(field).find_along_axes(grid);
  add_cavities(grid);
  std::vector<Vec> sums(grid.parts.size());
  std::vector<double> nearest(grid.parts.size(), std::numeric_limits<double>::infinity());
  const auto each_node = [&](const auto& visit) {
    for (const GridRun& run : grid.runs) {
      if (grid.parts[run.part].nodes > most_nodes) continue;
      for (int i = run.begin; i < run.end; ++i) visit(run.part, std::array<int, 3>{i, run.j, run.k});
    }
  };
  const auto index_of = [](const std::array<int, 3>& node) {
    return Vec{double(node[0]), double(node[1]), double(node[2])};
  };
  each_node([&](std::uint32_t part, const std::array<int, 3>& node) { sums[part] = sums[part] + index_of(node); });
  each_node([&](std::uint32_t part, const std::array<int, 3>& node) {
    const Vec centroid = (1.0 / static_cast<double>(grid.parts[part].nodes)) * sums[part];
    const double squared = squared_distance(index_of(node), centroid);
    if (squared >= nearest[part]) return;
    nearest[part] = squared;
    grid.parts[part].node = node;
  });
  std::erase_if(grid.parts, [&](const GridPart& part) { return part.nodes > most_nodes; });
  return std::move(grid.parts);
}

}  // namespace scantet
