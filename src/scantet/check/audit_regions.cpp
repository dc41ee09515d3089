// Each tet is asked which nodes of the grid lie in it, row by row: a row crosses it along one stretch, between the four
// planes of its faces. What is within rounding of a face counts for the tets on both sides: a node is lost only if it
// is clearly nowhere in its region, and one of kOutside only if it is clearly within a tet.
#include <atomic>
#include <cmath>

#include "scantet/check/audit_impl.h"

namespace scantet::auditing {
namespace {

constexpr double kRounding = 1e-9;  // voxels

/// One bit for each node of the grid, which any number of threads may set.
class NodeBits {
 public:
  explicit NodeBits(std::size_t count) : words_((count + 63) / 64) {}
  void set(std::size_t node) {
    std::atomic_ref<std::uint64_t>(words_[node / 64])
        .fetch_or(std::uint64_t{1} << node % 64, std::memory_order_relaxed);
  }
  bool test(std::size_t node) const { return words_[node / 64] >> node % 64 & 1; }

 private:
  std::vector<std::uint64_t> words_;
};

/// The nodes that are where they should not be, or where they should.
class NodeCheck {
 public:
  explicit NodeCheck(const RegionGrid& grid) : grid_(grid), found_(extent(0) * extent(1) * extent(2)) {
    row_begin_.assign(extent(1) * extent(2) + 1, 0);
    for (const GridRun& run : grid.runs) ++row_begin_[row(run.j, run.k) + 1];
    for (std::size_t n = 1; n < row_begin_.size(); ++n) row_begin_[n] += row_begin_[n - 1];
  }

  /// Marks nodes of the tet's region in it, and nodes of kOutside.
  void mark(const TetMesh& mesh, std::size_t tet) {
    std::array<Vec, 4> p;
    for (std::size_t n = 0; n < 4; ++n) p[n] = grid_.frame.to_index(mesh.vertices[mesh.tets[tet][n]]);
    Planes planes;
    if (!find_planes(p, planes)) return;
    Box box;
    for (const Vec& corner : p) box.extend(corner);
    const auto first = [&](int axis) { return std::max(0, static_cast<int>(std::ceil(box.min[axis] - kRounding))); };
    const auto last = [&](int axis) {
      return std::min(grid_.size[static_cast<std::size_t>(axis)] - 1,
                      static_cast<int>(std::floor(box.max[axis] + kRounding)));
    };
    for (int k = first(2); k <= last(2); ++k) {
      for (int j = first(1); j <= last(1); ++j) mark_row(planes, first(0), last(0), j, k, mesh.tet_regions[tet]);
    }
  }

  /// Whether the node is in a tet of its region; of kOutside, in none.
  bool is_kept(int i, int j, int k, Region region) const {
    return found_.test(row(j, k) * extent(0) + static_cast<std::size_t>(i)) == (region != kOutside);
  }

 private:
  /// Unit normals inward, and where they are 0.
  struct Planes {
    std::array<Vec, 4> normals;
    std::array<double, 4> offsets{};
  };
  static bool find_planes(const std::array<Vec, 4>& p, Planes& planes) {
    for (std::size_t n = 0; n < 4; ++n) {
      const Vec& a = p[(n + 1) % 4];
      Vec normal = cross(p[(n + 2) % 4] - a, p[(n + 3) % 4] - a);
      const double size = length(normal);
      if (!(size > 0)) return false;
      normal = (1 / size) * normal;
      if (dot(normal, p[n] - a) < 0) normal = -1.0 * normal;
      planes.normals[n] = normal;
      planes.offsets[n] = -dot(normal, a);
    }
    return true;
  }

  void mark_row(const Planes& planes, int first, int last, int j, int k, Region region) {
    const std::size_t at = row(j, k);
    std::size_t run = row_begin_[at];
    for (int i = first; i <= last; ++i) {
      double depth = std::numeric_limits<double>::infinity();
      for (std::size_t n = 0; n < 4; ++n) {
        depth = std::min(depth, dot(planes.normals[n], Vec{double(i), double(j), double(k)}) + planes.offsets[n]);
      }
      if (depth < -kRounding) continue;
      while (run < row_begin_[at + 1] && grid_.runs[run].end <= i) ++run;
      const bool outside = run == row_begin_[at + 1] || grid_.runs[run].begin > i;
      const Region there = outside ? kOutside : grid_.parts[grid_.runs[run].part].region;
      if (outside ? depth > kRounding : there == region) found_.set(at * extent(0) + static_cast<std::size_t>(i));
    }
  }

  std::size_t extent(std::size_t axis) const { return static_cast<std::size_t>(grid_.size[axis]); }
  std::size_t row(int j, int k) const { return static_cast<std::size_t>(k) * extent(1) + static_cast<std::size_t>(j); }

  const RegionGrid& grid_;
  std::vector<std::size_t> row_begin_;  // of each row its first run; one more at the end
  NodeBits found_;
};

/// Adds nodes (begin, j, k) to (end - 1, j, k), all of the region. Return: how many are kept.
std::uint64_t count_nodes(const NodeCheck& check, const RegionGrid& grid, const GridRun& run, KeptRegion& region) {
  std::uint64_t kept = 0;
  for (int i = run.begin; i < run.end; ++i) {
    if (check.is_kept(i, run.j, run.k, region.grid.region)) {
      ++kept;
    } else if (region.lost.size() < kMostLostNodes) {
      region.lost.push_back(grid.frame.to_world({double(i), double(run.j), double(run.k)}));
    }
  }
  region.kept += kept;
  return kept;
}

/// Calls act(run) for the nodes of each row that no run has.
template <class Act>
void for_each_gap(const RegionGrid& grid, const Act& act) {
  std::size_t run = 0;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      int begin = 0;
      for (; run < grid.runs.size() && grid.runs[run].j == j && grid.runs[run].k == k; ++run) {
        act(GridRun{j, k, begin, grid.runs[run].begin, 0});
        begin = grid.runs[run].end;
      }
      act(GridRun{j, k, begin, grid.size[0], 0});
    }
  }
}

}  // namespace

void check_regions(const TetMesh& mesh, const RegionGrid& grid, AuditReport& report) {
  NodeCheck check(grid);
  constexpr std::size_t kPiece = 4096;
  parallel_for(mesh.tets.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t tet = begin; tet < end; ++tet) check.mark(mesh, tet);
  });
  RegionLedger ledger;
  ledger.regions.emplace_back();
  for (const GridRegion& region : grid.regions) ledger.regions.push_back({region, 0, 0, {}});
  const auto entry = [&](Region region) -> KeptRegion& {
    return *std::lower_bound(ledger.regions.begin(), ledger.regions.end(), region,
                             [](const KeptRegion& kept, Region wanted) { return kept.grid.region < wanted; });
  };
  std::vector<std::uint64_t> kept(grid.parts.size());
  for (const GridPart& part : grid.parts) ++entry(part.region).parts;
  for (const GridRun& run : grid.runs) {
    kept[run.part] += count_nodes(check, grid, run, entry(grid.parts[run.part].region));
  }
  for_each_gap(grid, [&](const GridRun& gap) {
    ledger.regions.front().grid.nodes += static_cast<std::uint64_t>(gap.end - gap.begin);
    count_nodes(check, grid, gap, ledger.regions.front());
  });
  Tally lost("audit.lost_label");
  for (std::size_t n = 0; n < kept.size(); ++n) {
    if (kept[n] > 0) continue;
    const GridPart& part = grid.parts[n];
    ledger.lost.push_back(part);
    lost.hit(grid.frame.to_world({double(part.node[0]), double(part.node[1]), double(part.node[2])}), [&] {
      return std::to_string(part.nodes) + (part.nodes == 1 ? " voxel" : " voxels") + " of " +
             region_name(mesh, part.region);
    });
  }
  record(lost, report);
  report.region_ledger = std::move(ledger);
}

}  // namespace scantet::auditing
