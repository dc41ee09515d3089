// Means of a scan over tets by fluxes through their facets. Private to fields/.
#pragma once

#include <limits>

#include "scantet/base/parallel.h"
#include "scantet/base/tet_volume.h"
#include "scantet/fields/facet_fluxes_impl.h"
#include "scantet/fields/facet_stars_impl.h"
#include "scantet/fields/grid_pieces_impl.h"

namespace scantet {

/// Where the antiderivative of a tet begins: near its middle, so that nothing large is taken from something large. Less
/// than nothing if its mean is better found otherwise: if it reaches beyond the voxel centres, if few planes of the
/// grid meet it, or if it is so thin that rounding of the fluxes would show.
inline int flux_start(const IndexTet& tet, const std::array<int, 3>& size) {
  constexpr int kFewPlanes = 3;
  constexpr double kThin = 500;
  Vec low = tet[0], high = tet[0];
  for (const Vec& p : tet) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  double planes = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(low[axis] >= 0 && high[axis] <= size[static_cast<std::size_t>(axis)] - 1)) return -1;
    planes += std::floor(high[axis]) - std::floor(low[axis]);
  }
  if (planes < kFewPlanes) return -1;
  const Vec extent = high - low;
  if (!(3 * extent.y * extent.z * (extent.x + 2) < kThin * std::abs(tet_volume(tet)))) return -1;
  const double middle = 0.25 * ((tet[0].x + tet[1].x) + (tet[2].x + tet[3].x));
  return std::clamp(static_cast<int>(middle - 0.5), 0, size[0] - 2);
}

/// One per tet; not a number where it is to be found otherwise. places: of the vertices, in index space.
template <class Voxel>
std::vector<double> facet_means(const TetMesh& mesh, const std::vector<Vec>& places, const Scan& scan,
                                const Voxel* voxels) {
  constexpr std::size_t kTets = 4096;
  constexpr std::size_t kVertices = 256;
  const auto tet_at = [&](std::size_t t) {
    const Tet& tet = mesh.tets[t];
    return IndexTet{places[tet[0]], places[tet[1]], places[tet[2]], places[tet[3]]};
  };
  std::vector<int> start(mesh.tets.size());
  std::vector<std::uint8_t> is_chosen(mesh.tets.size());
  parallel_for(mesh.tets.size(), kTets, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      start[t] = flux_start(tet_at(t), scan.size);
      is_chosen[t] = start[t] >= 0 ? 1 : 0;
    }
  });
  std::vector<double> means(mesh.tets.size(), std::numeric_limits<double>::quiet_NaN());
  if (std::find(is_chosen.begin(), is_chosen.end(), 1) == is_chosen.end()) return means;

  const FacetStars stars(mesh, is_chosen);
  std::vector<std::array<double, 4>> fluxes(mesh.tets.size());
  parallel_for(mesh.vertices.size(), kVertices, [&](std::size_t begin, std::size_t end) {
    FacetFluxes<Voxel> through(scan, voxels);
    std::vector<FacetStars::Facet> here, all;
    for (std::size_t v = begin; v < end; ++v) {
      stars.facets_of(v, here);
      for (const FacetStars::Facet& facet : here) {
        const auto& [a, b, c] = facet.corners;
        through.add({places[a], places[b], places[c]},
                    {start[facet.sides[0].tet], start[facet.sides[facet.count - 1].tet]});
      }
      all.insert(all.end(), here.begin(), here.end());
    }
    through.finish();
    for (std::size_t f = 0; f < all.size(); ++f) {
      for (std::size_t s = 0; s < all[f].count; ++s) {
        const FacetSide& side = all[f].sides[s];
        const double flux = through.of(f).flux[s];
        fluxes[side.tet][side.facet] = side.is_turned ? -flux : flux;
      }
    }
  });
  parallel_for(mesh.tets.size(), kTets, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      if (is_chosen[t] == 0) continue;
      const std::array<double, 4>& f = fluxes[t];
      means[t] = ((f[0] + f[1]) + (f[2] + f[3])) / tet_volume(tet_at(t));
    }
  });
  return means;
}

}  // namespace scantet
