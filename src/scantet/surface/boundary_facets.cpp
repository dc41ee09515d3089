// Facets are told by their vertices: those of which a vertex has changed go, and those around such vertices come.
#include <algorithm>

#include "scantet/base/parallel.h"
#include "scantet/surface/boundary_facets_impl.h"

namespace scantet::engine {
namespace {

constexpr std::size_t kGrain = 8192;

/// The boundary facets that have one of the vertices. is_changed: by vertex.
std::vector<FacetCode> facets_around(const Triangulation& t, const std::vector<PointId>& changed,
                                     const std::vector<std::uint8_t>& is_changed) {
  constexpr std::size_t kVertices = 256;
  return parallel_collect<FacetCode>(changed.size(), kVertices, [&](std::size_t begin, std::size_t end, auto& facets) {
    std::vector<CellId> star;
    for (std::size_t n = begin; n < end; ++n) {
      const PointId v = changed[n];
      t.star_of(v, star);
      const auto comes_at_another = [&](PointId other) { return other < v && is_changed[other] != 0; };
      for (const CellId c : star) {
        const Region here = t.info(c).region;
        if (here == kOutside) continue;
        for (FacetCode facet = 4 * c; facet < 4 * c + 4; ++facet) {
          if (t.cell(c).vertex[facet % 4] == v) continue;
          if (!is_seen_from(here, t.info(t.cell(c).neighbor[facet % 4] / 4).region)) continue;
          const auto corners = facet_vertices(t.cell(c), static_cast<int>(facet % 4));
          if (std::none_of(corners.begin(), corners.end(), comes_at_another)) facets.push_back(facet);
        }
      }
    }
  });
}

}  // namespace

std::vector<FacetCode> boundary_facets(const Triangulation& t) {
  return parallel_collect<FacetCode>(t.cell_slots(), kGrain,
                                     [&](std::size_t begin, std::size_t end, std::vector<FacetCode>& facets) {
                                       for (auto c = static_cast<CellId>(begin); c < end; ++c) {
                                         if (!t.is_cell(c) || t.info(c).region == kOutside) continue;
                                         for (std::uint32_t i = 0; i < 4; ++i) {
                                           const Region beyond = t.info(t.cell(c).neighbor[i] / 4).region;
                                           if (is_seen_from(t.info(c).region, beyond)) facets.push_back(4 * c + i);
                                         }
                                       }
                                     });
}

void BoundaryFacets::set(const RestrictedTriangulation& t, std::vector<FacetCode> facets) {
  codes = std::move(facets);
  resize(codes.size());
  parallel_for(codes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) look_at(t, n);
  });
}

void BoundaryFacets::resize(std::size_t count) {
  codes.resize(count);
  corners.resize(count);
  patches.resize(count);
  is_inner.resize(count);
}

void BoundaryFacets::look_at(const RestrictedTriangulation& restricted, std::size_t place) {
  const Triangulation& t = restricted.triangulation();
  const FacetCode facet = codes[place];
  const Cell& cell = t.cell(facet / 4);
  corners[place] = facet_vertices(cell, static_cast<int>(facet % 4));
  patches[place] = patch_of(restricted, facet);
  is_inner[place] = t.info(cell.neighbor[facet % 4] / 4).region == kOutside ? 0 : 1;
}

void BoundaryFacets::update(const RestrictedTriangulation& t, const std::vector<PointId>& changed) {
  std::vector<std::uint8_t> is_changed(t.triangulation().vertex_slots(), 0);
  for (const PointId v : changed) is_changed[v] = 1;
  const std::vector<std::uint32_t> gone =
      parallel_collect<std::uint32_t>(codes.size(), kGrain, [&](std::size_t begin, std::size_t end, auto& found) {
        for (std::size_t n = begin; n < end; ++n) {
          const auto& [a, b, c] = corners[n];
          if ((is_changed[a] | is_changed[b] | is_changed[c]) != 0) found.push_back(static_cast<std::uint32_t>(n));
        }
      });
  const std::vector<FacetCode> come = facets_around(t.triangulation(), changed, is_changed);
  const std::size_t kept = codes.size() - gone.size();
  if (come.size() > gone.size()) resize(kept + come.size());
  for (std::size_t n = 0; n < come.size(); ++n) {
    const std::size_t place = n < gone.size() ? gone[n] : kept + n;
    codes[place] = come[n];
    look_at(t, place);
  }
  std::size_t count = std::max(codes.size(), kept + come.size());
  for (std::size_t n = gone.size(); n > come.size(); --n) {  // the last facets take the places that are left
    --count;
    codes[gone[n - 1]] = codes[count];
    corners[gone[n - 1]] = corners[count];
    patches[gone[n - 1]] = patches[count];
    is_inner[gone[n - 1]] = is_inner[count];
  }
  resize(count);
}

}  // namespace scantet::engine
