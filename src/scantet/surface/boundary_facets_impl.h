// Private: the facets of the triangulation between two regions.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scantet/surface/restricted_triangulation_impl.h"

namespace scantet::engine {

/// Whether a facet between these two regions is listed as seen from `here`: from the smaller that is not outside.
inline bool is_seen_from(Region here, Region beyond) {
  return here != kOutside && (beyond == kOutside || here < beyond);
}

/// The facets between two regions as seen from the one with the smaller number that is not outside, in the order of
/// their codes.
std::vector<FacetCode> boundary_facets(const Triangulation& t);

/// The patch of ∂O that a boundary facet approximates; none for one between tets that changed sides.
inline std::optional<Patch> patch_of(const RestrictedTriangulation& t, FacetCode facet) {
  const std::uint32_t ball = t.triangulation().info(facet / 4).balls[facet % 4];
  if (ball == kNone) return std::nullopt;
  return t.balls()[ball].patch;
}

/// Boundary facets, each with what is asked of it again and again.
struct BoundaryFacets {
  std::vector<FacetCode> codes;
  std::vector<std::array<PointId, 3>> corners;  ///< as facet_vertices() has them
  std::vector<std::optional<Patch>> patches;    ///< as patch_of() has them
  std::vector<std::uint8_t> is_inner;           ///< whether regions lie on both sides, none of them kOutside

  BoundaryFacets() = default;
  /// Those with these codes, in their order.
  BoundaryFacets(const RestrictedTriangulation& t, std::vector<FacetCode> facets) { set(t, std::move(facets)); }
  /// The same in place of those that were there; keeps the memory.
  void set(const RestrictedTriangulation& t, std::vector<FacetCode> facets);

  /// Has the place of facets that are no more taken by new ones. Before: all that boundary_facets() gave. changed:
  /// ascending, the vertices of which a facet has come or gone since, and maybe others. Return: all that it gives now,
  /// in any order.
  void update(const RestrictedTriangulation& t, const std::vector<PointId>& changed);

 private:
  void resize(std::size_t count);
  void look_at(const RestrictedTriangulation& restricted, std::size_t place);
};

}  // namespace scantet::engine
