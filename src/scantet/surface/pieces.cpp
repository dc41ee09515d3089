// Along a surface of facets with a disk around every vertex, the cells of each side are joined through faces. So only
// components of ∂O with more than one such surface can have side pieces, and only there are cells looked at. From the
// cells along each surface the search goes on to those that are joined to them, until it meets cells along the widest
// surface, from which no search starts. Searches run side by side: whichever comes to own a cell, those that meet there
// are of one piece. How far those get that end as they are in one piece with the widest surface hangs on the threads,
// but what is asked of pieces does not.
#include <algorithm>
#include <atomic>
#include <set>

#include "scantet/base/parallel.h"
#include "scantet/surface/boundary_facets_impl.h"
#include "scantet/surface/pieces_impl.h"

namespace scantet::engine {
namespace {

constexpr std::size_t kFacets = 4096;
constexpr std::size_t kCells = 65'536;

}  // namespace

Pieces::Pieces(const RestrictedTriangulation& restricted, const BoundarySurfaces& surfaces)
    : t_(restricted.triangulation()), surfaces_(surfaces) {
  if (!surfaces.has_split_patches()) return;
  owner_.assign(t_.cell_slots(), kNone);
  find_sides();
  start();
  const bool one_each = std::all_of(sides_.begin(), sides_.end(), [&](const Side& other) {
    return sets_.find(other.side) == sets_.find(widest_.at(other.region));
  });
  if (one_each) return;
  measure();
  find_side_facets();
}

/// The two sides of each surface that takes part, and of each region the widest of them.
void Pieces::find_sides() {
  sets_ = ParallelUnionFind(2 * surfaces_.surfaces().size());
  const auto width = [&](std::uint32_t side) { return surfaces_.surfaces()[side / 2].facets; };
  for (std::uint32_t n = 0; n < surfaces_.surfaces().size(); ++n) {
    if (!surfaces_.surfaces()[n].takes_part) continue;
    const FacetCode facet = surfaces_.facets()[surfaces_.surfaces()[n].first];
    sides_.push_back({2 * n, t_.info(facet / 4).region});
    sides_.push_back({2 * n + 1, t_.info(t_.cell(facet / 4).neighbor[facet % 4] / 4).region});
  }
  for (const auto& [side, region] : sides_) {
    std::uint32_t& widest = widest_.try_emplace(region, side).first->second;
    if (width(side) > width(widest)) widest = side;
  }
}

/// Each of those sides that are asked for comes to own the cells along it. Return: these cells, by side.
std::map<std::uint32_t, std::vector<CellId>> Pieces::own_along(const std::vector<bool>& sides) {
  const auto along = parallel_collect<std::pair<std::uint32_t, CellId>>(
      surfaces_.facets().size(), kFacets, [&](std::size_t begin, std::size_t end, auto& owned) {
        for (std::size_t i = begin; i < end; ++i) {
          const std::uint32_t side = 2 * surfaces_.seen()[i].surface;
          const FacetCode facet = surfaces_.facets()[i];
          if (sides[side]) owned.emplace_back(side, facet / 4);
          if (sides[side + 1]) owned.emplace_back(side + 1, t_.cell(facet / 4).neighbor[facet % 4] / 4);
        }
        for (const auto& [side, c] : owned) own(c, side);
      });
  std::map<std::uint32_t, std::vector<CellId>> cells;
  for (const auto& [side, c] : along) cells[side].push_back(c);
  return cells;
}

/// Each side but the widest comes to own the cells along it, and then those that are joined to these.
void Pieces::start() {
  std::vector<bool> searches(sets_.size(), false);
  for (const Side& side : sides_) searches[side.side] = true;
  for (const auto& [region, widest] : widest_) searches[widest] = false;
  struct Search {
    std::uint32_t side;
    std::vector<CellId> front;
  };
  std::vector<Search> all;
  for (auto& [side, front] : own_along(searches)) all.push_back({side, std::move(front)});
  parallel_for(all.size(), 1, [&](std::size_t n, std::size_t) {
    const Region region = t_.info(all[n].front.front()).region;
    flood(all[n].side, std::move(all[n].front), widest_.at(region));
  });
}

/// What is owned for the first time joins its owner to all sides that it lies along. Return: whether that is so.
bool Pieces::own(CellId c, std::uint32_t side) {
  std::atomic_ref at(owner_[c]);
  std::uint32_t owner = at.load(std::memory_order_relaxed);
  if (owner != kNone || !at.compare_exchange_strong(owner, side, std::memory_order_relaxed)) {
    if (owner != side) sets_.unite(owner, side);
    return false;
  }
  const Region here = t_.info(c).region;
  for (FacetCode facet = 4 * c; facet < 4 * c + 4; ++facet) {
    const FacetCode across = t_.cell(c).neighbor[facet % 4];
    const Region beyond = across == kNone ? here : t_.info(across / 4).region;
    if (beyond == here) continue;
    const std::uint32_t surface = surfaces_.surface_of(facet);
    if (surface == kNone || !surfaces_.surfaces()[surface].takes_part) continue;
    sets_.unite(side, 2 * surface + (is_seen_from(here, beyond) ? 0 : 1));
  }
  return true;
}

/// A side comes to own the cells that are joined to the front, but not those that another side owns. It stops, if
/// `until` is given, once it is in one piece with that side.
void Pieces::flood(std::uint32_t side, std::vector<CellId> front, std::optional<std::uint32_t> until) {
  for (std::size_t i = 0; i < front.size(); ++i) {
    if (until && sets_.find(side) == sets_.find(*until)) return;
    for (const FacetCode across : t_.cell(front[i]).neighbor) {
      if (across == kNone || t_.info(across / 4).region != t_.info(front[i]).region) continue;
      if (own(across / 4, side)) front.push_back(across / 4);
    }
  }
}

/// How many cells each side owns.
std::vector<std::uint32_t> Pieces::owned_cells() {
  std::vector<std::uint32_t> cells(sets_.size());
  parallel_for(owner_.size(), kCells, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end;) {
      const std::uint32_t side = owner_[c];
      const std::size_t first = c;
      while (c < end && owner_[c] == side) ++c;
      if (side == kNone) continue;
      std::atomic_ref(cells[side]).fetch_add(static_cast<std::uint32_t>(c - first), std::memory_order_relaxed);
    }
  });
  return cells;
}

/// Measures the pieces: those of the widest sides as far as their cells are known, or in whole where another piece may
/// be larger.
void Pieces::measure() {
  constexpr std::uint32_t kMostAlong = 4;  // facets that a cell has
  const auto add_up = [&] {
    const std::vector<std::uint32_t> cells = owned_cells();
    size_.assign(sets_.size(), 0);
    for (std::uint32_t side = 0; side < sets_.size(); ++side) size_[sets_.find(side)] += cells[side];
    for (const auto& [region, widest] : widest_) {
      std::uint32_t& size = size_[sets_.find(widest)];
      size = std::max(size, surfaces_.surfaces()[widest / 2].facets / kMostAlong);
    }
  };
  add_up();
  for (const auto& [region, widest] : widest_) {
    const std::uint32_t piece = sets_.find(widest);
    const bool is_largest = std::all_of(sides_.begin(), sides_.end(), [&, in = region](const Side& other) {
      return other.region != in || sets_.find(other.side) == piece || size_[sets_.find(other.side)] < size_[piece];
    });
    if (!is_largest) flood_widest(widest);
  }
  add_up();
}

void Pieces::flood_widest(std::uint32_t widest) {
  std::vector<bool> sides(sets_.size(), false);
  sides[widest] = true;
  own_along(sides);
  const std::uint32_t piece = sets_.find(widest);
  flood(widest, cells_where([&](CellId c) { return of(c) == piece; }), std::nullopt);
}

/// Ascending.
template <class Is>
std::vector<CellId> Pieces::cells_where(const Is& is) const {
  return parallel_collect<CellId>(owner_.size(), kCells, [&](std::size_t begin, std::size_t end, auto& found) {
    for (auto c = static_cast<CellId>(begin); c < end; ++c) {
      if (owner_[c] != kNone && is(c)) found.push_back(c);
    }
  });
}

void Pieces::find_side_facets() {
  const std::vector<BoundarySurfaces::Seen>& seen = surfaces_.seen();
  std::vector<Region> region(sets_.size(), kOutside);
  for (const Side& side : sides_) region[side.side] = side.region;
  std::map<std::pair<Patch, Region>, std::uint32_t> main;
  const auto main_beside = [&](const BoundarySurfaces::Seen& facet, std::uint32_t side) -> std::uint32_t& {
    return main.try_emplace({*facet.patch, region[side]}, sets_.find(side)).first->second;
  };
  surfaces_.each_run([&](std::size_t begin, std::size_t) {
    if (!surfaces_.is_split(seen[begin])) return;
    for (const std::uint32_t side : {2 * seen[begin].surface, 2 * seen[begin].surface + 1}) {
      std::uint32_t& largest = main_beside(seen[begin], side);
      if (size_[sets_.find(side)] > size_[largest]) largest = sets_.find(side);
    }
  });
  surfaces_.each_run([&](std::size_t begin, std::size_t end) {
    if (!surfaces_.is_split(seen[begin])) return;
    const std::uint32_t side = 2 * seen[begin].surface;
    const bool is_here = sets_.find(side) != main_beside(seen[begin], side);
    const bool is_across = sets_.find(side + 1) != main_beside(seen[begin], side + 1);
    if (!is_here && !is_across) return;
    for (std::size_t i = begin; i < end; ++i) {
      const FacetCode facet = surfaces_.facets()[i];
      if (is_here) side_facets_.push_back(facet);
      if (is_across) side_facets_.push_back(t_.cell(facet / 4).neighbor[facet % 4]);
    }
  });
}

std::vector<CellId> Pieces::side_cells() {
  std::set<std::uint32_t> pieces;
  for (const FacetCode side : side_facets_) pieces.insert(of(side / 4));
  if (pieces.empty()) return {};
  return cells_where([&](CellId c) { return pieces.contains(of(c)); });
}

}  // namespace scantet::engine
