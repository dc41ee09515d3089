// Along a surface of facets with a disk around every vertex, the cells of each side are joined through faces. So only
// components of ∂O with more than one such surface can have side pieces, and only there are cells looked at. From the
// cells along each surface the search goes on to those that are joined to them, until it meets cells of the widest
// surface, from which no search starts.
#include <algorithm>
#include <atomic>

#include "scantet/base/parallel.h"
#include "scantet/surface/pieces_impl.h"

namespace scantet::engine {

bool has_disks(const Triangulation& t, const std::vector<FacetCode>& facets) {
  constexpr std::size_t kFacets = 4096;
  std::atomic<bool> all = true;
  parallel_for(facets.size(), kFacets, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && all.load(std::memory_order_relaxed); ++i) {
      for (const PointId v : facet_vertices(t.cell(facets[i] / 4), static_cast<int>(facets[i] % 4))) {
        if (!t.vertex_info(v).has_disk) all.store(false, std::memory_order_relaxed);
      }
    }
  });
  return all;
}

bool has_one_surface_each(const RestrictedTriangulation& restricted, const std::vector<FacetCode>& facets) {
  const Triangulation& t = restricted.triangulation();
  UnionFind sets(t.vertex_slots());
  for (const FacetCode facet : facets) {
    const auto v = facet_vertices(t.cell(facet / 4), static_cast<int>(facet % 4));
    sets.unite(v[0], v[1]);
    sets.unite(v[0], v[2]);
  }
  std::map<std::optional<Patch>, std::uint32_t> surface;
  std::optional<Patch> last;  // facets in a row are often on one surface
  std::uint32_t last_set = kNone;
  return std::all_of(facets.begin(), facets.end(), [&](FacetCode facet) {
    const std::uint32_t set = sets.find(facet_vertices(t.cell(facet / 4), static_cast<int>(facet % 4))[0]);
    const std::optional<Patch> patch = patch_of(restricted, facet);
    if (set == last_set && patch == last) return true;
    last = patch;
    last_set = set;
    return surface.try_emplace(patch, set).first->second == set;
  });
}

Pieces::Pieces(const RestrictedTriangulation& restricted, const std::vector<FacetCode>& facets)
    : t_(restricted), owner_(restricted.triangulation().cell_slots(), kNone) {
  find_surfaces(facets);
  if (!find_split_boundaries()) return;
  start(facets);
  const bool one_each = std::all_of(sides_.begin(), sides_.end(), [&](const Side& other) {
    return sets_.find(other.side) == sets_.find(widest_.at(other.region));
  });
  if (one_each) return;
  measure();
  find_side_facets(facets);
}

void Pieces::find_surfaces(const std::vector<FacetCode>& facets) {
  constexpr std::size_t kFacets = 4096;
  const Triangulation& t = t_.triangulation();
  std::vector<std::array<PointId, 3>> disks(facets.size());  // those of the facet's vertices that have one, then kNone
  seen_.resize(facets.size());
  parallel_for(facets.size(), kFacets, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      seen_[i].patch = patch_of(t_, facets[i]);
      disks[i] = facet_vertices(t.cell(facets[i] / 4), static_cast<int>(facets[i] % 4));
      for (PointId& v : disks[i]) v = t.vertex_info(v).has_disk ? v : kNone;
      std::sort(disks[i].begin(), disks[i].end());
    }
  });
  UnionFind joined(t.vertex_slots());
  for (const auto& v : disks) {
    if (v[1] != kNone) joined.unite(v[0], v[1]);
    if (v[2] != kNone) joined.unite(v[0], v[2]);
  }
  std::vector<std::uint32_t> number(t.vertex_slots(), kNone);  // of a set's surface, by the set's vertex
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    if (disks[i][0] == kNone) {
      seen_[i].surface = count++;  // a surface of its own
      continue;
    }
    std::uint32_t& surface = number[joined.find(disks[i][0])];
    if (surface == kNone) surface = count++;
    seen_[i].surface = surface;
  }
  sets_ = UnionFind(2 * std::size_t{count});
  cells_.assign(sets_.size(), 0);
}

/// Finds the components of ∂O with more than one surface. Returns whether there are any.
bool Pieces::find_split_boundaries() {
  std::map<Patch, std::uint32_t> surface;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const Seen& seen = seen_[i];
    if (!seen.patch || (i > 0 && seen == seen_[i - 1])) continue;
    const bool known = surface.try_emplace(*seen.patch, seen.surface).first->second == seen.surface;
    if (!known) split_.insert(*seen.patch);
  }
  return !split_.empty();
}

/// Each side of a surface of a split boundary comes to own the cells along it. All sides but the widest then take the
/// cells that are joined to theirs.
void Pieces::start(const std::vector<FacetCode>& facets) {
  const Triangulation& t = t_.triangulation();
  std::vector<std::uint8_t> takes_part(sets_.size() / 2, 0);
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (i > 0 && seen_[i] == seen_[i - 1]) continue;
    takes_part[seen_[i].surface] |= is_split(seen_[i]) ? 1 : 0;
  }
  std::vector<std::uint32_t> width(sets_.size(), 0);
  const auto each_side = [&](const auto& visit) {
    for (std::size_t i = 0; i < facets.size(); ++i) {
      const std::uint32_t side = 2 * seen_[i].surface;
      if (takes_part[seen_[i].surface] == 0) continue;
      visit(side, facets[i] / 4);
      visit(side + 1, t.cell(facets[i] / 4).neighbor[facets[i] % 4] / 4);
    }
  };
  each_side([&](std::uint32_t side, CellId c) {
    own(c, side);
    if (width[side]++ == 0) sides_.push_back({side, t.info(c).region});
  });
  for (const auto& [side, region] : sides_) {
    std::uint32_t& widest = widest_.try_emplace(region, side).first->second;
    if (width[side] > width[widest]) widest = side;
  }
  for (const auto& [region, widest] : widest_) width[widest] = 0;
  std::map<std::uint32_t, std::vector<CellId>> fronts;
  each_side([&](std::uint32_t side, CellId c) {
    if (width[side] > 0) fronts[side].push_back(c);
  });
  for (auto& [side, front] : fronts) {
    const Region region = t.info(front.front()).region;
    flood(side, std::move(front), widest_.at(region));
  }
}

void Pieces::own(CellId c, std::uint32_t side) {
  if (owner_[c] == kNone) {
    owner_[c] = side;
    ++cells_[side];
  } else {
    sets_.unite(owner_[c], side);
  }
}

/// A side comes to own the cells that are joined to the front, but not those that another side owns. It stops, if
/// `until` is given, once it is in one piece with that side.
void Pieces::flood(std::uint32_t side, std::vector<CellId> front, std::optional<std::uint32_t> until) {
  const Triangulation& t = t_.triangulation();
  for (std::size_t i = 0; i < front.size(); ++i) {
    if (until && sets_.find(side) == sets_.find(*until)) return;
    for (const FacetCode across : t.cell(front[i]).neighbor) {
      if (across == kNone || t.info(across / 4).region != t.info(front[i]).region) continue;
      const bool is_new = owner_[across / 4] == kNone;
      own(across / 4, side);
      if (is_new) front.push_back(across / 4);
    }
  }
}

/// Measures the pieces: those of the widest sides as far as their cells are known, or in whole where another piece may
/// be larger.
void Pieces::measure() {
  const auto add_up = [&] {
    size_.assign(sets_.size(), 0);
    for (std::uint32_t side = 0; side < sets_.size(); ++side) size_[sets_.find(side)] += cells_[side];
  };
  add_up();
  for (const auto& [region, widest] : widest_) {
    const std::uint32_t piece = sets_.find(widest);
    const bool is_largest = std::all_of(sides_.begin(), sides_.end(), [&, in = region](const Side& other) {
      return other.region != in || sets_.find(other.side) == piece || size_[sets_.find(other.side)] < size_[piece];
    });
    if (is_largest) continue;
    std::vector<CellId> front;
    for (CellId c = 0; c < owner_.size(); ++c) {
      if (of(c) == piece) front.push_back(c);
    }
    flood(widest, std::move(front), std::nullopt);
  }
  add_up();
}

void Pieces::find_side_facets(const std::vector<FacetCode>& facets) {
  std::vector<Region> region(sets_.size(), kOutside);
  for (const Side& side : sides_) region[side.side] = side.region;
  std::map<std::pair<Patch, Region>, std::uint32_t> main;
  const auto main_beside = [&](const Seen& seen, std::uint32_t side) -> std::uint32_t& {
    return main.try_emplace({*seen.patch, region[side]}, sets_.find(side)).first->second;
  };
  const auto is_as_before = [&](std::size_t i) { return i > 0 && seen_[i] == seen_[i - 1]; };  // mostly
  for (std::size_t i = 0; i < facets.size(); ++i) {
    if (is_as_before(i) || !is_split(seen_[i])) continue;
    for (const std::uint32_t side : {2 * seen_[i].surface, 2 * seen_[i].surface + 1}) {
      std::uint32_t& largest = main_beside(seen_[i], side);
      if (size_[sets_.find(side)] > size_[largest]) largest = sets_.find(side);
    }
  }
  bool is_here = false;
  bool is_across = false;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    if (!is_as_before(i)) {
      const std::uint32_t side = 2 * seen_[i].surface;
      is_here = is_split(seen_[i]) && sets_.find(side) != main_beside(seen_[i], side);
      is_across = is_split(seen_[i]) && sets_.find(side + 1) != main_beside(seen_[i], side + 1);
    }
    if (is_here) side_facets_.push_back(facets[i]);
    if (is_across) side_facets_.push_back(t_.triangulation().cell(facets[i] / 4).neighbor[facets[i] % 4]);
  }
}

std::vector<CellId> Pieces::side_cells() {
  std::set<std::uint32_t> pieces;
  for (const FacetCode side : side_facets_) pieces.insert(of(side / 4));
  std::vector<CellId> cells;
  for (CellId c = 0; c < owner_.size() && !pieces.empty(); ++c) {
    if (owner_[c] != kNone && pieces.count(of(c)) > 0) cells.push_back(c);
  }
  return cells;
}

}  // namespace scantet::engine
