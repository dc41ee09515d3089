// Each tet is asked which nodes of the grid lie in it, row by row: a row crosses it along one stretch, between the four
// planes of its faces. What is within rounding of a face counts for the tets on both sides: a node is lost only if it
// is clearly nowhere in its region, and one of kOutside only if it is clearly within a tet.
//
// A component of the mesh holds the nodes in its tets. Nodes that are neighbours along an axis must be in one; nodes of
// parts that do not even touch must not (grid_parts_impl.h).
#include <atomic>
#include <cmath>
#include <map>
#include <set>

#include "scantet/check/audit_impl.h"
#include "scantet/domain/grid_parts.h"
#include "scantet/domain/run_rows.h"

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

/// Which components of the mesh hold nodes of which sets of joined nodes, each with the first such node.
class Meetings {
 public:
  using Key = std::pair<std::uint32_t, std::uint32_t>;  // set, component

  void add(const Key& key, std::size_t node) {
    if (last_ == nullptr || last_->first != key) last_ = &*first_node_.emplace(key, node).first;
    last_->second = std::min(last_->second, node);
  }
  void add(const Meetings& others) {
    for (const auto& [key, node] : others.first_node_) add(key, node);
  }
  const std::map<Key, std::size_t>& all() const { return first_node_; }

 private:
  std::map<Key, std::size_t> first_node_;
  std::pair<const Key, std::size_t>* last_ = nullptr;
};

/// The nodes that are where they should not be, or where they should.
class NodeCheck {
 public:
  NodeCheck(const RegionGrid& grid, const GridParts& parts)
      : grid_(grid), parts_(parts), rows_(grid.runs, grid.size), found_(extent(0) * extent(1) * extent(2)) {}

  /// Marks nodes of the tet's region in it, and nodes of kOutside. component: of the tet.
  void mark(const TetMesh& mesh, std::size_t tet, std::uint32_t component, Meetings& meetings) {
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
      for (int j = first(1); j <= last(1); ++j) {
        mark_row(planes, first(0), last(0), j, k, mesh.tet_regions[tet], component, meetings);
      }
    }
  }

  /// Whether the node is in a tet of its region; of kOutside, in none.
  bool is_kept(int i, int j, int k, Region region) const {
    return found_.test(rows_.row(j, k) * extent(0) + static_cast<std::size_t>(i)) == (region != kOutside);
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

  void mark_row(const Planes& planes, int first, int last, int j, int k, Region region, std::uint32_t component,
                Meetings& meetings) {
    const std::size_t at = rows_.row(j, k);
    std::size_t run = rows_.begin(at);
    for (int i = first; i <= last; ++i) {
      double depth = std::numeric_limits<double>::infinity();
      for (std::size_t n = 0; n < 4; ++n) {
        depth = std::min(depth, dot(planes.normals[n], Vec{double(i), double(j), double(k)}) + planes.offsets[n]);
      }
      if (depth < -kRounding) continue;
      while (run < rows_.end(at) && grid_.runs[run].end <= i) ++run;
      const bool outside = run == rows_.end(at) || grid_.runs[run].begin > i;
      const Region there = outside ? kOutside : grid_.parts[grid_.runs[run].part].region;
      if (outside ? depth <= kRounding : there != region) continue;
      const std::size_t node = at * extent(0) + static_cast<std::size_t>(i);
      found_.set(node);
      if (!outside && component != kNone) meetings.add({parts_.joined[run], component}, node);
    }
  }

  std::size_t extent(std::size_t axis) const { return static_cast<std::size_t>(grid_.size[axis]); }

  const RegionGrid& grid_;
  const GridParts& parts_;
  RunRows rows_;
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

/// Parts of `grid` by the sets of its runs, each with its first node.
std::vector<GridPart> parts_by(const std::vector<std::uint32_t>& sets, const RegionGrid& grid) {
  std::vector<GridPart> parts;
  for (std::size_t n = 0; n < sets.size(); ++n) {
    const GridRun& run = grid.runs[n];
    if (sets[n] == parts.size()) parts.push_back({grid.parts[run.part].region, 0, {run.begin, run.j, run.k}});
    parts[sets[n]].nodes += static_cast<std::uint64_t>(run.end - run.begin);
  }
  return parts;
}

class RegionCheck {
 public:
  RegionCheck(const TetMesh& mesh, const RegionGrid& grid, AuditReport& report)
      : mesh_(mesh), grid_(grid), report_(report), parts_(find_parts(grid)), nodes_(grid, parts_) {
    ledger_.regions.emplace_back();
    for (const GridRegion& region : grid.regions) ledger_.regions.push_back({region, 0, 0, {}});
  }

  void run(const std::vector<std::uint32_t>& component_of) {
    constexpr std::size_t kPiece = 4096;
    std::vector<Meetings> pieces((mesh_.tets.size() + kPiece - 1) / kPiece);
    parallel_for(mesh_.tets.size(), kPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) nodes_.mark(mesh_, t, component_of[t], pieces[begin / kPiece]);
    });
    Meetings meetings;
    for (const Meetings& piece : pieces) meetings.add(piece);
    find_lost_parts();
    find_joined_parts(meetings);
    find_split_parts(meetings);
    find_lost_cavities();
    report_.region_ledger = std::move(ledger_);
  }

 private:
  void find_lost_parts() {
    const std::vector<GridPart> pieces = parts_by(parts_.pieces, grid_);
    std::vector<std::uint64_t> kept(pieces.size());
    for (const GridPart& piece : pieces) ++entry(piece.region).parts;
    for (std::size_t n = 0; n < grid_.runs.size(); ++n) {
      const GridRun& run = grid_.runs[n];
      kept[parts_.pieces[n]] += count_nodes(nodes_, grid_, run, entry(grid_.parts[run.part].region));
    }
    Tally lost("audit.lost_label");
    for (std::size_t n = 0; n < kept.size(); ++n) {
      if (kept[n] > 0) continue;
      ledger_.lost.push_back(pieces[n]);
      lost.hit(place_of(pieces[n]), [&] { return text_of(pieces[n]); });
    }
    record(lost, report_);
  }

  /// Components of the mesh with nodes of parts that do not touch.
  void find_joined_parts(const Meetings& meetings) {
    std::vector<std::uint32_t> touching_of;  // of sets of joined nodes
    for (std::size_t n = 0; n < grid_.runs.size(); ++n) {
      if (parts_.joined[n] == touching_of.size()) touching_of.push_back(parts_.touching[n]);
    }
    std::vector<std::set<std::uint32_t>> held(report_.components.size());
    const std::vector<GridPart> parts = parts_by(parts_.touching, grid_);
    Tally joined("audit.joined_label");
    for (const auto& [key, node] : meetings.all()) {
      std::set<std::uint32_t>& of_component = held[key.second];
      const std::uint32_t part = touching_of[key.first];
      if (!of_component.insert(part).second || of_component.size() == 1) continue;
      joined.hit(place_of(node), [&] {
        const std::uint32_t other = part == *of_component.begin() ? *of_component.rbegin() : *of_component.begin();
        return text_of(parts[part]) + ", with " + text_of(parts[other]);
      });
    }
    record(joined, report_);
  }

  /// Nodes that are neighbours along axes, in several components of the mesh.
  void find_split_parts(const Meetings& meetings) {
    const std::vector<GridPart> parts = parts_by(parts_.joined, grid_);
    Tally split("audit.split_label");
    const auto& all = meetings.all();
    for (auto first = all.begin(); first != all.end();) {
      const std::uint32_t part = first->first.first;
      const auto end = all.lower_bound({part + 1, 0});
      const auto count = std::distance(first, end);
      if (count > 1) {
        split.hit(place_of(std::next(first)->second),
                  [&] { return text_of(parts[part]) + " in " + std::to_string(count) + " parts of the mesh"; });
      }
      first = end;
    }
    record(split, report_);
  }

  /// Cavities none of whose nodes is outside the mesh; and those that are one in the mesh, or open.
  void find_lost_cavities() {
    const GridGaps gaps = find_gaps(grid_);
    std::vector<GridPart> cavities(gaps.is_bounded.size());
    std::vector<std::uint64_t> kept(cavities.size());
    KeptRegion& outside = ledger_.regions.front();
    for (const GridRun& gap : gaps.runs) {
      GridPart& cavity = cavities[gap.part];
      if (cavity.nodes == 0) cavity.node = {gap.begin, gap.j, gap.k};
      cavity.nodes += static_cast<std::uint64_t>(gap.end - gap.begin);
      outside.grid.nodes += static_cast<std::uint64_t>(gap.end - gap.begin);
      kept[gap.part] += count_nodes(nodes_, grid_, gap, outside);
    }
    Tally missing("audit.cavity_missing");
    std::uint64_t there = 0;
    Tally merged("audit.cavity_count");
    for (std::size_t n = 0; n < cavities.size(); ++n) {
      if (gaps.is_bounded[n] == 0) continue;
      if (kept[n] == 0) {
        missing.hit(place_of(cavities[n]), [&] { return "the one of " + counted_voxels(cavities[n].nodes); });
      } else if (++there > report_.cavities) {
        merged.hit(place_of(cavities[n]), [] { return std::string(); });
      }
    }
    merged.first = std::to_string(report_.cavities) + " in the mesh, " + std::to_string(there + missing.count) +
                   " in the label map";
    record(missing, report_);
    record(merged, report_);
  }

  KeptRegion& entry(Region region) {
    return *std::lower_bound(ledger_.regions.begin(), ledger_.regions.end(), region,
                             [](const KeptRegion& kept, Region wanted) { return kept.grid.region < wanted; });
  }

  static std::string counted_voxels(std::uint64_t nodes) {
    return std::to_string(nodes) + (nodes == 1 ? " voxel" : " voxels");
  }
  std::string text_of(const GridPart& part) const {
    return counted_voxels(part.nodes) + " of " + region_name(mesh_, part.region);
  }
  Point place_of(const GridPart& part) const {
    return grid_.frame.to_world({double(part.node[0]), double(part.node[1]), double(part.node[2])});
  }
  Point place_of(std::size_t node) const {
    const auto row = static_cast<std::size_t>(grid_.size[0]);
    const auto rows = static_cast<std::size_t>(grid_.size[1]);
    return grid_.frame.to_world({double(node % row), double(node / row % rows), double(node / row / rows)});
  }

  const TetMesh& mesh_;
  const RegionGrid& grid_;
  AuditReport& report_;
  GridParts parts_;
  NodeCheck nodes_;
  RegionLedger ledger_;
};

}  // namespace

void check_regions(const TetMesh& mesh, const std::vector<std::uint32_t>& component_of, const RegionGrid& grid,
                   AuditReport& report) {
  RegionCheck(mesh, grid, report).run(component_of);
}

}  // namespace scantet::auditing
