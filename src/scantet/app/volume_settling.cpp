// A mesh that keeps its bounds keeps them by little: where its vertices move by a hundredth of a voxel, some hundred
// elements break them. Improvement mends nearly all; around what it does not mend the boundary is left as it was. As
// the numbers that move it elsewhere do not depend on that, the next try differs there only.
#include "scantet/app/volume_settling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "scantet/base/parallel.h"
#include "scantet/base/stopwatch.h"
#include "scantet/base/tet_volume.h"
#include "scantet/check/facet_crossings.h"
#include "scantet/domain/nearest_crossing.h"

namespace scantet {
namespace {

std::map<Region, double> volumes_of(const TetMesh& mesh) {
  std::map<Region, double> volumes_mm3;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) volumes_mm3[mesh.tet_regions[t]] += tet_volume_mm3(mesh, t);
  return volumes_mm3;
}

/// What the facets around a vertex say of the boundary there.
struct Around {
  Vec normal;                                                    // of no length, out of the region behind
  double shortest_mm = std::numeric_limits<double>::infinity();  // of their edges
  std::array<Region, 2> regions{};                               // behind, in front
};

std::vector<Around> around_vertices(const TetMesh& mesh) {
  std::vector<Around> around(mesh.vertices.size());
  for (std::size_t f = 0; f < mesh.boundary_facets.size(); ++f) {
    const Triangle& facet = mesh.boundary_facets[f];
    const auto corner = [&](std::size_t n) { return mesh.vertices[facet[n % 3]]; };
    const Vec normal = cross(corner(1) - corner(0), corner(2) - corner(0));
    for (std::size_t n = 0; n < 3; ++n) {
      Around& at = around[facet[n]];
      at.normal = at.normal + normal;
      at.regions = mesh.facet_regions[f];
      for (std::size_t m = 1; m < 3; ++m) at.shortest_mm = std::min(at.shortest_mm, distance(corner(n), corner(n + m)));
    }
  }
  return around;
}

bool is_on_boundary(const Domain& domain, const Point& p) {
  constexpr double kMost = 1e-9;  // domains promise that residuals of crossings are no larger
  const std::optional<double> residual = domain.residual_at(p);
  return residual && std::abs(*residual) <= kMost;
}

/// The place on the domain's boundary between these regions that is nearest to p along the normal; p itself if it is on
/// the boundary.
std::optional<Point> place_of(const Domain& domain, const Point& p, const Around& around, Crossings& crossings) {
  if (is_on_boundary(domain, p)) return p;
  const double norm = length(around.normal);
  if (!(norm > 0)) return std::nullopt;
  for (const double share : {0.1, 0.5}) {
    const Vec reach = (share * around.shortest_mm / norm) * around.normal;
    domain.crossings({p - reach, p + reach}, crossings);
    const Crossing* const nearest = nearest_crossing(
        crossings, p, [&](const Crossing& c) { return c.from == around.regions[0] && c.to == around.regions[1]; });
    if (nearest != nullptr) return nearest->point;
  }
  return std::nullopt;
}

/// Puts the vertices on patches onto the boundary of the domain. Return: those that have no place near by, and those on
/// curves and at corners that are no longer on the boundary.
std::vector<Point> put_onto(const Domain& domain, const Domain& before, TetMesh& mesh) {
  constexpr std::size_t kGrain = 256;
  const std::vector<Around> around = around_vertices(mesh);
  const auto put = [&](std::size_t begin, std::size_t end, std::vector<Point>& lost) {
    Crossings crossings;
    for (std::size_t v = begin; v < end; ++v) {
      Point& p = mesh.vertices[v];
      if (mesh.strata[v].dimension < 2) {
        if (is_on_boundary(before, p) && !is_on_boundary(domain, p)) lost.push_back(p);
      } else if (mesh.strata[v].dimension == 2) {
        const std::optional<Point> place = place_of(domain, p, around[v], crossings);
        if (!place) lost.push_back(p);
        p = place.value_or(p);
      }
    }
  };
  return parallel_collect<Point>(mesh.vertices.size(), kGrain, put);
}

/// The vertices of tets that are turned over.
std::vector<Point> turned_over(const TetMesh& mesh) {
  constexpr std::size_t kGrain = 4096;
  const auto collect = [&](std::size_t begin, std::size_t end, std::vector<Point>& turned) {
    for (std::size_t t = begin; t < end; ++t) {
      if (tet_volume_mm3(mesh, t) > 0) continue;
      for (const VertexId v : mesh.tets[t]) turned.push_back(mesh.vertices[v]);
    }
  };
  return parallel_collect<Point>(mesh.tets.size(), kGrain, collect);
}

/// Whether it has more short edges. Where elements stay out of bounds each try shakes those, and edges beside them.
bool has_more_short_edges(const Meshing& now, const Meshing& before) {
  return before.conformance.places.empty() && now.conformance.min_edge.count > before.conformance.min_edge.count;
}

/// Whether the mesh is worse in any way that is promised.
bool is_worse(const Meshing& now, const Meshing& before) {
  return now.conformance.places.size() > before.conformance.places.size() || has_more_short_edges(now, before) ||
         now.crossings.size() > before.crossings.size() || now.searched.size() > before.searched.size() ||
         (now.lost && now.lost->places.size() > before.lost->places.size()) ||
         (now.layers && now.layers->broken > before.layers->broken) ||
         (before.distance && is_farther(*now.distance, *before.distance));
}

/// The vertices on patches that are no farther from a place than its distance.
std::vector<Point> patch_vertices_near(const TetMesh& mesh, std::span<const Point> places,
                                       std::span<const double> distances_mm) {
  std::vector<Point> near;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (mesh.strata[v].dimension != 2) continue;
    for (std::size_t n = 0; n < places.size(); ++n) {
      if (distance(places[n], mesh.vertices[v]) > distances_mm[n]) continue;
      near.push_back(mesh.vertices[v]);
      break;
    }
  }
  return near;
}

/// Places of what a mesh has more of than before. Around elements and what is lost the vertices on patches, within
/// `reach` longest edges, or sizes: facets may be longer than the voxels beside a place that is held.
std::vector<Point> places_of_faults(const Meshing& now, const Meshing& before, const SizingField& size, double reach) {
  const TetMesh& mesh = now.refined.mesh;
  const Conformance& conformance = now.conformance;
  std::vector<Point> places;
  std::vector<Point> around;
  std::vector<double> reaches_mm;
  if (now.searched.size() > before.searched.size()) places = now.searched;
  if (now.lost && now.lost->places.size() > before.lost->places.size()) {
    around = now.lost->places;
    places.insert(places.end(), around.begin(), around.end());
    for (const Point& p : around) reaches_mm.push_back(reach * size.size_at(p));
  }
  if (now.layers && now.layers->broken > before.layers->broken) {
    for (const ThinPlace& thin : now.layers->places) places.push_back(thin.place);
  }
  if (now.crossings.size() > before.crossings.size()) {
    for (const std::uint32_t f : now.crossings) {
      for (const VertexId v : mesh.boundary_facets[f]) places.push_back(mesh.vertices[v]);
    }
  }
  if (has_more_short_edges(now, before)) {
    for (const ShortEdgePlace& edge : conformance.short_edges) places.push_back(edge.place);
  }
  if (conformance.places.size() > before.conformance.places.size()) {
    around.insert(around.end(), conformance.places.begin(), conformance.places.end());
    for (const double edge_mm : conformance.edges_mm) reaches_mm.push_back(reach * edge_mm);
  }
  const std::vector<Point> near = patch_vertices_near(mesh, around, reaches_mm);
  places.insert(places.end(), near.begin(), near.end());
  return places;
}

/// The mesh on the boundary of another domain, improved and judged again. held: gets the places where that boundary
/// must stay as it was. reach: of these around faults. Empty if there are such places.
std::optional<Meshing> moved_onto(const Domain& domain, const Domain& domain_before, const Meshing& before,
                                  const OptimizerOptions& optimizer, const SizingField& size, const Searches& searches,
                                  Progress& progress, double reach, std::vector<Point>& held) {
  Meshing now = before;
  TetMesh& mesh = now.refined.mesh;
  std::vector<Point> bad = put_onto(domain, domain_before, mesh);
  const std::vector<Point> turned = turned_over(mesh);
  bad.insert(bad.end(), turned.begin(), turned.end());
  if (bad.empty()) {
    OptimizerOptions mending = optimizer;
    mending.bounds.min_edge.reset();  // what could be done for short edges is done
    const OptimizerResult mended = optimize_mesh(mesh, domain, mending, progress);
    now.optimized.stages.insert(now.optimized.stages.end(), mended.stages.begin(), mended.stages.end());
    now.optimized.min_dihedral_deg = mended.min_dihedral_deg;
    now.conformance = check_conformance(mesh, domain, optimizer.bounds);
    now.crossings = crossing_facets(mesh);
    if (before.distance) {
      now.distance = measure_distance(mesh, domain, {.limit_mm = before.distance->limit_mm, .size = &size});
    }
    if (searches.faults) now.searched = searches.faults(mesh, progress);
    if (before.lost) now.lost = searches.losses(mesh);
    if (before.layers) now.layers = searches.layers(mesh, progress);
    if (!is_worse(now, before)) return now;
    bad = places_of_faults(now, before, size, reach);
  }
  held.insert(held.end(), bad.begin(), bad.end());
  return std::nullopt;
}

}  // namespace

void settle_volumes(const OptimizerOptions& optimizer, const SizingField& size, const Searches& searches,
                    OpenedDomain& opened, Progress& progress, Meshing& meshing) {
  constexpr int kTries = 8;
  constexpr int kMoves = 3;
  if (optimizer.optimize != Optimize::full || meshing.refined.stop != Stop::converged) return;
  const Stopwatch watch;
  if (searches.layers && opened.settle) {
    meshing.layers = searches.layers(meshing.refined.mesh, progress);
    if (!meshing.layers) return;  // cancelled
  }
  std::vector<Point> held;
  double reach = 1;
  int moves = 0;
  for (int round = 0; round < kTries && moves < kMoves && opened.settle; ++round) {
    progress.report({"optimize", "volumes", static_cast<std::uint64_t>(round), std::nullopt, 0});
    FittedDomain settled = opened.settle(volumes_of(meshing.refined.mesh), held, progress);
    if (!settled.domain) break;
    std::swap(opened.domain, settled.domain);
    std::optional<Meshing> moved =
        moved_onto(*opened.domain, *settled.domain, meshing, optimizer, size, searches, progress, reach, held);
    if (!moved || progress.cancelled()) {
      std::swap(opened.domain, settled.domain);
      if (progress.cancelled()) break;
      reach *= 2;
      continue;
    }
    ++moves;
    reach = 1;
    meshing = std::move(*moved);
    opened.grid = std::move(settled.grid);
    opened.settle = std::move(settled.settle);
  }
  opened.settle = nullptr;  // with the fields that it holds
  meshing.optimize_s += watch.seconds();
}

}  // namespace scantet
