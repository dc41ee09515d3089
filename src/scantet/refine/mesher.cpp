// The main job on one page: sample the boundary, refine by the rules, extract.
#include "scantet/refine/mesher.h"

#include "scantet/base/error.h"
#include "scantet/base/stopwatch.h"
#include "scantet/refine/extract_impl.h"
#include "scantet/refine/initial_sample.h"
#include "scantet/refine/refinement_impl.h"
#include "scantet/refine/topology_repair_impl.h"
#include "scantet/refine/untangle_impl.h"

namespace scantet {
namespace {

constexpr double kSmallestRepair = 0.1;  // of alpha·σ: smaller surface balls are not thinned to mend the topology
constexpr double kClosestRepair = 1e-3;  // of those: a mending point nearer to a vertex is passed over
constexpr int kRepairRounds = 60;        // far more than any scan has needed; each adds points or ends the repair

void check(const MesherOptions& options, const SizingField& size) {
  const auto positive = [](const char* name, double value) {
    if (std::isfinite(value) && value > 0) return;
    throw Error(Fault::usage, "usage.option", std::string(name) + " is " + std::to_string(value),
                "it must be greater than 0 and finite");
  };
  positive("size", size.min_size());
  positive("alpha", options.alpha);
  positive("facet_radius_edge", options.facet_radius_edge);
  positive("cell_radius_edge", options.cell_radius_edge);
  if (options.facet_distance_mm) positive("facet_distance", *options.facet_distance_mm);
}

std::vector<refine::SamplePoint> on_surface(const std::vector<Point>& points) {
  std::vector<refine::SamplePoint> sample;
  sample.reserve(points.size());
  for (const Point& p : points) sample.push_back({p, true});
  return sample;
}

}  // namespace

MeshResult mesh_domain(const Domain& domain, const SizingField& size, const MesherOptions& options,
                       Progress& progress) {
  check(options, size);
  MeshResult result;
  const Stopwatch sampling;
  const std::vector<Point> points = initial_sample(domain, size, {options.alpha, options.seed}, progress);
  result.sample_s = sampling.seconds();
  result.initial_points = points.size();

  const Stopwatch refining;
  refine::RestrictedTriangulation triangulation(domain);
  if (!triangulation.build(on_surface(points))) {
    throw Error(Fault::input, "input.flat", "the boundary sample does not span space", "choose a smaller size");
  }
  refine::Refinement refinement(triangulation, size, options, progress);
  const double smallest_mm = kSmallestRepair * options.alpha * size.min_size();
  refine::TopologyRepair repair(domain, triangulation, smallest_mm);
  for (const refine::Rule last : {refine::Rule::r2, refine::Rule::r3}) {
    result.stop = progress.cancelled() ? Stop::cancelled : refinement.run(last);
    for (int round = 0; round < kRepairRounds && result.stop == Stop::converged; ++round) {
      const std::uint64_t added = refinement.add(repair.missing_points(), kClosestRepair * smallest_mm);
      if (added == 0) break;
      result.repair_points += added;
      result.stop = refinement.run(last);
    }
  }
  result.inserted = refinement.inserted();
  result.unmet = refinement.unmet();
  if (result.stop == Stop::limit) result.limit = refinement.limit_report();
  if (result.stop != Stop::cancelled) {
    result.absorbed_tets = refine::Untangler(domain, triangulation, size, options.alpha).run();
    result.mesh = refine::extract_mesh(triangulation);
    for (refine::VertexHandle v : triangulation.triangulation().finite_vertex_handles()) {
      result.sample.push_back(refine::position(v));
      result.sample_on_boundary.push_back(v->info().on_boundary ? 1 : 0);
    }
  }
  result.refine_s = refining.seconds();
  return result;
}

UnmetRules check_rules(const std::vector<Point>& sample, const std::vector<std::uint8_t>& on_boundary,
                       const Domain& domain, const SizingField& size, const MesherOptions& options) {
  std::vector<refine::SamplePoint> points;
  points.reserve(sample.size());
  for (std::size_t i = 0; i < sample.size(); ++i) points.push_back({sample[i], on_boundary[i] != 0});
  refine::RestrictedTriangulation triangulation(domain);
  if (!triangulation.build(points)) return {};
  const refine::Rules rules(size, options);
  UnmetRules unmet;
  for (std::uint32_t ball : triangulation.new_balls()) {
    if (const auto violation = rules.facet(triangulation, ball)) {
      ++(violation->rule == refine::Rule::r1 ? unmet.r1 : unmet.r2);
    }
  }
  for (std::uint32_t slot : triangulation.new_cells()) {
    if (rules.tet(triangulation, slot)) ++unmet.r3;
  }
  return unmet;
}

}  // namespace scantet
