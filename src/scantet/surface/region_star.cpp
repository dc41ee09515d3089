// The cells around a vertex are triangles on a small sphere around it, and the regions a map on that sphere. A part of
// a sphere that hangs together is a disk if and only if its rim is one closed path; the whole sphere has no rim. A
// border between two countries of the map, the arcs where they meet, must hang together, too.
#include <map>
#include <utility>

#include "scantet/base/union_find.h"
#include "scantet/surface/region_star_impl.h"

namespace scantet::engine {
namespace {

/// An arc of the map between two regions, the smaller one first: the edge across from v of a boundary facet.
struct Arc {
  std::pair<Region, Region> regions;
  PointId a;
  PointId b;
};

/// Numbers the vertices across from v that arcs have, from 0 on.
class Numbers {
 public:
  std::uint32_t of(PointId v) {
    return numbers_.try_emplace(v, static_cast<std::uint32_t>(numbers_.size())).first->second;
  }
  std::size_t size() const { return numbers_.size(); }

 private:
  std::map<PointId, std::uint32_t> numbers_;
};

/// Whether the arcs form one closed path, or one path, that no vertex has more than two arcs of.
bool is_one_path(const std::vector<Arc>& arcs, bool must_close) {
  Numbers numbers;
  for (const Arc& arc : arcs) {
    numbers.of(arc.a);
    numbers.of(arc.b);
  }
  UnionFind joined(numbers.size());
  std::vector<int> arcs_at(numbers.size(), 0);
  for (const Arc& arc : arcs) {
    joined.unite(numbers.of(arc.a), numbers.of(arc.b));
    ++arcs_at[numbers.of(arc.a)];
    ++arcs_at[numbers.of(arc.b)];
  }
  for (std::uint32_t n = 0; n < numbers.size(); ++n) {
    if (joined.find(n) != joined.find(0) || arcs_at[n] > 2 || (must_close && arcs_at[n] != 2)) return false;
  }
  return true;
}

}  // namespace

StarFault fault_of_star(const Triangulation& t, PointId v, std::span<const CellId> star) {
  std::map<CellId, std::uint32_t> place;
  for (const CellId c : star) place.emplace(c, static_cast<std::uint32_t>(place.size()));
  UnionFind joined(star.size());
  std::map<std::pair<Region, Region>, std::vector<Arc>> borders;
  for (const CellId c : star) {
    const Cell& cell = t.cell(c);
    for (std::size_t i = 0; i < 4; ++i) {
      if (cell.vertex[i] == v) continue;  // the facet across from v
      const CellId next = cell.neighbor[i] / 4;
      const Region here = t.info(c).region;
      const Region there = t.info(next).region;
      if (here == there) joined.unite(place.at(c), place.at(next));
      if (here >= there) continue;  // seen from the other side
      Arc arc{{here, there}, kNone, kNone};
      for (const PointId corner : facet_vertices(cell, static_cast<int>(i))) {
        if (corner != v) (arc.a == kNone ? arc.a : arc.b) = corner;
      }
      borders[arc.regions].push_back(arc);
    }
  }
  std::map<Region, std::uint32_t> piece;
  for (const CellId c : star) {
    const std::uint32_t set = joined.find(place.at(c));
    if (piece.try_emplace(t.info(c).region, set).first->second != set) return StarFault::split_region;
  }
  for (const auto& [region, set] : piece) {
    std::vector<Arc> rim;
    for (const auto& [regions, arcs] : borders) {
      if (regions.first == region || regions.second == region) rim.insert(rim.end(), arcs.begin(), arcs.end());
    }
    if (!is_one_path(rim, true)) return StarFault::ringed_region;
  }
  for (const auto& [regions, arcs] : borders) {
    if (!is_one_path(arcs, false)) return StarFault::split_patch;
  }
  return StarFault::none;
}

}  // namespace scantet::engine
