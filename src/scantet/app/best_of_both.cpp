#include "scantet/app/best_of_both.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "scantet/app/graft.h"
#include "scantet/app/mesh_faults.h"
#include "scantet/domain/patch_pieces.h"

namespace scantet {
namespace {

constexpr double kReach = 2;         // sizes, around what is taken
constexpr double kWithoutFault = 4;  // sizes, around that in the mesh it is taken from

bool is_near(const Point& p, const std::vector<Point>& places, double radius_mm) {
  return std::any_of(places.begin(), places.end(), [&](const Point& q) { return distance(p, q) <= radius_mm; });
}

/// Where `from` has nothing wrong, unlike what it is put into.
std::vector<GraftSite> sites_of(const std::vector<Point>& wrong, const std::vector<Point>& wrong_in_from,
                                const SizingField& size) {
  std::vector<GraftSite> sites;
  for (const Point& p : wrong) {
    const double size_mm = size.size_at(p);
    if (!is_near(p, wrong_in_from, kWithoutFault * size_mm)) sites.push_back({p, kReach * size_mm});
  }
  return sites;
}

bool is_in(const Point& p, const std::vector<GraftSite>& sites) {
  return std::any_of(sites.begin(), sites.end(),
                     [&](const GraftSite& site) { return distance(p, site.center) <= site.radius_mm; });
}

/// Of `into` what is at no site, and of `from` what is at one.
void take(const std::vector<Point>& from, const std::vector<GraftSite>& sites, std::vector<Point>& into) {
  std::erase_if(into, [&](const Point& p) { return is_in(p, sites); });
  std::copy_if(from.begin(), from.end(), std::back_inserter(into), [&](const Point& p) { return is_in(p, sites); });
}

}  // namespace

std::optional<Meshing> best_of_both(const Meshing& one, const Meshing& other, const Domain& domain,
                                    const SizingField& size) {
  const bool is_one = faults_in(one) <= faults_in(other);
  const Meshing& into = is_one ? one : other;
  const Meshing& from = is_one ? other : one;
  std::vector<GraftSite> sites = sites_of(fault_places(into), fault_places(from), size);
  std::int64_t missing_euler = 0;
  if (into.loss_count && into.loss_count->missing_euler != 0) {
    missing_euler = into.loss_count->missing_euler / 2;  // of the inside
    for (const Meshing* const meshing : {&into, &from}) {
      for (const Point& p : meshing->refined.wrong_handles) sites.push_back({p, kReach * size.size_at(p)});
    }
  }
  std::optional<TetMesh> mesh = graft(into.refined.mesh, from.refined.mesh, sites, missing_euler);
  if (!mesh) return std::nullopt;
  Meshing both = into;
  both.refined.mesh = std::move(*mesh);
  part_patches(both.refined.mesh, domain);
  // What comes from the other mesh may be coarser than `into` had to be; nothing is coarser than was asked for.
  std::erase_if(both.finer, [&](const FinerPlace& place) { return is_in(place.point, sites); });
  take(from.refined.tangled, sites, both.refined.tangled);
  take(from.refined.merged_curves, sites, both.refined.merged_curves);
  take(from.refined.exchanged_handles, sites, both.refined.exchanged_handles);
  std::vector<Point>& handles = both.refined.wrong_handles;
  handles.insert(handles.end(), from.refined.wrong_handles.begin(), from.refined.wrong_handles.end());
  both.refined.stages = other.refined.stages;
  both.refined.sample_s = other.refined.sample_s;
  both.refined.refine_s = other.refined.refine_s;
  both.phases.clear();
  return both;
}

}  // namespace scantet
