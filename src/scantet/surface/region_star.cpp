// The cells around a vertex are triangles on a small sphere around it, and the regions a map on that sphere. A country
// of the map is a disk if and only if its rim is one closed path that passes no place twice: of what such a path parts
// the sphere into, each arc has the country on one side. A border between two countries, the arcs where they meet, must
// hang together, too: it is one path, as parts of two rims are, if it has at most one place more than arcs.
#include <algorithm>
#include <utility>

#include "scantet/surface/region_star_impl.h"

namespace scantet::engine {
namespace {

/// An arc of the map between two regions, the smaller one first.
struct Arc {
  std::pair<Region, Region> regions;
  LinkEdge ends;
};

std::vector<Arc> arcs_around(const Triangulation& t, PointId v, std::span<const CellId> star) {
  std::vector<Arc> arcs;
  arcs.reserve(star.size());
  for (const CellId c : star) {
    const Cell& cell = t.cell(c);
    const Region here = t.info(c).region;
    for (std::size_t i = 0; i < 4; ++i) {
      if (cell.vertex[i] == v) continue;  // the facet across from v
      const Region there = t.info(cell.neighbor[i] / 4).region;
      if (here >= there) continue;  // seen from the other side
      const auto corners = facet_vertices(cell, static_cast<int>(i));
      const std::size_t own = corners[0] == v ? 0 : corners[1] == v ? 1 : 2;
      arcs.push_back({{here, there}, {corners[(own + 1) % 3], corners[(own + 2) % 3]}});
    }
  }
  return arcs;
}

/// Whether the arcs between two regions hang together. ends: for a list of their ends.
bool is_one_path(std::span<const Arc> border, std::vector<PointId>& ends) {
  ends.clear();
  for (const Arc& arc : border) ends.insert(ends.end(), arc.ends.begin(), arc.ends.end());
  std::sort(ends.begin(), ends.end());
  const auto places = static_cast<std::size_t>(std::unique(ends.begin(), ends.end()) - ends.begin());
  return places <= border.size() + 1;
}

}  // namespace

bool is_one_cycle(std::span<LinkEdge> edges) {
  const std::size_t count = edges.size();
  if (count < 3) return false;
  // The path is put in order from the first edge on: each step swaps the one edge that goes on into its place.
  for (std::size_t i = 0; i + 1 < count; ++i) {
    std::size_t found = 0;
    for (std::size_t j = i + 1; j < count; ++j) {
      if (edges[j][0] != edges[i][1] && edges[j][1] != edges[i][1]) continue;
      if (++found > 1) return false;
      std::swap(edges[i + 1], edges[j]);
    }
    if (found == 0) return false;
    if (edges[i + 1][0] != edges[i][1]) std::swap(edges[i + 1][0], edges[i + 1][1]);
  }
  return edges[count - 1][1] == edges[0][0];
}

bool regions_meet_well(const Triangulation& t, PointId v, std::span<const CellId> star) {
  std::vector<Arc> arcs = arcs_around(t, v, star);
  std::vector<LinkEdge> rim;
  rim.reserve(arcs.size());
  std::vector<Region> looked_at;
  for (const Arc& first : arcs) {
    for (const Region region : {first.regions.first, first.regions.second}) {
      if (std::find(looked_at.begin(), looked_at.end(), region) != looked_at.end()) continue;
      looked_at.push_back(region);
      rim.clear();
      for (const Arc& arc : arcs) {
        if (arc.regions.first == region || arc.regions.second == region) rim.push_back(arc.ends);
      }
      if (!is_one_cycle(rim)) return false;
    }
  }
  std::sort(arcs.begin(), arcs.end(), [](const Arc& a, const Arc& b) { return a.regions < b.regions; });
  std::vector<PointId> ends;
  for (auto begin = arcs.begin(); begin != arcs.end();) {
    const auto end = std::find_if(begin, arcs.end(), [&](const Arc& arc) { return arc.regions != begin->regions; });
    if (!is_one_path({begin, end}, ends)) return false;
    begin = end;
  }
  return true;
}

}  // namespace scantet::engine
