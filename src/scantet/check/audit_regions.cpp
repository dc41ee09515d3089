// A component of the mesh holds the nodes in its tets. Nodes that are neighbours along an axis must be in one; nodes of
// parts that do not even touch must not (grid_parts.h). So it is with cavities: what the outside does not even touch by
// a corner must be a cavity of the mesh, and another one for each set of nodes that touch.
#include <set>

#include "scantet/check/grid_nodes_impl.h"
#include "scantet/check/mesh_cavities_impl.h"

namespace scantet::auditing {
namespace {

/// Adds nodes (begin, j, k) to (end - 1, j, k), all of the region. Return: how many are kept.
std::uint64_t count_nodes(const GridNodes& nodes, const RegionGrid& grid, const GridRun& run, KeptRegion& region) {
  std::uint64_t kept = 0;
  for (int i = run.begin; i < run.end; ++i) {
    if (nodes.is_kept(i, run.j, run.k, region.grid.region)) {
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

/// A cavity of the grid, or a part of what is around all.
struct Cavity {
  GridPart part;
  std::uint64_t kept = 0;  ///< of its nodes
  bool is_seen = false;    ///< a node is clearly outside the mesh
  bool is_joined = false;  ///< one of these is in no cavity of the mesh, or in that of another of the grid
  Vec joined_at;           ///< that one
};

class RegionCheck {
 public:
  RegionCheck(const TetMesh& mesh, const RegionGrid& grid, AuditReport& report)
      : mesh_(mesh), grid_(grid), report_(report), parts_(find_parts(grid)), nodes_(mesh, grid, parts_) {
    ledger_.regions.emplace_back();
    for (const GridRegion& region : grid.regions) ledger_.regions.push_back({region, 0, 0, {}});
  }

  void run(const FaceMatch& match, const std::vector<std::uint32_t>& component_of, const OutsideSurfaces& outside) {
    const Meetings meetings = nodes_.find(match, component_of);
    find_lost_parts();
    find_joined_parts(meetings);
    find_split_parts(meetings);
    find_lost_cavities(MeshCavities(mesh_, match, outside, grid_.frame, report_));
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

  /// Cavities none of whose nodes is outside the mesh, and those that are not cavities of their own.
  void find_lost_cavities(const MeshCavities& found) {
    const GridGaps gaps = find_gaps(grid_);
    std::vector<Cavity> cavities(gaps.is_bounded.size());
    KeptRegion& outside = ledger_.regions.front();
    std::vector<std::uint32_t> owner(report_.cavities, kNone);
    for (const GridRun& gap : gaps.runs) {
      Cavity& cavity = cavities[gap.part];
      if (cavity.part.nodes == 0) cavity.part.node = {gap.begin, gap.j, gap.k};
      cavity.part.nodes += static_cast<std::uint64_t>(gap.end - gap.begin);
      cavity.kept += count_nodes(nodes_, grid_, gap, outside);
      if (gaps.is_bounded[gap.part] != 0) find_owners(gap, found, cavity, owner);
    }
    for (const Cavity& cavity : cavities) outside.grid.nodes += cavity.part.nodes;
    auto spare = std::count(owner.begin(), owner.end(), kNone);
    Tally missing("audit.cavity_missing");
    Tally joined("audit.cavity_joined");
    for (std::size_t n = 0; n < cavities.size(); ++n) {
      const Cavity& cavity = cavities[n];
      if (gaps.is_bounded[n] == 0) continue;
      const auto text = [&] { return "the one of " + counted_voxels(cavity.part.nodes); };
      if (cavity.kept == 0) {
        missing.hit(place_of(cavity.part), text);
      } else if (cavity.is_joined) {
        joined.hit(grid_.frame.to_world(cavity.joined_at), text);
      } else if (!cavity.is_seen && --spare < 0) {
        joined.hit(place_of(cavity.part), text);
      }
    }
    record(missing, report_);
    record(joined, report_);
  }

  /// Looks at which cavities of the mesh nodes of one of the grid are in. owner: of the mesh's, that of the grid.
  void find_owners(const GridRun& gap, const MeshCavities& found, Cavity& cavity,
                   std::vector<std::uint32_t>& owner) const {
    for (int i = gap.begin; i < gap.end && !cavity.is_joined; ++i) {
      if (!nodes_.is_clearly_outside(i, gap.j, gap.k)) continue;
      cavity.is_seen = true;
      const std::uint32_t there = found.at(i, gap.j, gap.k);
      if (there != kNone && owner[there] == kNone) owner[there] = gap.part;
      cavity.is_joined = there == kNone || owner[there] != gap.part;
      cavity.joined_at = {double(i), double(gap.j), double(gap.k)};
    }
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
  GridNodes nodes_;
  RegionLedger ledger_;
};

}  // namespace

void check_regions(const TetMesh& mesh, const FaceMatch& match, const std::vector<std::uint32_t>& component_of,
                   const OutsideSurfaces& outside, const RegionGrid& grid, AuditReport& report) {
  RegionCheck(mesh, grid, report).run(match, component_of, outside);
}

}  // namespace scantet::auditing
