// The tets of the lattice lie around its edges: each edge from an even place to the next one along an axis has four,
// whose other edges are those of the square of odd places around the middle of the edge. The triangulation of all
// points but the core's has the facets around the stars of the core, too: the tets on their outer sides stay, and those
// on their inner sides are removed.
//
// Why it has these facets: in the triangulation of all points, the tet outside such a facet has no point of the core,
// and no point in its circumsphere; so it is in the triangulation of the other points. If further points lie on its
// circumsphere, these are triangulated in one way or another, but the facet is on their hull, as the tet behind it is
// strictly Delaunay.
#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "scantet/base/neighbors.h"
#include "scantet/base/parallel.h"
#include "scantet/base/point_grid_impl.h"
#include "scantet/delaunay/lattice_core_impl.h"

namespace scantet::engine {
namespace {

constexpr double kOff = 3e-4;       // of half sides: how far off its place a point may be
constexpr double kAlone = 1.125;    // sides: √5/2, and a little more as points are off their places
constexpr std::size_t kWorth = 64;  // points from which on it pays
constexpr int kTets = 12;           // tets on the edges upward from an even place: four for each axis

using Steps = std::array<std::int32_t, 3>;

std::array<std::uint32_t, 3> operator+(const std::array<std::uint32_t, 3>& place, const Steps& steps) {
  const auto sum = [&](std::size_t axis) { return place[axis] + static_cast<std::uint32_t>(steps[axis]); };
  return {sum(0), sum(1), sum(2)};
}

constexpr Steps along(int axis, std::int32_t steps) {
  Steps result{};
  result[static_cast<std::size_t>(axis)] = steps;
  return result;
}

/// The steps from the lower end of an edge along an axis to the k-th odd place around it, turning to the left.
constexpr Steps to_odd(int axis, int k) {
  Steps result = along(axis, 1);
  result[static_cast<std::size_t>((axis + 1) % 3)] = (k + 1) % 4 < 2 ? 1 : -1;
  result[static_cast<std::size_t>((axis + 2) % 3)] = k % 4 < 2 ? 1 : -1;
  return result;
}

/// The steps from the lower end of a tet's edge to its vertices, positively oriented.
constexpr std::array<Steps, 4> vertices_of(int tet) {
  const int axis = tet / 4;
  return {Steps{}, along(axis, 2), to_odd(axis, tet % 4), to_odd(axis, tet % 4 + 1)};
}

/// The tet across a facet.
struct Across {
  Steps to{};      // from the lower end of this tet's edge to that of the other's
  int tet = -1;    // its number among the twelve there
  int facet = -1;  // its index in that tet
};

/// Finds the tet that shares the facet opposite to a vertex: it has the other three vertices, in any order.
constexpr Across find_across(int tet, int opposite) {
  const std::array<Steps, 4> own = vertices_of(tet);
  for (const auto& [x, y, z] : kNeighborhood) {
    const Steps to{2 * x, 2 * y, 2 * z};
    for (int other = 0; other < kTets; ++other) {
      if (to == Steps{} && other == tet) continue;
      std::array<Steps, 4> there = vertices_of(other);
      int shared = 0;
      int left = -1;
      for (int i = 0; i < 4; ++i) {
        Steps place = there[static_cast<std::size_t>(i)];
        for (std::size_t axis = 0; axis < 3; ++axis) place[axis] += to[axis];
        bool is_shared = false;
        for (int j = 0; j < 4; ++j)
          is_shared = is_shared || (j != opposite && own[static_cast<std::size_t>(j)] == place);
        if (is_shared) ++shared;
        if (!is_shared) left = i;
      }
      if (shared == 3) return {to, other, left};
    }
  }
  return {};
}

constexpr std::array<std::array<Across, 4>, kTets> all_across() {
  std::array<std::array<Across, 4>, kTets> all{};
  for (int tet = 0; tet < kTets; ++tet) {
    for (int i = 0; i < 4; ++i) all[static_cast<std::size_t>(tet)][static_cast<std::size_t>(i)] = find_across(tet, i);
  }
  return all;
}

/// A facet by its vertices in ascending order, and the side of it on which the tet lies that sees it in that order.
struct SortedFacet {
  std::array<PointId, 3> vertices;
  bool left;

  SortedFacet(const Cell& cell, int i) : vertices(facet_vertices(cell, i)), left(i % 2 == 0) {
    for (const auto& [a, b] : {std::array{0, 1}, std::array{1, 2}, std::array{0, 1}}) {
      if (vertices[static_cast<std::size_t>(a)] < vertices[static_cast<std::size_t>(b)]) continue;
      std::swap(vertices[static_cast<std::size_t>(a)], vertices[static_cast<std::size_t>(b)]);
      left = !left;
    }
  }
};

}  // namespace

struct LatticeCore::OuterFacet {
  SortedFacet facet;
  FacetCode code;
};

/// Finds sites. It remembers the block of the last site, as the next one is often in it.
class LatticeCore::Reader {
 public:
  explicit Reader(const LatticeCore& core) : core_(core) {}
  const Site& at(const Place& place) {
    static constexpr Site kNobody;
    const std::uint64_t key = key_of(place);
    if (key != key_) {
      const auto found = core_.number_of_block_.find(key);
      block_ = found == core_.number_of_block_.end() ? nullptr : &core_.blocks_[found->second];
      key_ = key;
    }
    return block_ == nullptr ? kNobody : block_->sites[index_in_block(place)];
  }

 private:
  const LatticeCore& core_;
  std::uint64_t key_ = ~std::uint64_t{0};
  const Block* block_ = nullptr;
};

std::size_t LatticeCore::index_in_block(const Place& place) {
  const auto cube = [&](std::size_t axis) { return std::size_t{place[axis] % kBlock / 2}; };
  constexpr std::size_t kEdge = kBlock / 2;
  return ((std::size_t{place[0] % 2} * kEdge + cube(2)) * kEdge + cube(1)) * kEdge + cube(0);
}

LatticeCore::Place LatticeCore::place_in_block(const Block& block, std::size_t index) {
  constexpr std::size_t kEdge = kBlock / 2;
  const std::size_t odd = index / (kEdge * kEdge * kEdge);
  const auto at = [&](std::size_t axis, std::size_t cube) {
    return block.low[axis] + static_cast<std::uint32_t>(2 * (cube % kEdge) + odd);
  };
  return {at(0, index), at(1, index / kEdge), at(2, index / kEdge / kEdge)};
}

std::uint64_t LatticeCore::key_of(const Place& place) {
  const auto part = [&](std::size_t axis) { return std::uint64_t{place[axis] / kBlock}; };
  return part(0) | part(1) << 20 | part(2) << 40;
}

LatticeCore::LatticeCore(const SeedLattice& lattice, const Triangulation& t) : lattice_(lattice) {
  if (!(lattice.side_mm > 0 && std::isfinite(lattice.side_mm))) return;
  std::vector<Point> others;
  std::size_t sites = 0;
  for (PointId v = Triangulation::kCorners; v < t.vertex_slots(); ++v) {
    Place place;
    if (find_place(t.point(v), place) && add_site(place, v)) {
      ++sites;
    } else {
      others.push_back(t.point(v));
    }
  }
  if (sites < kWorth) return;
  find_core(t, others);
  find_stars();
}

/// Finds the place that a point is at. Returns false if it is at none.
bool LatticeCore::find_place(const Point& p, Place& place) const {
  constexpr double kFarthest = 1 << 23;
  for (int axis = 0; axis < 3; ++axis) {
    const double position = 2 * (p[axis] - lattice_.corner[axis]) / lattice_.side_mm;
    const double nearest = std::round(position);
    if (!(std::abs(position - nearest) < kOff && nearest >= 0 && nearest < kFarthest)) return false;
    place[static_cast<std::size_t>(axis)] = kBlock + static_cast<std::uint32_t>(nearest);
  }
  return place[0] % 2 == place[1] % 2 && place[0] % 2 == place[2] % 2;
}

/// Puts a point at a place. Returns false if another one is there.
bool LatticeCore::add_site(const Place& place, PointId v) {
  const auto [entry, is_new] = number_of_block_.try_emplace(key_of(place), static_cast<std::uint32_t>(blocks_.size()));
  if (is_new) {
    blocks_.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) blocks_.back().low[axis] = place[axis] / kBlock * kBlock;
  }
  PointId& vertex = blocks_[entry->second].sites[index_in_block(place)].vertex;
  if (vertex != kNone) return false;
  vertex = v;
  return true;
}

void LatticeCore::find_core(const Triangulation& t, const std::vector<Point>& others) {
  const double alone_mm = kAlone * lattice_.side_mm;
  const PointGrid grid(others, alone_mm);
  in_core_.assign(t.vertex_slots(), 0);
  parallel_for(blocks_.size(), 1, [&](std::size_t b, std::size_t) {
    Reader reader(*this);
    const auto has_all_around = [&](const Place& place) {
      for (int i = 0; i < 8; ++i) {
        const Steps step{2 * (i & 1) - 1, (i & 2) - 1, (i & 4) / 2 - 1};
        if (reader.at(place + step).vertex == kNone) return false;
      }
      for (int axis = 0; axis < 3; ++axis) {
        if (reader.at(place + along(axis, 2)).vertex == kNone) return false;
        if (reader.at(place + along(axis, -2)).vertex == kNone) return false;
      }
      return true;
    };
    const auto always = [](std::uint32_t, const Point&, double) { return true; };
    for (std::size_t i = 0; i < kSites; ++i) {
      const PointId v = blocks_[b].sites[i].vertex;
      if (v == kNone || !has_all_around(place_in_block(blocks_[b], i))) continue;
      in_core_[v] = grid.any_near(t.point(v), alone_mm, always) ? 0 : 1;
    }
  });
}

/// Finds and counts the tets with a vertex of the core.
void LatticeCore::find_stars() {
  std::vector<std::uint32_t> count(blocks_.size(), 0);
  parallel_for(blocks_.size(), 1, [&](std::size_t b, std::size_t) {
    Reader reader(*this);
    for (std::size_t i = 0; i < kSites / 2; ++i) {  // the even places
      Site& site = blocks_[b].sites[i];
      const Place place = place_in_block(blocks_[b], i);
      for (int axis = 0; axis < 3 && site.vertex != kNone; ++axis) {
        const PointId up = reader.at(place + along(axis, 2)).vertex;
        if (up == kNone) continue;
        const bool has_edge = has(site.vertex) || has(up);
        std::array<PointId, 5> odd{};
        for (int k = 0; k < 4; ++k) odd[static_cast<std::size_t>(k)] = reader.at(place + to_odd(axis, k)).vertex;
        odd[4] = odd[0];
        for (std::size_t k = 0; k < 4; ++k) {
          if (odd[k] == kNone || odd[k + 1] == kNone) continue;
          if (has_edge || has(odd[k]) || has(odd[k + 1]))
            site.stars |= std::uint16_t(1U << (4 * std::size_t(axis) + k));
        }
      }
      site.first = count[b];
      count[b] += static_cast<std::uint32_t>(std::popcount(site.stars));
    }
  });
  std::exclusive_scan(count.begin(), count.end(), count.begin(), std::uint32_t{0});
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    for (std::size_t i = 0; i < kSites / 2; ++i) {
      Site& site = blocks_[b].sites[i];
      site.first += count[b];
      cells_ = site.first + static_cast<std::size_t>(std::popcount(site.stars));
    }
  }
}

/// Writes the tets and links them to each other. Returns the facets around them.
std::vector<LatticeCore::OuterFacet> LatticeCore::write_cells(Triangulation& t,
                                                              const std::vector<CellId>& slots) const {
  static const std::array<std::array<Across, 4>, kTets> across = all_across();
  const auto slot = [&](const Site& site, int tet) { return slots[site.number_of(tet)]; };
  return parallel_collect<OuterFacet>(
      blocks_.size(), 1, [&](std::size_t b, std::size_t, std::vector<OuterFacet>& outer) {
        Reader reader(*this);
        for (std::size_t i = 0; i < kSites / 2; ++i) {
          const Site& site = blocks_[b].sites[i];
          const Place place = place_in_block(blocks_[b], i);
          for (int tet = 0; tet < kTets; ++tet) {
            if ((site.stars >> tet & 1) == 0) continue;
            const CellId c = slot(site, tet);
            Cell& cell = t.cells_[c];
            t.clear_cell(c);
            const std::array<Steps, 4> steps = vertices_of(tet);
            for (std::size_t k = 0; k < 4; ++k) cell.vertex[k] = reader.at(place + steps[k]).vertex;
            for (std::size_t k = 0; k < 4; ++k) {
              const Across& next = across[static_cast<std::size_t>(tet)][k];
              const Site& there = reader.at(place + next.to);
              const bool is_in = (there.stars >> next.tet & 1) != 0;
              cell.neighbor[k] = is_in ? 4 * slot(there, next.tet) + static_cast<FacetCode>(next.facet) : kNone;
              if (!is_in) outer.push_back({SortedFacet(cell, static_cast<int>(k)), 4 * c + static_cast<FacetCode>(k)});
            }
          }
        }
      });
}

void LatticeCore::join(Triangulation& t) const {
  if (empty()) return;
  std::vector<CellId> slots = t.take_cells(cells_);
  assert(slots.size() == cells_);
  std::vector<CellId> inner = link_outer_facets(t, write_cells(t, slots));
  remove_from(t, std::move(inner));
  // Vertices may name a tet that is gone as one of theirs.
  for (const CellId c : slots) {
    for (const PointId v : t.cell(c).vertex) t.vertex(v).cell = c;
  }
}

/// Links the tets outside of the facets to those of the core. Returns the tets inside of them, which are replaced by
/// the core's.
std::vector<CellId> LatticeCore::link_outer_facets(Triangulation& t, std::vector<OuterFacet> outer) const {
  constexpr std::size_t kGrain = 8192;
  parallel_sort(outer, [](const OuterFacet& a, const OuterFacet& b) { return a.facet.vertices < b.facet.vertices; });
  std::vector<std::uint32_t> begin(t.vertex_slots() + 1, 0);  // of the facets whose least vertex it is
  std::vector<std::uint8_t> is_outer(t.vertex_slots(), 0);
  for (const OuterFacet& entry : outer) {
    ++begin[entry.facet.vertices[0] + 1];
    for (const PointId v : entry.facet.vertices) is_outer[v] = 1;
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::atomic<std::size_t> linked = 0;
  const auto link = [&](CellId c, int i, std::vector<CellId>& inner) {
    const SortedFacet facet(t.cell(c), i);
    for (std::uint32_t k = begin[facet.vertices[0]]; k < begin[facet.vertices[0] + 1]; ++k) {
      if (outer[k].facet.vertices != facet.vertices) continue;
      FacetCode& across = t.cells_[c].neighbor[static_cast<std::size_t>(i)];
      if (outer[k].facet.left == facet.left) {  // on the core's side
        across = kNone;
        inner.push_back(c);
      } else {
        across = outer[k].code;
        t.cells_[across / 4].neighbor[across % 4] = 4 * c + static_cast<FacetCode>(i);
        ++linked;
      }
    }
  };
  std::vector<CellId> inner = parallel_collect<CellId>(
      t.cell_slots(), kGrain, [&](std::size_t from, std::size_t to, std::vector<CellId>& found) {
        for (auto c = static_cast<CellId>(from); c < to; ++c) {
          if (!t.is_cell(c)) continue;
          std::array<int, 4> is_there{};
          for (std::size_t k = 0; k < 4; ++k) is_there[k] = is_outer[t.cell(c).vertex[k]];
          const int count = is_there[0] + is_there[1] + is_there[2] + is_there[3];
          for (std::size_t k = 0; k < 4; ++k) {
            if (count - is_there[k] == 3 && !has(t.cell(c).vertex[k])) link(c, static_cast<int>(k), found);
          }
        }
      });
  if (linked != outer.size()) throw std::logic_error("facets around the lattice are not in the triangulation");
  return inner;
}

/// Frees these tets and all tets that are connected to them through facets.
void LatticeCore::remove_from(Triangulation& t, std::vector<CellId> cells) {
  while (!cells.empty()) {
    const CellId c = cells.back();
    cells.pop_back();
    if (!t.is_cell(c)) continue;
    for (const FacetCode across : t.cell(c).neighbor) {
      if (across != kNone && t.is_cell(across / 4)) cells.push_back(across / 4);
    }
    t.clear_cell(c);
    t.free_cells_.push_back(c);
  }
}

}  // namespace scantet::engine
