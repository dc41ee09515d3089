// The cells around a vertex are triangles on a small sphere around it, and the regions a map on that sphere. A part of
// a sphere that hangs together is a disk if and only if its rim is one closed path; the whole sphere has no rim. A
// border between two countries of the map, the arcs where they meet, must hang together, too.
#include <algorithm>
#include <array>
#include <iterator>
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

/// Numbers what it is asked for, from 0 on, in the order in which it is asked. Quick for the few tens around a vertex.
template <class Key>
class Numbers {
 public:
  std::uint32_t of(const Key& key) {
    const auto place = static_cast<std::uint32_t>(std::find(keys_.begin(), keys_.end(), key) - keys_.begin());
    if (place == keys_.size()) keys_.push_back(key);
    return place;
  }
  const std::vector<Key>& keys() const { return keys_; }

 private:
  std::vector<Key> keys_;
};

/// Whether the arcs form one closed path, or one path, that no vertex has more than two arcs of.
bool is_one_path(std::span<const Arc> arcs, bool must_close) {
  Numbers<PointId> numbers;
  std::vector<std::array<std::uint32_t, 2>> ends;
  for (const Arc& arc : arcs) {
    const std::uint32_t a = numbers.of(arc.a);
    ends.push_back({a, numbers.of(arc.b)});
  }
  UnionFind joined(numbers.keys().size());
  std::vector<int> arcs_at(numbers.keys().size(), 0);
  for (const auto& [a, b] : ends) {
    joined.unite(a, b);
    ++arcs_at[a];
    ++arcs_at[b];
  }
  for (std::uint32_t n = 0; n < arcs_at.size(); ++n) {
    if (joined.find(n) != joined.find(0) || arcs_at[n] > 2 || (must_close && arcs_at[n] != 2)) return false;
  }
  return true;
}

}  // namespace

StarFault fault_of_star(const Triangulation& t, PointId v, std::span<const CellId> star) {
  std::vector<std::pair<CellId, std::uint32_t>> places;
  for (const CellId c : star) places.emplace_back(c, static_cast<std::uint32_t>(places.size()));
  std::sort(places.begin(), places.end());
  const auto place = [&](CellId c) { return std::lower_bound(places.begin(), places.end(), std::pair(c, 0U))->second; };
  UnionFind joined(star.size());
  std::vector<Arc> arcs;
  for (std::uint32_t k = 0; k < star.size(); ++k) {
    const Cell& cell = t.cell(star[k]);
    const Region here = t.info(star[k]).region;
    for (std::size_t i = 0; i < 4; ++i) {
      if (cell.vertex[i] == v) continue;  // the facet across from v
      const CellId next = cell.neighbor[i] / 4;
      const Region there = t.info(next).region;
      if (here == there && star[k] < next) joined.unite(k, place(next));
      if (here >= there) continue;  // seen from the other side
      Arc arc{{here, there}, kNone, kNone};
      for (const PointId corner : facet_vertices(cell, static_cast<int>(i))) {
        if (corner != v) (arc.a == kNone ? arc.a : arc.b) = corner;
      }
      arcs.push_back(arc);
    }
  }
  Numbers<Region> regions;
  std::vector<std::uint32_t> pieces;  // of each region
  for (std::uint32_t k = 0; k < star.size(); ++k) {
    const std::uint32_t region = regions.of(t.info(star[k]).region);
    if (region == pieces.size()) pieces.push_back(joined.find(k));
    if (pieces[region] != joined.find(k)) return StarFault::split_region;
  }
  std::vector<Arc> rim;
  for (const Region region : regions.keys()) {
    rim.clear();
    std::copy_if(arcs.begin(), arcs.end(), std::back_inserter(rim),
                 [&](const Arc& arc) { return arc.regions.first == region || arc.regions.second == region; });
    if (!is_one_path(rim, true)) return StarFault::ringed_region;
  }
  std::sort(arcs.begin(), arcs.end(), [](const Arc& a, const Arc& b) { return a.regions < b.regions; });
  for (auto begin = arcs.begin(); begin != arcs.end();) {
    const auto end = std::find_if(begin, arcs.end(), [&](const Arc& arc) { return arc.regions != begin->regions; });
    if (!is_one_path({begin, end}, false)) return StarFault::split_patch;
    begin = end;
  }
  return StarFault::none;
}

}  // namespace scantet::engine
