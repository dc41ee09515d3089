#include <algorithm>

#include "scantet/refine/pieces_impl.h"

namespace scantet::refine {

bool has_disks(const Triangulation& t, const std::vector<FacetCode>& facets) {
  return std::all_of(facets.begin(), facets.end(), [&](FacetCode facet) {
    const auto v = facet_vertices(t.cell(facet / 4), static_cast<int>(facet % 4));
    return std::all_of(v.begin(), v.end(), [&](PointId vertex) { return t.vertex(vertex).has_disk; });
  });
}

bool has_one_surface_each(const RestrictedTriangulation& restricted, const std::vector<FacetCode>& facets) {
  const Triangulation& t = restricted.triangulation();
  UnionFind sets(t.vertex_slots());
  for (const FacetCode facet : facets) {
    const auto v = facet_vertices(t.cell(facet / 4), static_cast<int>(facet % 4));
    sets.unite(v[0], v[1]);
    sets.unite(v[0], v[2]);
  }
  std::map<std::optional<BoundaryId>, std::uint32_t> surface;
  std::optional<BoundaryId> last;  // facets in a row are often on one surface
  std::uint32_t last_set = kNone;
  return std::all_of(facets.begin(), facets.end(), [&](FacetCode facet) {
    const std::uint32_t set = sets.find(facet_vertices(t.cell(facet / 4), static_cast<int>(facet % 4))[0]);
    const std::optional<BoundaryId> boundary = boundary_of(restricted, facet);
    if (set == last_set && boundary == last) return true;
    last = boundary;
    last_set = set;
    return surface.try_emplace(boundary, set).first->second == set;
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
    const auto boundary = boundary_of(t_, facet);
    if (!boundary) continue;
    for (const CellId c : {facet / 4, t.cell(facet / 4).neighbor[facet % 4] / 4}) {
      const std::uint32_t piece = of(c);
      auto& main = main_.try_emplace({boundary, t.info(c).region}, piece).first->second;
      if (size[piece] > size[main]) main = piece;
    }
  }
}

bool Pieces::is_side_piece(FacetCode facet) {
  const CellId c = facet / 4;
  const auto boundary = boundary_of(t_, facet);
  return boundary && main_.at({boundary, t_.triangulation().info(c).region}) != of(c);
}

}  // namespace scantet::refine
