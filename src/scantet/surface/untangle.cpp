// Around a vertex, tets of one side that are connected through faces form a group. The boundary is a disk there if and
// only if each side is one group: two connected sets that fill the sphere around the vertex share one closed curve.
#include <algorithm>
#include <cassert>
#include <functional>

#include "scantet/base/parallel.h"
#include "scantet/base/tet_volume.h"
#include "scantet/surface/untangle_impl.h"

namespace scantet::engine {
namespace {

constexpr int kRounds = 20;
constexpr std::uint32_t kMostChanges = 6;

double volume_mm3(const Triangulation& t, CellId c) {
  if (t.has_corner(c)) return std::numeric_limits<double>::infinity();
  return tet_volume(t.points_of(c));
}

/// The region that most of the facets lead to.
Region main_neighbor(const std::map<Region, int>& neighbors) {
  return std::max_element(neighbors.begin(), neighbors.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

}  // namespace

std::uint64_t Untangler::run() {
  for (int round = 0; round < kRounds; ++round) {
    const bool covered = cover_vertices();
    const bool absorbed = knows_components_ && absorb_fragments();
    const bool mended = mend_pinches();
    if (!covered && !absorbed && !mended) break;
  }
  std::uint64_t changed = 0;
  for (CellId c = 0; c < changes_.size(); ++c) {
    changed += has_changed(c) ? 1 : 0;
  }
  return changed;
}

std::vector<Point> Untangler::changed_places() const {
  std::vector<Point> places;
  for (CellId c = 0; c < changes_.size(); ++c) {
    if (has_changed(c)) {
      const std::array<Point, 4> p = t_.points_of(c);
      places.push_back(0.25 * (p[0] + p[1] + p[2] + p[3]));
    }
  }
  return places;
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

bool Untangler::can_change(CellId c) const {
  if (changes_.size() <= c) return true;
  const Change& change = changes_[c];
  return change.generation != t_.info(c).generation || change.count < kMostChanges;
}

bool Untangler::change(CellId c, Region region) {
  assert(t_.is_cell(c) && t_.info(c).region != region);
  if (!can_change(c)) return false;
  turn(c, region);
  return true;
}

void Untangler::turn(CellId c, Region region) {
  if (changes_.size() <= c) changes_.resize(t_.cell_slots());
  Change& change = changes_[c];
  if (change.generation != t_.info(c).generation) change = {t_.info(c).generation, 0};
  ++change.count;
  restricted_.change_side(c, region);
  changed_around_.insert(t_.cell(c).vertex.begin(), t_.cell(c).vertex.end());
}

/// A point that is inserted beside tets that have changed sides has new ones around it, which have not: vertices off ∂O
/// may come to the surface. All tets around such a vertex go to its own side.
bool Untangler::cover_vertices() {
  std::vector<PointId> exposed;
  for (const auto& corners : boundary_.facets().corners) {
    for (const PointId v : corners) {
      if (!t_.vertex_info(v).on_boundary()) exposed.push_back(v);
    }
  }
  std::sort(exposed.begin(), exposed.end());
  exposed.erase(std::unique(exposed.begin(), exposed.end()), exposed.end());
  bool changed = false;
  for (const PointId v : exposed) {
    const Region region = domain_.region_at(t_.point(v));
    t_.star_of(v, star_);
    for (const CellId c : star_) {
      if (t_.info(c).region == region || t_.has_corner(c)) continue;
      turn(c, region);
      changed = true;
    }
  }
  return changed;
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
  std::map<std::uint32_t, std::map<Region, int>> across;  // of each fragment: how many facets lead to which region
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

/// In the order of the vertices, but what cannot be mended, which is most of it, is found side by side before.
bool Untangler::mend_pinches() {
  constexpr std::size_t kGrain = 32;
  boundary_.update_disks();
  const std::vector<PointId>& pinches = boundary_.disks().all();
  std::vector<std::uint8_t> can_be_mended(pinches.size());
  parallel_for(pinches.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<CellId> star;
    for (std::size_t i = begin; i < end; ++i) {
      const std::vector<Group> groups = small_groups(pinches[i], star);
      const auto can_turn = [&](const Group& group) {
        return std::any_of(group.cells.begin(), group.cells.end(), [&](CellId c) { return can_change(c); });
      };
      can_be_mended[i] = std::any_of(groups.begin(), groups.end(), can_turn) ? 1 : 0;
    }
  });
  changed_around_.clear();
  bool changed = false;
  for (std::size_t i = 0; i < pinches.size(); ++i) {
    if (can_be_mended[i] == 0 && !changed_around_.contains(pinches[i])) continue;
    changed = mend_around(pinches[i]) || changed;
  }
  return changed;
}

/// Splits the star into its groups, which empties it.
std::vector<Untangler::Group> Untangler::groups_of(PointId v, std::vector<CellId>& star) const {
  std::vector<Group> groups;
  while (!star.empty()) {
    Group group;
    group.cells.push_back(star.back());
    star.pop_back();
    for (std::size_t done = 0; done < group.cells.size(); ++done) {
      const CellId c = group.cells[done];
      group.volume += volume_mm3(t_, c);
      group.on_surface = group.on_surface && t_.is_on_boundary(c);
      for (std::size_t i = 0; i < 4; ++i) {
        if (t_.cell(c).vertex[i] == v) continue;
        const CellId next = t_.cell(c).neighbor[i] / 4;
        if (t_.info(next).region != t_.info(c).region) {
          ++group.across[t_.info(next).region];
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

/// The groups around a vertex that may change sides, the smallest first: of a side that has several, or else, where
/// none of these may, those that part them. star: scratch.
std::vector<Untangler::Group> Untangler::small_groups(PointId v, std::vector<CellId>& star) const {
  t_.star_of(v, star);
  std::vector<Group> groups = groups_of(v, star);
  if (groups.size() <= 2) return {};
  std::map<Region, int> groups_on_side;
  for (const Group& group : groups) ++groups_on_side[t_.info(group.cells.front()).region];
  const auto is_apart = [&](const Group& group) { return groups_on_side[t_.info(group.cells.front()).region] > 1; };
  if (std::none_of(groups.begin(), groups.end(), is_apart)) return {};
  std::erase_if(groups,
                [&](const Group& group) { return !group.on_surface || !is_small(group.volume, group.cells.front()); });
  if (std::any_of(groups.begin(), groups.end(), is_apart)) std::erase_if(groups, std::not_fn(is_apart));
  std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.volume < b.volume; });
  return groups;
}

bool Untangler::mend_around(PointId v) {
  const std::vector<Group> groups = small_groups(v, star_);
  return std::any_of(groups.begin(), groups.end(), [&](const Group& group) {
    bool changed = false;
    const Region region = main_neighbor(group.across);
    for (const CellId c : group.cells) changed = change(c, region) || changed;
    return changed;
  });
}

}  // namespace scantet::engine
