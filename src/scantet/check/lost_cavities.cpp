// What the outside does not even touch by a corner must be a cavity of the mesh, and another one for each set of nodes
// that touch.
#include <algorithm>
#include <vector>

#include "scantet/check/lost_cavities_impl.h"

namespace scantet::auditing {
namespace {

/// A cavity of the grid, or a part of what is around all.
struct Cavity {
  GridPart part;
  std::uint64_t kept = 0;  ///< of its nodes
  bool is_seen = false;    ///< a node is clearly outside the mesh
  bool is_joined = false;  ///< one of these is in no cavity of the mesh, or in that of another of the grid
  Vec joined_at;           ///< that one
};

/// Looks at which cavities of the mesh nodes of one of the grid are in. owner: of the mesh's, that of the grid.
void find_owners(const GridRun& gap, const MeshCavities& found, const GridNodes& nodes, Cavity& cavity,
                 std::vector<std::uint32_t>& owner) {
  for (int i = gap.begin; i < gap.end && !cavity.is_joined; ++i) {
    if (!nodes.is_clearly_outside(i, gap.j, gap.k)) continue;
    cavity.is_seen = true;
    const std::uint32_t there = found.at(i, gap.j, gap.k);
    if (there != kNone && owner[there] == kNone) owner[there] = gap.part;
    cavity.is_joined = there == kNone || owner[there] != gap.part;
    cavity.joined_at = {double(i), double(gap.j), double(gap.k)};
  }
}

}  // namespace

void find_lost_cavities(const MeshCavities& found, const GridNodes& nodes, const RegionGrid& grid, KeptRegion& outside,
                        AuditReport& report) {
  const GridGaps gaps = find_gaps(grid);
  std::vector<Cavity> cavities(gaps.is_bounded.size());
  std::vector<std::uint32_t> owner(report.cavities, kNone);
  for (const GridRun& gap : gaps.runs) {
    Cavity& cavity = cavities[gap.part];
    if (cavity.part.nodes == 0) cavity.part.node = {gap.begin, gap.j, gap.k};
    cavity.part.nodes += static_cast<std::uint64_t>(gap.end - gap.begin);
    cavity.kept += count_nodes(nodes, grid, gap, outside);
    if (gaps.is_bounded[gap.part] != 0) find_owners(gap, found, nodes, cavity, owner);
  }
  for (const Cavity& cavity : cavities) outside.grid.nodes += cavity.part.nodes;
  auto spare = std::count(owner.begin(), owner.end(), kNone);
  Tally missing("audit.cavity_missing");
  Tally joined("audit.cavity_joined");
  for (std::size_t n = 0; n < cavities.size(); ++n) {
    const Cavity& cavity = cavities[n];
    if (gaps.is_bounded[n] == 0) continue;
    const auto text = [&] { return "the one of " + counted_voxels(cavity.part.nodes); };
    const Point place = world_place(grid, cavity.part.node);
    if (cavity.kept == 0) {
      missing.hit(place, text);
    } else if (cavity.is_joined) {
      joined.hit(grid.frame.to_world(cavity.joined_at), text);
    } else if (!cavity.is_seen && --spare < 0) {
      joined.hit(place, text);
    }
  }
  record(missing, report);
  record(joined, report);
}

}  // namespace scantet::auditing
