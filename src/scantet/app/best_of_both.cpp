#include "scantet/app/best_of_both.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "scantet/app/graft.h"
#include "scantet/app/mesh_faults.h"
#include "scantet/domain/patch_pieces.h"

namespace scantet {
namespace {

constexpr double kReach = 2;         // sizes, around what is taken
constexpr double kWithoutFault = 4;  // sizes, around that in the mesh it is taken from

std::vector<Point> fault_places(const Meshing& meshing, bool has_curves) {
  MeshFaults faults = mesh_faults(meshing, has_curves);
  std::vector<Point> places = std::move(faults.losses);
  for (const FinerPlace& place : faults.elements) places.push_back(place.point);
  for (const FarPlace& part : meshing.lost_parts) places.push_back(part.point);
  return places;
}

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
template <class Place, class PointOf>
void take(const std::vector<Place>& from, const std::vector<GraftSite>& sites, const PointOf& point_of,
          std::vector<Place>& into) {
  std::erase_if(into, [&](const Place& place) { return is_in(point_of(place), sites); });
  for (const Place& place : from) {
    if (is_in(point_of(place), sites)) into.push_back(place);
  }
}

}  // namespace

std::optional<Meshing> best_of_both(const Meshing& one, const Meshing& other, const Domain& domain,
                                    const SizingField& size) {
  const bool has_curves = !domain.curves().empty();
  const std::vector<Point> wrong_in_one = fault_places(one, has_curves);
  const std::vector<Point> wrong_in_other = fault_places(other, has_curves);
  const bool is_one = wrong_in_one.size() <= wrong_in_other.size();
  const Meshing& from = is_one ? other : one;
  const std::vector<GraftSite> sites =
      is_one ? sites_of(wrong_in_one, wrong_in_other, size) : sites_of(wrong_in_other, wrong_in_one, size);
  std::optional<TetMesh> mesh = graft((is_one ? one : other).refined.mesh, from.refined.mesh, sites);
  if (!mesh) return std::nullopt;
  Meshing both = is_one ? one : other;
  both.refined.mesh = std::move(*mesh);
  part_patches(both.refined.mesh, domain);
  const auto itself = [](const Point& p) { return p; };
  take(
      from.finer, sites, [](const FinerPlace& place) { return place.point; }, both.finer);
  take(from.refined.tangled, sites, itself, both.refined.tangled);
  take(from.refined.merged_curves, sites, itself, both.refined.merged_curves);
  take(from.refined.exchanged_handles, sites, itself, both.refined.exchanged_handles);
  // Nobody knows at which of them a handle is wrong.
  std::vector<Point>& handles = both.refined.wrong_handles;
  handles.insert(handles.end(), from.refined.wrong_handles.begin(), from.refined.wrong_handles.end());
  return both;
}

}  // namespace scantet
