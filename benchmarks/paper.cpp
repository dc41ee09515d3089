// Reruns the paper's Figures 6 and 7 (section 8.1), with exudation alone and with full improvement, and prints what
// comes out beside the paper's figures, as Markdown.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "cases.h"
#include "scantet/base/parallel.h"
#include "scantet/base/stopwatch.h"
#include "scantet/domain/analytic.h"
#include "scantet/quality/quality.h"

namespace scantet::bench {
namespace {

/// What the paper prints below a figure and in the text beside it.
struct PaperFigure {
  const char* name;  ///< of the case
  const char* title;
  std::uint64_t vertices;
  std::uint64_t tets;
  double min_dihedral_deg;
  const char* note;
};

constexpr std::array<PaperFigure, 2> kFigures{
    {{"skull", "Figure 6: skull, σ = 2 mm", 89'245, 442'542, 5, "the paper: 20 s to refine and 60 s to exude, 2009"},
     {"tanglecube", "Figure 7: tanglecube, graded", 57'293, 226'010, 1.1,
      "the paper: σ0 = 0.09 d_M on the boundary, no size inside; here: the σ of benchmarks/tanglecube.h"}}};

struct Outcome {
  QualitySummary quality;
  std::uint64_t vertices = 0;
  std::uint64_t tets = 0;
  double seconds = 0;
};

std::unique_ptr<Domain> open_domain(const Case& c) {
  return c.scan.empty() ? make_tanglecube() : make_level_set(open_scan(c), c.level);
}

Outcome run(const Case& c, const Domain& domain, Optimize optimize, double target_deg) {
  Progress progress;
  const std::unique_ptr<SizingField> size = sizing(c);
  const Stopwatch watch;
  MeshResult result = mesh_domain(domain, *size, c.options, progress);
  optimize_mesh(result.mesh, domain, {optimize, target_deg}, progress);
  const double seconds = watch.seconds();
  return {measure_quality(result.mesh), result.mesh.vertices.size(), result.mesh.tets.size(), seconds};
}

void print_row(const char* what, const Outcome& o) {
  std::printf("| %s | %zu | %zu | %.2f° | %.2f |\n", what, static_cast<std::size_t>(o.vertices),
              static_cast<std::size_t>(o.tets), o.quality.min_dihedral_deg(), o.seconds);
}

/// Shares of the tets, so that meshes of all sizes compare, as in the paper's histograms.
void print_histograms(const std::array<Outcome, 3>& outcomes) {
  std::printf("\n| inradius / circumradius | refined | exuded | improved |\n| --- | ---: | ---: | ---: |\n");
  const Histogram& bins = outcomes[0].quality.inverse_aspect.histogram;
  constexpr std::size_t kJoined = 4;  // bins of the summary to one row here
  for (std::size_t i = 0; i < bins.counts.size(); i += kJoined) {
    std::printf("| %.3f to %.3f |", bins.edges[i], bins.edges[i + kJoined]);
    for (const Outcome& o : outcomes) {
      std::uint64_t count = 0;
      for (std::size_t k = i; k < i + kJoined; ++k) count += o.quality.inverse_aspect.histogram.counts[k];
      std::printf(" %.2f %% |", 100.0 * static_cast<double>(count) / static_cast<double>(o.tets));
    }
    std::printf("\n");
  }
}

void print_figure(const PaperFigure& figure, const Case& c, double target_deg) {
  const std::unique_ptr<Domain> domain = open_domain(c);
  const std::array<Outcome, 3> outcomes{run(c, *domain, Optimize::none, 0),
                                        run(c, *domain, Optimize::exude, target_deg),
                                        run(c, *domain, Optimize::full, target_deg)};
  std::printf("\n## %s\n\n%s, α = %g, ϱ_f = %g, ϱ_t = %g; asked for dihedral angles from %g° on.\n\n", figure.title,
              figure.note, c.options.alpha, c.options.facet_radius_edge, c.options.cell_radius_edge, target_deg);
  std::printf("| | vertices | tets | min dihedral | s |\n| --- | ---: | ---: | ---: | ---: |\n");
  std::printf("| the paper, with exudation | %zu | %zu | %.1f° | |\n", static_cast<std::size_t>(figure.vertices),
              static_cast<std::size_t>(figure.tets), figure.min_dihedral_deg);
  print_row("refined", outcomes[0]);
  print_row("and exuded", outcomes[1]);
  print_row("or improved", outcomes[2]);
  print_histograms(outcomes);
}

}  // namespace
}  // namespace scantet::bench

int main(int argc, char** argv) {
  using namespace scantet::bench;
  std::string volumes = ".";
  double target_deg = 20;
  CLI::App app("The paper's Figures 6 and 7, run again", "paper");
  app.add_option("--volumes", volumes, "the folder with skull.nrrd")->capture_default_str();
  app.add_option("--min-dihedral", target_deg, "asked of exudation and improvement, degrees")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    std::printf("# The paper's figures\n\n<!-- Made by benchmarks/paper; do not edit. -->\n");
    for (const Case& c : all_cases(volumes)) {
      for (const PaperFigure& figure : kFigures) {
        if (c.name == figure.name) print_figure(figure, c, target_deg);
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "paper: %s\n", error.what());
    return 1;
  }
  return 0;
}
