// The main job on one page: sample the boundary, refine by the rules, extract.
#include "scantet/refine/mesher.h"

#include <array>
#include <numeric>

#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/base/stopwatch.h"
#include "scantet/refine/bulk_seeds.h"
#include "scantet/refine/extract_impl.h"
#include "scantet/refine/initial_sample.h"
#include "scantet/refine/refinement_impl.h"
#include "scantet/refine/topology_repair_impl.h"
#include "scantet/refine/untangle_impl.h"

namespace scantet {
namespace {

constexpr double kSmallestRepair = 0.1;  // of alpha·σ: smaller surface balls are not thinned to mend the topology
constexpr double kClosestRepair = 1e-3;  // of those: a mending point nearer to a vertex is passed over
constexpr std::uint64_t kMostVertices = 140'000'000;  // their tets can be numbered with 30 bits
constexpr int kRepairRounds = 60;  // far more than any scan has needed; each adds points or ends the repair

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

/// Writes down what each stage took.
class StageClock {
 public:
  explicit StageClock(MeshResult& result) : result_(result) {}
  void end(const char* stage, std::uint64_t points) {
    result_.stages.push_back({stage, watch_.seconds(), points});
    restart();
  }
  void restart() { watch_ = Stopwatch(); }

 private:
  MeshResult& result_;
  Stopwatch watch_;
};

std::vector<refine::SamplePoint> on_surface(const std::vector<Point>& points) {
  std::vector<refine::SamplePoint> sample;
  sample.reserve(points.size());
  for (const Point& p : points) sample.push_back({p, true});
  return sample;
}

/// Runs the rules and the repair of the topology, and accounts for both; returns how it ended.
Stop refine_all(refine::Refinement& refinement, refine::TopologyRepair& repair, double smallest_mm, Progress& progress,
                MeshResult& result) {
  double rules_s = 0;
  double topology_s = 0;
  Stop stop = Stop::converged;
  const auto run = [&](refine::Rule last) {
    const Stopwatch watch;
    stop = progress.cancelled() ? Stop::cancelled : refinement.run(last);
    rules_s += watch.seconds();
  };
  const auto mend = [&] {
    const Stopwatch watch;
    const std::uint64_t added = refinement.add(repair.missing_points(), kClosestRepair * smallest_mm);
    result.repair_points += added;
    topology_s += watch.seconds();
    return added > 0;
  };
  for (const refine::Rule last : {refine::Rule::r2, refine::Rule::r3}) {
    if (stop == Stop::converged) run(last);
    for (int round = 0; round < kRepairRounds && stop == Stop::converged && mend(); ++round) run(last);
  }
  constexpr std::array<const char*, 4> kRules{"R1", "R2", "R3.1", "R3.2"};
  const refine::RuleWork& work = refinement.work();
  const double threads_s = std::accumulate(work.seconds.begin(), work.seconds.end(), 0.0);
  for (std::size_t i = 0; i < kRules.size(); ++i) {
    const double share = threads_s > 0 ? work.seconds[i] / threads_s : 0.25;
    result.stages.push_back({kRules[i], share * rules_s, work.points[i]});
  }
  result.stages.push_back({"topology", topology_s, result.repair_points});
  result.inserted = {work.points[0], work.points[1], work.points[2], work.points[3]};
  return stop;
}

/// The points that refinement starts from.
std::vector<refine::SamplePoint> first_points(const Domain& domain, const SizingField& size,
                                              const MesherOptions& options, Progress& progress, StageClock& clock,
                                              MeshResult& result) {
  const std::vector<Point> boundary = initial_sample(domain, size, {options.alpha, options.seed}, progress);
  result.initial_points = boundary.size();
  clock.end("boundary sample", boundary.size());
  std::vector<refine::SamplePoint> points = on_surface(boundary);
  if (options.seeding == Seeding::paper) return points;
  const std::vector<Point> inner = bulk_seeds(domain, size, boundary, {options.alpha, options.max_vertices}, progress);
  const std::size_t room = options.max_vertices - std::min<std::uint64_t>(options.max_vertices, boundary.size());
  result.lattice_points = std::min(inner.size(), room);
  for (std::size_t i = 0; i < result.lattice_points; ++i) points.push_back({inner[i], false});
  clock.end("lattice", result.lattice_points);
  return points;
}

MeshResult mesh_on_these_threads(const Domain& domain, const SizingField& size, const MesherOptions& options,
                                 Progress& progress) {
  MeshResult result;
  const Stopwatch sampling;
  StageClock clock(result);
  std::vector<refine::SamplePoint> points = first_points(domain, size, options, progress, clock, result);
  result.sample_s = sampling.seconds();

  const Stopwatch refining;
  refine::RestrictedTriangulation triangulation(domain);
  triangulation.insert_points(std::move(points), progress);
  clock.end("triangulate", triangulation.vertex_count());
  if (progress.cancelled()) {
    result.stop = Stop::cancelled;
    return result;
  }
  if (!triangulation.classify()) {
    throw Error(Fault::input, "input.flat", "the boundary sample does not span space", "choose a smaller size");
  }
  clock.end("classify", 0);
  refine::Refinement refinement(triangulation, size, options, progress);
  const double smallest_mm = kSmallestRepair * options.alpha * size.min_size();
  refine::TopologyRepair repair(domain, triangulation, smallest_mm);
  clock.end("collect", 0);
  result.stop = refine_all(refinement, repair, smallest_mm, progress, result);
  clock.restart();
  result.unmet = refinement.unmet();
  if (result.stop == Stop::limit) result.limit = refinement.limit_report();
  if (result.stop != Stop::cancelled) {
    const bool is_whole = result.stop == Stop::converged && repair.is_whole();
    if (!is_whole) result.absorbed_tets = refine::Untangler(domain, triangulation, size, options.alpha).run();
    clock.end("untangle", 0);
    result.mesh = refine::extract_mesh(triangulation);
    const refine::Triangulation& t = triangulation.triangulation();
    result.sample.reserve(t.vertex_count());
    result.sample_on_boundary.reserve(t.vertex_count());
    for (refine::PointId v = 0; v < t.vertex_slots(); ++v) {
      if (!t.is_vertex(v)) continue;
      result.sample.push_back(t.point(v));
      result.sample_on_boundary.push_back(t.vertex(v).on_boundary ? 1 : 0);
    }
    clock.end("extract", 0);
  }
  result.refine_s = refining.seconds();
  return result;
}

}  // namespace

MeshResult mesh_domain(const Domain& domain, const SizingField& size, const MesherOptions& options,
                       Progress& progress) {
  check(options, size);
  MesherOptions bounded = options;
  bounded.max_vertices = std::min(options.max_vertices, kMostVertices);
  MeshResult result;
  with_threads(options.threads, [&] { result = mesh_on_these_threads(domain, size, bounded, progress); });
  return result;
}

UnmetRules check_rules(const std::vector<Point>& sample, const std::vector<std::uint8_t>& on_boundary,
                       const Domain& domain, const SizingField& size, const MesherOptions& options) {
  std::vector<refine::SamplePoint> points;
  points.reserve(sample.size());
  for (std::size_t i = 0; i < sample.size(); ++i) points.push_back({sample[i], on_boundary[i] != 0});
  UnmetRules unmet;
  with_threads(options.threads, [&] {
    refine::RestrictedTriangulation triangulation(domain);
    Progress silent;
    if (!triangulation.build(std::move(points), silent)) return;
    unmet = refine::Refinement(triangulation, size, options, silent).unmet();
  });
  return unmet;
}

}  // namespace scantet
