#include <unistd.h>

#include <stdexcept>

#include "contestants.h"
#include "inputs.h"
#include "scantet/base/options.h"
#include "scantet/base/parallel.h"
#include "scantet/domain/analytic.h"

namespace scantet::bench {
namespace {

/// CGAL is given the same function: the two must be inside at the same points.
void check_function(const Domain& domain, ImplicitFunction function) {
  constexpr int kEachWay = 20;
  const Box box = domain.bounds();
  for (int i = 0; i < kEachWay * kEachWay * kEachWay; ++i) {
    const Vec share{(i % kEachWay + 0.5) / kEachWay, (i / kEachWay % kEachWay + 0.5) / kEachWay,
                    (i / (kEachWay * kEachWay) + 0.5) / kEachWay};
    const Vec e = box.extent();
    const Point p = box.min + Vec{share.x * e.x, share.y * e.y, share.z * e.z};
    if ((function(p) < 0) != (domain.region_at(p) != kOutside)) throw std::runtime_error("the functions differ");
  }
}

std::unique_ptr<Domain> open_domain(const Case& c, double& prepare_s) {
  if (!c.formula.empty() || !c.surface.empty() || c.labels) {
    const std::string input = plugin_input(c);
    std::vector<std::pair<std::string, std::string>> options;
    if (c.labels) options.emplace_back("labels", "all");
    if (c.sharp_deg > 0) options.emplace_back("sharp-edges", number_text(c.sharp_deg));
    const Stopwatch preparing;
    std::unique_ptr<Domain> domain = open_input(input, options).domain;
    prepare_s = preparing.seconds();
    if (!c.formula.empty()) check_function(*domain, implicit_function(c.formula));
    return domain;
  }
  if (c.scan.empty()) return make_tanglecube();
  const Scan scan = open_scan(c);
  const Stopwatch preparing;
  std::unique_ptr<Domain> domain = make_level_set(scan, c.level);
  prepare_s = preparing.seconds();
  return domain;
}

void leave_points(const std::vector<Point>& sample, std::FILE* points) {
  std::rewind(points);
  if (ftruncate(fileno(points), 0) != 0 ||
      std::fwrite(sample.data(), sizeof(Point), sample.size(), points) != sample.size() || std::fflush(points) != 0) {
    throw std::runtime_error("cannot write the points to a temporary file");
  }
}

}  // namespace

Figures run_scantet(const Case& c, int threads, std::FILE* points) {
  Figures figures;
  const std::unique_ptr<Domain> domain = open_domain(c, figures.prepare_s);
  const std::unique_ptr<SizingField> size = sizing(c);
  MesherOptions options = c.options;
  options.threads = static_cast<std::uint64_t>(threads);
  Progress progress;
  const Meter meter;
  MeshResult result = mesh_domain(*domain, *size, options, progress);
  double optimize_s = 0;
  if (c.optimize != Optimize::none) {
    with_threads(options.threads, [&] {
      const Stopwatch optimizing;
      const RuleTarget rules{bounds_on(*domain, options.bounds), size.get()};
      const bool facets_keep_rules = result.stop == Stop::converged && result.counts.absorbed_tets == 0;
      optimize_mesh(result.mesh, *domain, {c.optimize, {c.min_dihedral_deg, 180, 0, rules}, facets_keep_rules},
                    progress);
      optimize_s = optimizing.seconds();
    });
  }
  meter.read(figures);
  figures.seconds = c.optimizing_alone ? optimize_s : result.sample_s + result.refine_s + optimize_s;
  figures.stop = result.stop == Stop::converged ? "converged" : "limit";
  figures.unmet = result.counts.unmet.total();
  for (const StageAccount& s : result.stages) figures.stages.push_back({s.stage, s.seconds, s.points});
  if (optimize_s > 0) figures.stages.push_back({"optimize", optimize_s, 0});
  for (const Component& component : domain->components()) {
    ++(component.region == kOutside ? figures.object_cavities : figures.object_components);
  }
  describe(result.mesh, figures);
  leave_points(result.sample, points);
  return figures;
}

}  // namespace scantet::bench
