#include <algorithm>

#include "scantet/base/parallel.h"
#include "scantet/refine/pieces_impl.h"

namespace scantet::refine {

std::vector<FacetCode> boundary_facets(const RestrictedTriangulation& restricted) {
  const Triangulation& t = restricted.triangulation();
  constexpr std::size_t kGrain = 8192;
  std::vector<std::vector<FacetCode>> found((t.cell_slots() + kGrain - 1) / kGrain);
  parallel_for(t.cell_slots(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (auto c = static_cast<CellId>(begin); c < end; ++c) {
      if (!t.is_cell(c)) continue;
      const CellInfo& info = t.info(c);
      for (std::uint32_t i = 0; i < 4; ++i) {
        if (info.balls[i] == kNone || t.info(t.cell(c).neighbor[i] / 4).region == info.region) continue;
        found[begin / kGrain].push_back(4 * c + i);
      }
    }
  });
  std::vector<FacetCode> facets;
  for (const auto& list : found) facets.insert(facets.end(), list.begin(), list.end());
  return facets;
}

bool surfaces_are_whole(const RestrictedTriangulation& restricted, const std::vector<FacetCode>& facets) {
  const Triangulation& t = restricted.triangulation();
  UnionFind sets(t.vertex_slots());
  for (const FacetCode facet : facets) {
    const auto v = facet_vertices(t.cell(facet / 4), static_cast<int>(facet % 4));
    for (const PointId vertex : v) {
      if (!t.vertex(vertex).has_disk) return false;
    }
    sets.unite(v[0], v[1]);
    sets.unite(v[0], v[2]);
  }
  std::map<BoundaryId, std::uint32_t> surface;
  return std::all_of(facets.begin(), facets.end(), [&](FacetCode facet) {
    const std::uint32_t set = sets.find(facet_vertices(t.cell(facet / 4), static_cast<int>(facet % 4))[0]);
    return surface.try_emplace(boundary_of(restricted, facet), set).first->second == set;
  });
}

Pieces::Pieces(const RestrictedTriangulation& restricted, const std::vector<FacetCode>& facets)
    : t_(restricted), sets_(restricted.triangulation().cell_slots()) {
  const Triangulation& t = t_.triangulation();
  for (CellId c = 0; c < t.cell_slots(); ++c) {
    if (!t.is_cell(c)) continue;
    for (const FacetCode across : t.cell(c).neighbor) {
      if (across < 4 * c && t.info(across / 4).region == t.info(c).region) sets_.unite(c, across / 4);
    }
  }
  std::vector<std::uint32_t> size(t.cell_slots(), 0);
  for (CellId c = 0; c < t.cell_slots(); ++c) {
    if (t.is_cell(c)) ++size[of(c)];
  }
  for (const FacetCode facet : facets) {
    const std::uint32_t piece = of(facet / 4);
    auto& main = main_.try_emplace({boundary_of(t_, facet), t.info(facet / 4).region}, piece).first->second;
    if (size[piece] > size[main]) main = piece;
  }
}

bool Pieces::is_side_piece(FacetCode facet) {
  const CellId c = facet / 4;
  return main_.at({boundary_of(t_, facet), t_.triangulation().info(c).region}) != of(c);
}

}  // namespace scantet::refine
