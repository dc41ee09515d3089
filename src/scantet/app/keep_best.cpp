#include "scantet/app/keep_best.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "scantet/app/graft.h"
#include "scantet/app/mesh_faults.h"
#include "scantet/domain/patch_pieces.h"

namespace scantet {
namespace {

constexpr double kReach = 2;  // sizes, around what is put into the best mesh

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

/// Around places where sizes differ or something is wrong.
std::vector<GraftSite> sites_of(const Meshing& best, const std::vector<FinerPlace>& finer, const SizingField& size) {
  std::vector<GraftSite> sites;
  const auto add = [&](const Point& p) { sites.push_back({p, kReach * size.size_at(p)}); };
  for (const FinerPlace& place : differing(best.finer, finer)) add(place.point);
  for (const Point& p : fault_places(best)) add(p);
  if (best.lost) {
    for (const NarrowWay& way : best.lost->ways) add(way.segment.source);
  }
  return sites;
}

}  // namespace

bool keep_best(const Meshing& best, const Domain& domain, const SizingField& size, Meshing& meshing) {
  const std::vector<GraftSite> sites = sites_of(best, meshing.finer, size);
  std::optional<TetMesh> grafted = graft(best.refined.mesh, meshing.refined.mesh, sites);
  if (!grafted) return false;
  meshing.refined.mesh = std::move(*grafted);
  part_patches(meshing.refined.mesh, domain);
  return true;
}

}  // namespace scantet
