// Around a vertex, tets of one side that are connected through faces form a group. The boundary is a disk there if and
// only if each side is one group: two connected sets that fill the sphere around the vertex share one closed curve.
#include <algorithm>
#include <cassert>

#include "scantet/base/tet_volume.h"
#include "scantet/surface/untangle_impl.h"

namespace scantet::engine {
namespace {

constexpr int kRounds = 20;
constexpr std::uint8_t kMostChanges = 2;

double volume_mm3(const Triangulation& t, CellId c) {
  if (t.has_corner(c)) return std::numeric_limits<double>::infinity();
  return tet_volume(t.points_of(c));
}

/// How many facets a piece shares with each region beside it.
using Neighbors = std::map<Region, int>;

/// The region that most of the facets lead to.
Region main_neighbor(const Neighbors& neighbors) {
  return std::max_element(neighbors.begin(), neighbors.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

/// A group of tets of one side around a vertex.
struct Group {
  std::vector<CellId> cells;
  double volume = 0;
  bool on_surface = true;
  Neighbors across;
};

/// Splits the star into its groups, which empties it.
std::vector<Group> groups_of(const Triangulation& t, PointId v, std::vector<CellId>& star) {
  std::vector<Group> groups;
  while (!star.empty()) {
    Group group;
    group.cells.push_back(star.back());
    star.pop_back();
    for (std::size_t done = 0; done < group.cells.size(); ++done) {
      const CellId c = group.cells[done];
      group.volume += volume_mm3(t, c);
      group.on_surface = group.on_surface && t.is_on_boundary(c);
      for (std::size_t i = 0; i < 4; ++i) {
        if (t.cell(c).vertex[i] == v) continue;
        const CellId next = t.cell(c).neighbor[i] / 4;
        if (t.info(next).region != t.info(c).region) {
          ++group.across[t.info(next).region];
          continue;
        }
        const auto found = std::find(star.begin(), star.end(), next);
        if (found == star.end()) continue;
        group.cells.push_back(next);
        *found = star.back();
        star.pop_back();
      }
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace

std::uint64_t Untangler::run() {
  for (int round = 0; round < kRounds; ++round) {
    const bool absorbed = knows_components_ && absorb_fragments();
    const bool mended = mend_pinches();
    if (!absorbed && !mended) break;
  }
  std::uint64_t changed = 0;
  for (CellId c = 0; c < changes_.size(); ++c) {
    changed += changes_[c].count > 0 && t_.is_cell(c) && changes_[c].generation == t_.info(c).generation ? 1 : 0;
  }
  return changed;
}

bool Untangler::turn_over(const std::vector<MisplacedGroup>& groups, std::int64_t missing) {
  bool changed = false;
  for (const MisplacedGroup& group : groups) {
    const std::int64_t left = missing - group.euler_change;
    double volume = 0;
    for (const CellId c : group.cells) volume += volume_mm3(t_, c);
    if (std::abs(left) >= std::abs(missing) || !is_small(volume, group.cells.front())) continue;
    bool has_turned = true;
    for (const CellId c : group.cells) has_turned = change(c, group.to) && has_turned;
    if (has_turned) missing = left;
    changed = true;
  }
  return changed;
}

bool Untangler::is_small(double volume_mm3, CellId c) const {
  if (!std::isfinite(volume_mm3)) return false;
  const double side = alpha_ * size_.size_at(t_.cell(c).circumcentre);
  return volume_mm3 < side * side * side;
}

bool Untangler::change(CellId c, Region region) {
  assert(t_.is_cell(c) && t_.info(c).region != region);
  if (changes_.size() <= c) changes_.resize(t_.cell_slots());
  Change& change = changes_[c];
  if (change.generation != t_.info(c).generation) change = {t_.info(c).generation, 0};
  if (change.count == kMostChanges) return false;
  ++change.count;
  restricted_.change_side(c, region);
  return true;
}

Tangles Untangler::tangles() {
  Tangles tangles;
  boundary_.update_disks();
  tangles.vertices = boundary_.disks().on_facets();
  if (!knows_components_) return tangles;
  const BoundarySurfaces& surfaces = boundary_.surfaces();
  if (surfaces.is_whole()) return tangles;
  tangles.all_pieces = std::make_shared<Pieces>(restricted_, surfaces);
  std::map<std::uint32_t, std::vector<FacetCode>> facets_of;
  for (const FacetCode side : tangles.all_pieces->side_facets()) {
    facets_of[tangles.all_pieces->of(side / 4)].push_back(side);
  }
  for (auto& [piece, list] : facets_of) tangles.pieces.push_back(std::move(list));
  return tangles;
}

/// Whether a vertex of the cell that is not on ∂O would come to the surface if the cell's piece changed sides.
bool Untangler::exposes_a_vertex(Pieces& pieces, CellId c) {
  if (t_.has_corner(c)) return true;
  for (const PointId v : t_.cell(c).vertex) {
    if (t_.vertex_info(v).on_boundary()) continue;
    t_.star_of(v, star_);
    for (const CellId other : star_) {
      if (pieces.of(other) != pieces.of(c)) return true;
    }
  }
  return false;
}

bool Untangler::absorb_fragments() {
  const BoundarySurfaces& surfaces = boundary_.surfaces();
  if (surfaces.is_whole()) return false;
  Pieces pieces(restricted_, surfaces);
  std::map<std::uint32_t, Neighbors> across;  // of each fragment
  for (const FacetCode side : pieces.side_facets()) {
    ++across[pieces.of(side / 4)][t_.info(t_.cell(side / 4).neighbor[side % 4] / 4).region];
  }
  const std::vector<CellId> members = pieces.side_cells();
  std::map<std::uint32_t, double> volume;
  for (const CellId c : members) {
    volume[pieces.of(c)] += exposes_a_vertex(pieces, c) ? std::numeric_limits<double>::infinity() : volume_mm3(t_, c);
  }
  bool changed = false;
  for (const CellId c : members) {
    const std::uint32_t piece = pieces.of(c);
    if (is_small(volume.at(piece), c)) changed = change(c, main_neighbor(across.at(piece))) || changed;
  }
  return changed;
}

bool Untangler::mend_pinches() {
  bool changed = false;
  boundary_.update_disks();
  for (const PointId v : boundary_.disks().all()) changed = mend_around(v) || changed;
  return changed;
}

bool Untangler::mend_around(PointId v) {
  t_.star_of(v, star_);
  std::vector<Group> groups = groups_of(t_, v, star_);
  if (groups.size() <= 2) return false;
  std::map<Region, int> groups_on_side;
  for (const Group& group : groups) ++groups_on_side[t_.info(group.cells.front()).region];
  std::erase_if(groups, [&](const Group& group) {
    const CellId c = group.cells.front();
    return groups_on_side[t_.info(c).region] < 2 || !group.on_surface || !is_small(group.volume, c);
  });
  std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.volume < b.volume; });
  return std::any_of(groups.begin(), groups.end(), [&](const Group& group) {
    bool changed = false;
    const Region region = main_neighbor(group.across);
    for (const CellId c : group.cells) changed = change(c, region) || changed;
    return changed;
  });
}

}  // namespace scantet::engine
