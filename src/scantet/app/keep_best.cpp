#include "scantet/app/keep_best.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "scantet/app/graft.h"
#include "scantet/app/mesh_faults.h"
#include "scantet/domain/patch_pieces.h"

namespace scantet {
namespace {

constexpr std::array kReaches{2.0, 5.0};  // sizes, around what is put into the best mesh

/// Places of one list alone.
std::vector<FinerPlace> differing(std::vector<FinerPlace> a, std::vector<FinerPlace> b) {
  const auto less = [](const FinerPlace& one, const FinerPlace& other) {
    return one.point == other.point ? one.size_mm < other.size_mm : lexicographically_less(one.point, other.point);
  };
  std::sort(a.begin(), a.end(), less);
  std::sort(b.begin(), b.end(), less);
  std::vector<FinerPlace> places;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(places), less);
  return places;
}

/// Of a boundary that is a manifold twice its Euler number: it has three edges for two facets.
std::int64_t twice_euler(const TetMesh& mesh) {
  const auto on_boundary = [](const Stratum& stratum) { return stratum.on_boundary(); };
  return 2 * std::count_if(mesh.strata.begin(), mesh.strata.end(), on_boundary) -
         static_cast<std::int64_t>(mesh.boundary_facets.size());
}

/// What MeshResult::missing_euler is of another mesh of the domain.
std::optional<std::int64_t> missing_euler(const TetMesh& other, const MeshResult& result) {
  if (!result.missing_euler) return std::nullopt;
  return *result.missing_euler + (twice_euler(result.mesh) - twice_euler(other)) / 2;
}

/// Around places where sizes differ or something is wrong, as far as so many sizes.
std::vector<GraftSite> sites_of(const Meshing& best, const std::vector<FinerPlace>& finer, bool has_curves,
                                const SizingField& size, double reach) {
  std::vector<GraftSite> sites;
  const auto add = [&](const Point& p) { sites.push_back({p, reach * size.size_at(p)}); };
  for (const FinerPlace& place : differing(best.finer, finer)) add(place.point);
  const MeshFaults faults = mesh_faults(best, has_curves);
  for (const Point& p : faults.losses) add(p);
  for (const FinerPlace& place : faults.elements) add(place.point);
  for (const FarPlace& part : best.lost_parts) add(part.point);
  return sites;
}

}  // namespace

bool keep_best(const Meshing& best, const Domain& domain, const SizingField& size, Meshing& meshing) {
  MeshResult& fresh = meshing.refined;
  const bool has_curves = !domain.curves().empty();
  for (const double reach : kReaches) {
    const std::vector<GraftSite> sites = sites_of(best, meshing.finer, has_curves, size, reach);
    std::optional<TetMesh> grafted = graft(best.refined.mesh, fresh.mesh, sites);
    if (!grafted) return false;
    const std::optional<std::int64_t> missing = missing_euler(*grafted, fresh);
    if (missing.value_or(0) != 0) continue;
    fresh.missing_euler = missing;
    fresh.wrong_handles.clear();
    fresh.mesh = std::move(*grafted);
    part_patches(fresh.mesh, domain);
    return true;
  }
  return false;
}

}  // namespace scantet
