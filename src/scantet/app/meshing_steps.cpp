#include "scantet/app/meshing_steps.h"

#include <utility>

#include "scantet/app/short_edges.h"
#include "scantet/base/error.h"

namespace scantet {
namespace {

constexpr double kMostAtHandles = 0.75;  // points for each boundary vertex that handles may take, if
constexpr std::size_t kFewHandles = 20;  // so few of them are wrong then

}  // namespace

/// A cancelled sample may be too poor to triangulate; that is no error of the user's.
std::optional<MeshResult> mesh_or_cancel(const Domain& domain, const SizingField& size, const MesherOptions& options,
                                         const MeshResult* before, Progress& progress) {
  try {
    MeshResult mesh = before == nullptr ? mesh_domain(domain, size, options, progress)
                                        : refine_further(domain, size, options, *before, progress);
    if (mesh.stop == Stop::cancelled) return std::nullopt;
    return mesh;
  } catch (const Error&) {
    if (progress.cancelled()) return std::nullopt;
    throw;
  }
}

MeshResult points_of(const MeshResult& mesh) {
  MeshResult points;
  points.sample = mesh.sample;
  points.sample_dimensions = mesh.sample_dimensions;
  points.handles_left_out = mesh.handles_left_out;
  return points;
}

MesherOptions with_handles(const MesherOptions& options) {
  MesherOptions with = options;
  with.most_at_handles = kMostAtHandles;
  with.keeps_few_handles = true;
  return with;
}

bool keeps_most_handles(const MeshResult& mesh) {
  return mesh.stop == Stop::converged && !mesh.handles_left_out && mesh.wrong_handle_count <= kFewHandles;
}

OptimizerOptions with_rules(const OptimizerOptions& options, const Domain& domain, const MesherOptions& mesher,
                            const SizingField& size) {
  OptimizerOptions with = options;
  with.bounds.rules = RuleTarget{bounds_on(domain, mesher.bounds), &size};
  return with;
}

bool improve(const Domain& domain, const std::shared_ptr<const SizingField>& size_asked, const MesherOptions& mesher,
             const OptimizerOptions& optimizer, bool is_mixed, Progress& progress, Meshing& meshing) {
  const FinerSize size(size_asked, meshing.finer);
  OptimizerOptions improving = with_rules(optimizer, domain, mesher, size);
  // Rules and untangling leave no facet out of bounds, unless tets have changed sides.
  improving.facets_keep_rules = meshing.refined.counts.absorbed_tets == 0 && !is_mixed;
  improving.bounds.min_edge.reset();
  if (meshing.refined.is_noise) improving.persistence = Persistence::once;
  meshing.optimized = optimize_mesh(meshing.refined.mesh, domain, improving, progress);
  return !meshing.optimized.cancelled || progress.out_of_budget();
}

void contract_unless_found(const Domain& domain, const SizingField& size, const MesherOptions& mesher,
                           const OptimizerOptions& optimizer, const FaultSearch& search, const LossSearch& losses,
                           DistanceMeter* meter, Progress& progress, Meshing& meshing) {
  const OptimizerOptions bounded = with_rules(optimizer, domain, mesher, size);
  if (!search) return lengthen_short_edges(domain, size, bounded, losses, meter, progress, meshing);
  Meshing contracted = meshing;
  lengthen_short_edges(domain, size, bounded, losses, meter, progress, contracted);
  contracted.searched = search(contracted.refined.mesh, progress);
  if (contracted.searched.size() <= meshing.searched.size()) meshing = std::move(contracted);
}

}  // namespace scantet
