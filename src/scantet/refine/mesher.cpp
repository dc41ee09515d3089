// The main job on one page: sample the boundary, refine by the rules, extract.
#include "scantet/refine/mesher.h"

#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/base/stopwatch.h"
#include "scantet/domain/noise.h"
#include "scantet/domain/patch_pieces.h"
#include "scantet/refine/curves_impl.h"
#include "scantet/refine/extract_impl.h"
#include "scantet/refine/rules_and_topology_impl.h"
#include "scantet/sampling/bulk_seeds.h"
#include "scantet/sampling/initial_sample.h"

namespace scantet {
namespace {

constexpr std::uint64_t kMostVertices = 140'000'000;  // their tets can be numbered with 30 bits
constexpr std::uint64_t kManySeeds = 2;  // for each boundary point: from then on the lattice speeds up the start

void check(const MesherOptions& options, const SizingField& size) {
  const auto positive = [](const char* name, double value) {
    if (std::isfinite(value) && value > 0) return;
    throw Error(Fault::usage, "usage.option", std::string(name) + " is " + std::to_string(value),
                "it must be greater than 0 and finite");
  };
  positive("size", size.min_size());
  positive("alpha", options.bounds.alpha);
  positive("facet_radius_edge", options.bounds.facet_radius_edge);
  positive("cell_radius_edge", options.bounds.cell_radius_edge);
  if (!(options.bounds.small_slack >= 1 && std::isfinite(options.bounds.small_slack))) {
    throw Error(Fault::usage, "usage.option", "small_slack is " + std::to_string(options.bounds.small_slack),
                "it must be at least 1 and finite");
  }
  if (options.bounds.facet_distance_mm) positive("facet_distance", *options.bounds.facet_distance_mm);
}

/// Keeps account of the time that each stage takes.
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

/// What the domain calls its regions and patches.
void set_names(TetMesh& mesh, const Domain& domain) {
  mesh.region_names.clear();
  for (const MeshPatch& patch : mesh.patches) {
    for (const Region region : patch.regions) {
      if (region == kOutside) continue;
      const std::string name = domain.name_of_region(region);
      if (!name.empty()) mesh.region_names.try_emplace(region, name);
    }
  }
  for (MeshPatch& patch : mesh.patches) {
    const auto [low, high] = std::minmax(patch.regions[0], patch.regions[1]);
    patch.name = domain.name_of_patch({{low, high}, {}});
  }
}

[[noreturn]] void refuse_sample(std::uint64_t points, std::uint64_t most) {
  throw Error(Fault::usage, "usage.max_vertices",
              "--max-vertices: the boundary alone takes " + std::to_string(points) +
                  " vertices at this size, and no more than " + std::to_string(most) + " are allowed",
              "allow more, or choose a larger --size");
}

/// The points that refinement starts from.
std::vector<engine::SamplePoint> first_points(const Domain& domain, const SizingField& size,
                                              const engine::Curves& curves, const MesherOptions& options,
                                              Progress& progress, StageClock& clock, MeshResult& result) {
  std::vector<Point> boundary = initial_sample(
      domain, size, {options.bounds.alpha, options.seed, options.max_vertices, !result.is_noise}, progress);
  curves.drop_near(boundary);
  std::vector<engine::SamplePoint> points = curves.weighted_points();
  points.reserve(points.size() + boundary.size());
  for (const Point& p : boundary) points.push_back({p, 2});
  result.counts.initial_points = points.size();
  clock.end("boundary sample", points.size());
  if (points.size() > options.max_vertices) refuse_sample(points.size(), options.max_vertices);
  boundary.insert(boundary.end(), curves.points().begin(), curves.points().end());
  if (options.seeding == Seeding::paper || progress.cancelled()) return points;
  const std::vector<Point> inner =
      bulk_seeds(domain, size, boundary, {options.bounds.alpha, options.max_vertices}, progress);
  const std::size_t room = options.max_vertices - std::min<std::uint64_t>(options.max_vertices, boundary.size());
  result.counts.lattice_points = std::min(inner.size(), room);
  for (std::size_t i = 0; i < result.counts.lattice_points; ++i) points.push_back({inner[i], 3});
  clock.end("lattice", result.counts.lattice_points);
  return points;
}

/// The points of an earlier mesh.
std::vector<engine::SamplePoint> same_points(const MeshResult& before, const engine::Curves& curves,
                                             MeshResult& result) {
  std::vector<engine::SamplePoint> points = curves.weighted_points();
  result.counts.initial_points = points.size();
  points.reserve(points.size() + before.sample.size());
  for (std::size_t i = 0; i < before.sample.size(); ++i) {
    const std::uint8_t dimension = before.sample_dimensions[i];
    if (dimension < 2 || curves.is_near(before.sample[i])) continue;  // curves are sampled anew
    ++(dimension < 3 ? result.counts.initial_points : result.counts.lattice_points);
    points.push_back({before.sample[i], dimension});
  }
  return points;
}

/// The points of this mesh, for one that starts from them (same_points).
void keep_sample(const engine::Triangulation& t, MeshResult& result) {
  result.sample.reserve(t.vertex_count());
  result.sample_dimensions.reserve(t.vertex_count());
  for (engine::PointId v = 0; v < t.vertex_slots(); ++v) {
    if (!t.is_vertex(v)) continue;
    result.sample.push_back(t.point(v));
    result.sample_dimensions.push_back(t.vertex_info(v).dimension);
  }
}

MeshResult mesh_on_these_threads(const Domain& domain, const SizingField& size, const MesherOptions& options,
                                 const MeshResult* before, Progress& progress) {
  MeshResult result;
  const Stopwatch sampling;
  StageClock clock(result);
  result.is_noise = before == nullptr ? is_noise(domain, size) : before->is_noise;
  const engine::Curves curves(domain, size, options.bounds.alpha);
  result.merged_curves = curves.merged();
  if (!curves.empty()) clock.end("curves", curves.points().size());
  std::vector<engine::SamplePoint> points = before == nullptr
                                                ? first_points(domain, size, curves, options, progress, clock, result)
                                                : same_points(*before, curves, result);
  result.sample_s = sampling.seconds();

  const Stopwatch refining;
  engine::RestrictedTriangulation triangulation(domain);
  triangulation.set_junctions(curves.junctions());
  const bool is_mostly_lattice = result.counts.lattice_points > kManySeeds * result.counts.initial_points;
  triangulation.insert_points(std::move(points), progress,
                              is_mostly_lattice ? seed_lattice(domain, size) : SeedLattice{});
  clock.end("triangulate", triangulation.vertex_count());
  if (progress.cancelled()) {
    result.stop = Stop::cancelled;
    return result;
  }
  bool spans_space = false;
  if (!run_interruptible(progress, [&] { spans_space = triangulation.classify(); })) {
    result.stop = Stop::cancelled;
    return result;
  }
  if (!spans_space) {
    throw Error(Fault::input, "input.flat", "the boundary sample does not span space", "choose a smaller size");
  }
  clock.end("classify", 0);
  engine::RulesAndTopology work(domain, triangulation, size, options, progress);
  if (before != nullptr && before->handles_left_out) work.leave_handles_out();
  if (result.is_noise) work.leave_topology_out();
  clock.end("collect", 0);
  work.refine();
  work.untangle();
  work.look_for_wrong_handles();
  work.account(result);
  clock.restart();
  result.stop = work.stop();
  result.counts.unmet = work.refinement().unmet();
  if (result.stop == Stop::limit) result.limit = work.refinement().limit_report();
  if (result.stop != Stop::cancelled) {
    result.mesh = engine::extract_mesh(triangulation, curves.sharp_edges(domain));
    set_names(result.mesh, domain);
    part_patches(result.mesh, domain);
    keep_sample(triangulation.triangulation(), result);
    clock.end("extract", 0);
  }
  result.refine_s = refining.seconds();
  return result;
}

MeshResult mesh_from(const Domain& domain, const SizingField& size, const MesherOptions& options,
                     const MeshResult* before, Progress& progress) {
  check(options, size);
  MesherOptions bounded = options;
  bounded.bounds = bounds_on(domain, options.bounds);
  bounded.max_vertices = std::min(options.max_vertices, kMostVertices);
  MeshResult result;
  with_threads(options.threads, [&] { result = mesh_on_these_threads(domain, size, bounded, before, progress); });
  return result;
}

}  // namespace

MeshResult mesh_domain(const Domain& domain, const SizingField& size, const MesherOptions& options,
                       Progress& progress) {
  return mesh_from(domain, size, options, nullptr, progress);
}

MeshResult refine_further(const Domain& domain, const SizingField& size, const MesherOptions& options,
                          const MeshResult& before, Progress& progress) {
  return mesh_from(domain, size, options, &before, progress);
}

}  // namespace scantet
