#include "scantet/app/short_edges.h"

#include <algorithm>

#include "scantet/base/parallel.h"
#include "scantet/check/facet_crossings.h"
#include "scantet/check/turned_hollows.h"

namespace scantet {
namespace {

std::vector<Box> boxes_of_facets(const TetMesh& mesh) {
  std::vector<Box> boxes(mesh.boundary_facets.size());
  for (std::size_t f = 0; f < boxes.size(); ++f) {
    for (const VertexId v : mesh.boundary_facets[f]) boxes[f].extend(mesh.vertices[v]);
  }
  return boxes;
}

/// Looks for losses where they were looked for before. Holds what is around those that are new. Return: whether there
/// are more than before.
bool hold_losses(const LossSearch& losses, const SizingField& size, Meshing& meshing, std::vector<Box>& held) {
  if (!losses || !meshing.lost) return false;
  const RegionLosses now = losses(meshing.refined.mesh);
  if (now.places.size() <= meshing.lost->places.size()) return false;
  for (const Point& p : now.places) {
    if (std::find(meshing.lost->places.begin(), meshing.lost->places.end(), p) != meshing.lost->places.end()) continue;
    held.push_back(Box{p, p}.grown(size.size_at(p)));
  }
  return true;
}

/// Takes vertices away for the sake of short edges. Tets stay positive by it, but what is outside of the mesh may turn
/// over where it is small: where facets come to cross, hollows are turned, or something is lost, all is done anew
/// without the vertices there, and if that does not help, nothing.
void contract_without_overlaps(const Domain& domain, const SizingField& size, OptimizerOptions options,
                               const LossSearch& losses, Progress& progress, Meshing& meshing) {
  constexpr int kRounds = 4;
  TetMesh& mesh = meshing.refined.mesh;
  const TetMesh before = mesh;
  const OptimizerResult done = meshing.optimized;
  for (int round = 0; round < kRounds; ++round) {
    contract_short_edges(mesh, domain, options, progress, meshing.optimized);
    std::vector<std::uint32_t> overlapping = crossing_facets(mesh);
    const std::vector<std::uint32_t> turned = turned_hollows(mesh);
    const bool has_turned = !turned.empty() && turned.size() > turned_hollows(before).size();
    const bool has_lost = hold_losses(losses, size, meshing, options.held);
    if (overlapping.size() <= meshing.crossings.size() && !has_turned && !has_lost) break;
    overlapping.insert(overlapping.end(), turned.begin(), turned.end());
    const std::vector<Box> boxes = boxes_of_facets(mesh);
    for (const std::uint32_t f : overlapping) options.held.push_back(boxes[f].grown(boxes[f].diagonal()));
    mesh = before;
    meshing.optimized = done;
  }
}

/// For each place that has come beyond the limit a box with all facets in it that were within the limit of it.
/// facets: the boxes of those.
void hold_new_places(const std::vector<FarPlace>& now, std::vector<FarPlace> before, const std::vector<Box>& facets,
                     double limit_mm, std::vector<Box>& held) {
  constexpr std::size_t kGrain = 16;
  const auto first = [](const FarPlace& a, const FarPlace& b) { return lexicographically_less(a.point, b.point); };
  std::sort(before.begin(), before.end(), first);
  std::vector<Box> boxes(now.size());
  parallel_for(now.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (std::binary_search(before.begin(), before.end(), now[i], first)) continue;
      boxes[i].extend(now[i].point);
      boxes[i].extend(now[i].nearest);
      const Box near = boxes[i].grown(limit_mm);
      for (const Box& facet : facets) {
        if (facet.meets(near)) boxes[i].unite(facet);
      }
    }
  });
  std::erase_if(boxes, [](const Box& box) { return box.empty(); });
  held.insert(held.end(), boxes.begin(), boxes.end());
}

}  // namespace

void lengthen_short_edges(const Domain& domain, const SizingField& size, const OptimizerOptions& optimizer,
                          const LossSearch& losses, DistanceMeter* meter, Progress& progress, Meshing& meshing) {
  constexpr int kRounds = 4;
  if (meshing.conformance.short_edges.empty() || meshing.refined.stop != Stop::converged) return;
  OptimizerOptions bounded = optimizer;
  const std::optional<Meshing> before =
      meshing.distance && meter != nullptr ? std::optional<Meshing>(meshing) : std::nullopt;
  for (int round = 0; round < kRounds; ++round) {
    contract_without_overlaps(domain, size, bounded, losses, progress, meshing);
    if (!before) break;
    const BoundaryDistance& was = *before->distance;
    meshing.distance = meter->measure(meshing.refined.mesh, &size);
    if (!is_farther(*meshing.distance, was)) break;
    const BoundaryDistance now = *meshing.distance;
    meshing = *before;
    const std::vector<Box> facets = boxes_of_facets(meshing.refined.mesh);
    hold_new_places(now.to_mesh.beyond, was.to_mesh.beyond, facets, *was.limit_mm, bounded.held);
    hold_new_places(now.to_domain.beyond, was.to_domain.beyond, facets, *was.limit_mm, bounded.held);
  }
  meshing.conformance = check_conformance(meshing.refined.mesh, domain, bounded.bounds);
}

}  // namespace scantet
