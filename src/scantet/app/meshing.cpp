// An element stays out of bounds, a vertex pinched, or an island lost where the boundary is more crooked than elements
// of that size can follow: at a saddle, or at an island of one voxel. Only smaller elements help there.
#include "scantet/app/meshing.h"

#include <algorithm>

#include "scantet/base/error.h"
#include "scantet/base/phase_clock.h"
#include "scantet/base/stopwatch.h"

namespace scantet {
namespace {

constexpr int kFinerRounds = 6;
constexpr int kRoundsInVain = 3;  // in a row
constexpr double kFiner = 0.5;
constexpr double kFewFaults = 0.01;  // of all tets: if there are more, it is not for the boundary's sake

/// A cancelled sample may be too poor to triangulate; that is no error of the user's.
std::optional<MeshResult> mesh_or_cancel(const Domain& domain, const SizingField& size, const MesherOptions& options,
                                         const Meshing* before, Progress& progress) {
  try {
    MeshResult mesh = before == nullptr ? mesh_domain(domain, size, options, progress)
                                        : refine_further(domain, size, options, before->refined, progress);
    if (mesh.stop == Stop::cancelled) return std::nullopt;
    return mesh;
  } catch (const Error&) {
    if (progress.cancelled()) return std::nullopt;
    throw;
  }
}

OptimizerOptions with_rules(const OptimizerOptions& options, const MesherOptions& mesher, const SizingField& size) {
  OptimizerOptions with = options;
  with.bounds.rules = RuleTarget{mesher.bounds, &size};
  return with;
}

/// Edges come last, and once: no finer size makes them longer.
void contract(const Domain& domain, const SizingField& size, const MesherOptions& mesher,
              const OptimizerOptions& optimizer, Progress& progress, Meshing& meshing) {
  if (meshing.conformance.short_edges.empty() || meshing.refined.stop != Stop::converged) return;
  const OptimizerOptions bounded = with_rules(optimizer, mesher, size);
  contract_short_edges(meshing.refined.mesh, domain, bounded, progress, meshing.optimized);
  meshing.conformance = check_conformance(meshing.refined.mesh, domain, bounded.bounds);
}

std::optional<Meshing> attempt(const Domain& domain, const SizingField& size, const MesherOptions& mesher,
                               const OptimizerOptions& optimizer, const Meshing* before, Progress& progress) {
  std::optional<MeshResult> mesh = mesh_or_cancel(domain, size, mesher, before, progress);
  if (!mesh) return std::nullopt;
  Meshing meshing;
  meshing.refined = std::move(*mesh);
  if (meshing.refined.mesh.tets.empty()) return meshing;
  const OptimizerOptions bounded = with_rules(optimizer, mesher, size);
  // A mesh that a limit ended is far from done: to improve all of it takes longer than to refine it.
  if (meshing.refined.stop == Stop::converged) {
    // Rules and untangling leave no facet out of bounds, unless tets have changed sides.
    OptimizerOptions improving = bounded;
    improving.facets_keep_rules = meshing.refined.counts.absorbed_tets == 0;
    improving.bounds.min_edge.reset();
    meshing.optimized = optimize_mesh(meshing.refined.mesh, domain, improving, progress);
    if (meshing.optimized.cancelled && !progress.out_of_budget()) return std::nullopt;
  }
  PhaseClock phase(meshing.phases, progress);
  phase.begin("audit", "bounds");
  meshing.conformance = check_conformance(meshing.refined.mesh, domain, bounded.bounds);
  phase.end();
  return meshing;
}

/// The time that all attempts took together, stage by stage in the order of the first attempt, which samples.
class Spent {
 public:
  /// counts: whether this mesh is the best so far, so that its points are those that are kept.
  void add(const Meshing& meshing, bool counts) {
    const MeshResult& mesh = meshing.refined;
    for (const PhaseAccount& phase : meshing.phases) {
      bounds_.seconds += phase.seconds;
      bounds_.cpu_seconds += phase.cpu_seconds;
    }
    sample_s_ += mesh.sample_s;
    refine_s_ += mesh.refine_s;
    for (const StageAccount& part : mesh.stages) {
      const auto is_it = [&](const StageAccount& stage) { return stage.stage == part.stage; };
      auto stage = std::find_if(stages_.begin(), stages_.end(), is_it);
      if (stage == stages_.end()) stage = stages_.insert(stage, {part.stage, 0, part.points});
      stage->seconds += part.seconds;
      if (counts) stage->points = part.points;
    }
  }
  /// all_s: what everything took.
  void put_into(Meshing& meshing, double all_s) const {
    meshing.refined.sample_s = sample_s_;
    meshing.refined.refine_s = refine_s_;
    meshing.refined.stages = stages_;
    meshing.phases = {bounds_};
    meshing.optimize_s = all_s - sample_s_ - refine_s_ - bounds_.seconds;
  }

 private:
  double sample_s_ = 0;
  double refine_s_ = 0;
  std::vector<StageAccount> stages_;
  PhaseAccount bounds_{"audit", "bounds", 0, 0};
};

std::size_t fault_count(const Meshing& meshing) {
  return meshing.conformance.places.size() + meshing.refined.tangled.size();
}

bool finer_may_help(const Meshing& meshing) {
  const auto tets = static_cast<double>(meshing.refined.mesh.tets.size());
  const std::size_t faults = fault_count(meshing);
  return meshing.refined.stop == Stop::converged && faults > 0 && static_cast<double>(faults) <= kFewFaults * tets;
}

/// The attempt's places, and one at each fault.
std::vector<FinerPlace> finer_places(const Meshing& meshing, const SizingField& size) {
  std::vector<FinerPlace> places = meshing.finer;
  const auto add = [&](const Point& p) { places.push_back({p, kFiner * size.size_at(p)}); };
  for (const Point& p : meshing.conformance.places) add(p);
  for (const Point& p : meshing.refined.tangled) add(p);
  return places;
}

}  // namespace

std::optional<Meshing> mesh_and_optimize(const Domain& domain, const std::shared_ptr<const SizingField>& size_asked,
                                         const MesherOptions& mesher, const OptimizerOptions& optimizer,
                                         Progress& progress) {
  const Stopwatch all;
  FinerSize size(size_asked, {});
  std::optional<Meshing> best = attempt(domain, size, mesher, optimizer, nullptr, progress);
  if (!best) return std::nullopt;
  Spent spent;
  spent.add(*best, true);
  const Meshing* last = &*best;
  std::optional<Meshing> next;
  int in_vain = 0;
  for (int round = 0; round < kFinerRounds && in_vain < kRoundsInVain && optimizer.optimize == Optimize::full;
       ++round) {
    if (!finer_may_help(*last)) break;
    std::vector<FinerPlace> places = finer_places(*last, size);
    size = FinerSize(size_asked, places);
    next = attempt(domain, size, mesher, optimizer, last, progress);
    if (!next && progress.out_of_budget()) break;
    if (!next) return std::nullopt;
    next->finer = std::move(places);
    const bool better = fault_count(*next) < fault_count(*best) && next->refined.stop == Stop::converged;
    spent.add(*next, better);
    in_vain = better ? 0 : in_vain + 1;
    if (better) {
      best = std::move(next);
      last = &*best;
    } else {
      last = &*next;
    }
  }
  contract(domain, FinerSize(size_asked, best->finer), mesher, optimizer, progress, *best);
  if (progress.cancelled() && !progress.out_of_budget()) return std::nullopt;
  spent.put_into(*best, all.seconds());
  return best;
}

}  // namespace scantet
