#include "scantet/app/mesh_faults.h"

#include <algorithm>
#include <limits>

namespace scantet {
namespace {

constexpr std::size_t kSomeSpots = 20;     // an attempt must not leave more of them, and
constexpr std::size_t kFarMore = 2;        // times as many as the best before, or it was the last
constexpr std::size_t kManyFaults = 1000;  // nor more of these, if the best before had
constexpr std::size_t kFarFewer = 10;      // times fewer
constexpr std::size_t kMostByChance = 20;  // losses without a place that may come right in another attempt
// Without curves elements get a size of their own if no more are out of bounds, if little is lost:
constexpr std::size_t kFewElements = 30;
constexpr std::size_t kSomeElements = 150;
constexpr double kLeastOwnOfRibbons = 1e-4;  // as thin as a saddle is near the level
constexpr double kFewFaults = 0.01;          // of all tets: if there are more, it is not for the boundary's sake
constexpr std::size_t kFewOfLabels = 1000;   // of a segmentation, which may have few tets

/// Where the boundary is not like the domain's.
std::vector<Point> tangles(const Meshing& meshing) {
  if (meshing.lost) return meshing.lost->places;
  std::vector<Point> places = meshing.refined.tangled;
  if (meshing.loss_count) {
    const LossCount& lost = *meshing.loss_count;
    places.insert(places.end(), lost.curve_gaps.begin(), lost.curve_gaps.end());
    places.insert(places.end(), lost.small_parts.begin(), lost.small_parts.end());
  }
  return places;
}

bool has_few_losses(const Meshing& meshing) {
  return meshing.loss_count && meshing.loss_count->count > 0 && meshing.loss_count->count <= kFewLosses;
}

/// Whether of the topology a little is lost, all of it without a place, as handles are.
bool has_lost_only_handles(const Meshing& meshing, const MeshFaults& faults) {
  return has_few_losses(meshing) && faults.losses.empty() && meshing.lost_parts.empty();
}

/// What is lost of the topology beside tangles, which have places.
std::size_t losses_elsewhere(const Meshing& meshing) {
  if (!meshing.loss_count) return meshing.refined.wrong_handle_count;
  const LossCount& lost = *meshing.loss_count;
  return lost.count - std::min<std::size_t>(lost.count, lost.small_parts.size());
}

/// Where handles may be wrong, if the Euler number is another, or else if the count tells that one is there for
/// another.
std::vector<Point> doubtful_handles(const Meshing& meshing) {
  const MeshResult& mesh = meshing.refined;
  return mesh.wrong_handles.empty() && has_few_losses(meshing) ? mesh.exchanged_handles : mesh.wrong_handles;
}

std::size_t element_faults(const Meshing& meshing) {
  const std::size_t turned = has_few_losses(meshing) && !meshing.refined.turned.empty() ? 1 : 0;  // one of them may be
  return meshing.conformance.places.size() + meshing.crossings.size() + tangles(meshing).size() +
         doubtful_handles(meshing).size() + turned + meshing.lost_parts.size() + meshing.searched.size();
}

void add_crossings(const Meshing& meshing, std::vector<Point>& places) {
  const TetMesh& mesh = meshing.refined.mesh;
  for (const std::uint32_t f : meshing.crossings) places.push_back(mesh.vertices[mesh.boundary_facets[f][0]]);
}

std::size_t distance_faults(const Meshing& meshing) {
  return meshing.distance ? far_parts(*meshing.distance) : 0;
}

bool are_few(std::size_t faults, const Meshing& meshing) {
  if (meshing.lost && faults <= kFewOfLabels) return true;
  return static_cast<double>(faults) <= kFewFaults * static_cast<double>(meshing.refined.mesh.tets.size());
}

}  // namespace

std::size_t far_parts(const BoundaryDistance& distance) {
  return distance.to_mesh.beyond.size() + distance.to_domain.beyond.size();
}

MeshFaults mesh_faults(const Meshing& meshing, bool has_curves) {
  MeshFaults faults{tangles(meshing), {}, doubtful_handles(meshing)};
  add_crossings(meshing, faults.losses);
  if (meshing.loss_count) {
    const std::vector<Point>& places = meshing.loss_count->in_small_parts;
    faults.handles.insert(faults.handles.end(), places.begin(), places.end());
  }
  // Most of what the first mesh leaves is mended by elements of half the size.
  const bool may_be_ribbons = !has_curves && !meshing.finer.empty();
  const bool is_little_lost = may_be_ribbons && faults_of(meshing, faults, 0).losses <= kFewLosses;
  if (is_little_lost) faults.least_own = kLeastOwnOfRibbons;
  const std::vector<Point>& elements = meshing.conformance.places;
  const std::vector<double>& edges_mm = meshing.conformance.edges_mm;
  const bool have_sizes = has_curves || elements.size() <= (is_little_lost ? kSomeElements : kFewElements);
  const double of_edge = have_sizes ? 0.6 : std::numeric_limits<double>::infinity();  // a regular tet's circumradius
  for (std::size_t n = 0; n < elements.size(); ++n) faults.elements.push_back({elements[n], of_edge * edges_mm[n]});
  return faults;
}

bool has_several_wrong_handles(const Meshing& meshing) {
  const std::uint64_t count = meshing.refined.wrong_handle_count;
  return count > kFewLosses && count <= kMostByChance;
}

bool has_only_wrong_handles(const Meshing& meshing, const MeshFaults& faults) {
  return has_lost_only_handles(meshing, faults) && faults.elements.empty();
}

bool has_exchanged_handles(const Meshing& meshing, const MeshFaults& faults) {
  return has_lost_only_handles(meshing, faults) && meshing.refined.wrong_handle_count == 0;
}

Faults faults_of(const Meshing& meshing, const MeshFaults& faults, std::size_t spots) {
  // Of handles no place is known, only where one may be.
  const std::size_t lost = losses_elsewhere(meshing);
  const std::size_t beside = lost + meshing.lost_parts.size() + meshing.searched.size() + distance_faults(meshing);
  double lost_mm = 0;
  for (const FarPlace& part : meshing.lost_parts) lost_mm += part.distance_mm;
  const std::size_t losses = faults.losses.size() + lost + meshing.lost_parts.size();
  const std::size_t all = losses + faults.elements.size() + meshing.searched.size() + distance_faults(meshing);
  return {losses, spots + beside, all, lost_mm};
}

Faults faults_in(const Meshing& meshing) {
  return faults_of(meshing, mesh_faults(meshing, false), 0);
}

std::vector<Point> fault_places(const Meshing& meshing) {
  std::vector<Point> places = tangles(meshing);
  add_crossings(meshing, places);
  places.insert(places.end(), meshing.conformance.places.begin(), meshing.conformance.places.end());
  for (const FarPlace& part : meshing.lost_parts) places.push_back(part.point);
  return places;
}

bool finer_may_help(const Meshing& meshing, bool was_near) {
  const std::size_t faults = element_faults(meshing) + (was_near ? distance_faults(meshing) : 0);
  return meshing.refined.stop == Stop::converged && !meshing.refined.is_beyond_mending && faults > 0 &&
         are_few(faults - meshing.searched.size(), meshing);
}

bool has_only_lost(const Faults& best, const Faults& last) {
  return last.losses > kMostByChance && last.losses == last.all && 10 * last.losses > 9 * best.losses;
}

bool is_worse_by_far(const Faults& best, const Faults& last) {
  const bool has_more_spots = last.spots > kSomeSpots && last.spots > kFarMore * best.spots;
  return has_more_spots || (last.all > kManyFaults && last.all > kFarFewer * best.all);
}

}  // namespace scantet
