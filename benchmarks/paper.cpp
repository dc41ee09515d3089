// Reruns the paper's Figures 6 and 7 (section 8.1), 8 and 10 (8.2), with exudation alone and with full improvement, and
// prints what comes out beside the paper's figures, as Markdown. The surfaces of 8 and 10 are not to be had: CGAL's
// data has others of their kind.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "cases.h"
#include "inputs.h"
#include "scantet/app/built_in_plugins.h"
#include "scantet/base/parallel.h"
#include "scantet/base/stopwatch.h"
#include "scantet/check/audit.h"
#include "scantet/domain/analytic.h"
#include "scantet/plugin/plugin_loader.h"
#include "scantet/quality/quality.h"
#include "scantet/size_options/size_choice.h"
#include "scantet/size_options/size_plan.h"
#include "surface_gap.h"

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
      "both: 0.09 d_M on the boundary, no size inside, from a sample of the boundary alone; ours at least 0.01"}}};

/// The paper's section 8.2: surfaces with sharp edges, σ uniform, α = 1.
struct Polyhedron {
  const char* title;
  const char* surface;  ///< a file of CGAL's data
  std::vector<double> sizes_mm;
  const char* note;
  const char* paper_row;  ///< of the table; may be empty
};

const std::array<Polyhedron, 2> kPolyhedra{
    {{"Figure 8: a mechanical part",
      "meshes/anchor_dense.off",
      {0.0182},
      "the paper's part has 37,787 vertices",
      "| the paper, with exudation | | 15687 | 71757 | 3.2° | | | \"the same topological type\" | | |\n"},
     {"Figure 10: sharp edges of 90° and less",
      "meshes/fandisk.off",
      {0.02, 0.01},
      "the paper says that the topology is captured and that the surface is met as near as the sampling is dense, "
      "without figures",
      ""}}};

struct Outcome {
  TetMesh mesh;
  QualitySummary quality;
  std::uint64_t vertices = 0;
  std::uint64_t tets = 0;
  double seconds = 0;
};

/// What is meshed for a figure, and how.
struct Job {
  std::unique_ptr<Domain> domain;
  std::shared_ptr<const SizingField> size;
  MesherOptions options;
};

Job image_job(const Case& c) {
  return {make_level_set(open_scan(c), c.level), sizing(c), c.options};
}

/// As `scantet mesh implicit:tanglecube --size auto --feature-share 0.09 --least-size 0.01 --seeding paper`.
Job tanglecube_job() {
  OpenedDomain opened;
  opened.domain = make_tanglecube();
  SizeOptions sizes;
  sizes.size = "auto";
  sizes.feature_share = 0.09;
  sizes.least_mm = 0.01;
  Progress progress;
  std::shared_ptr<const SizingField> field = choose_size(sizes, plan_sizes(sizes), opened, progress).field;
  MesherOptions options;
  options.seeding = Seeding::paper;
  options.bounds.small_slack = 1;
  return {std::move(opened.domain), std::move(field), options};
}

Outcome run(const Job& job, Optimize optimize, double target_deg) {
  Progress progress;
  const Domain& domain = *job.domain;
  const Stopwatch watch;
  MeshResult result = mesh_domain(domain, *job.size, job.options, progress);
  optimize_mesh(result.mesh, domain, {optimize, {.min_dihedral_deg = target_deg}}, progress);
  const double seconds = watch.seconds();
  Outcome outcome{std::move(result.mesh), {}, 0, 0, seconds};
  outcome.quality = measure_quality(outcome.mesh);
  outcome.vertices = outcome.mesh.vertices.size();
  outcome.tets = outcome.mesh.tets.size();
  return outcome;
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

void print_figure(const PaperFigure& figure, const Job& job, double target_deg) {
  const std::array<Outcome, 3> outcomes{run(job, Optimize::none, 0), run(job, Optimize::exude, target_deg),
                                        run(job, Optimize::full, target_deg)};
  std::printf("\n## %s\n\n%s, α = %g, ϱ_f = %g, ϱ_t = %g; asked for dihedral angles from %g° on.\n\n", figure.title,
              figure.note, job.options.bounds.alpha, job.options.bounds.facet_radius_edge,
              job.options.bounds.cell_radius_edge, target_deg);
  std::printf("| | vertices | tets | min dihedral | s |\n| --- | ---: | ---: | ---: | ---: |\n");
  std::printf("| the paper, with exudation | %zu | %zu | %.1f° | |\n", static_cast<std::size_t>(figure.vertices),
              static_cast<std::size_t>(figure.tets), figure.min_dihedral_deg);
  print_row("refined", outcomes[0]);
  print_row("and exuded", outcomes[1]);
  print_row("or improved", outcomes[2]);
  print_histograms(outcomes);
}

/// V - E + F of the surface in a file.
std::int64_t euler_number(const std::string& file) {
  PluginRegistry plugins = built_in_plugins();
  load_plugin_folder(plugin_folder(), plugins);
  Progress progress;
  for (const InfoSection& section : plugins.create_for(file)->info(file, progress)) {
    for (const InfoEntry& entry : section.entries) {
      if (entry.key == "euler") return std::get<std::int64_t>(entry.value);
    }
  }
  throw std::runtime_error(file + ": its Euler number is not known");
}

void print_polyhedron_row(const char* what, double size_mm, const Outcome& o, const Domain& domain) {
  const AuditReport topology = audit(o.mesh, nullptr);
  const SurfaceGap gap = surface_gap(o.mesh, domain, 0.5 * size_mm);
  std::printf("| %s | %g | %zu | %zu | %.2f° | %.2f | %s | %zu, %zu, %lld | %.2f σ | %.2f σ |\n", what, size_mm,
              static_cast<std::size_t>(o.vertices), static_cast<std::size_t>(o.tets), o.quality.min_dihedral_deg(),
              o.seconds, topology.manifold() ? "yes" : "no", topology.components.size(),
              static_cast<std::size_t>(topology.cavities), static_cast<long long>(topology.boundary_euler),
              gap.from_mesh_mm / size_mm, gap.from_surface_mm / size_mm);
}

void print_polyhedron(const Polyhedron& p, double target_deg) {
  const std::string file = cgal_data_file(p.surface);
  Job job{open_input(file).domain, nullptr, {}};
  const std::vector<Component> components = job.domain->components();
  std::size_t cavities = 0;
  for (const Component& component : components) cavities += component.region == kOutside ? 1 : 0;
  std::printf(
      "\n## %s\n\n`%s` of CGAL's data; %s. α = 1, ϱ_f = 1, ϱ_t = 2; asked for dihedral angles from %g° on. "
      "Distances: the farthest point of the mesh's boundary from the surface (15 samples a facet), and the farthest of "
      "the surface from the mesh's boundary (samples 0.5 σ apart).\n\n",
      p.title, p.surface, p.note, target_deg);
  std::printf(
      "| | σ, mm | vertices | tets | min dihedral | s | manifold | components, cavities, Euler number | from mesh | "
      "from surface |\n| --- | ---: | ---: | ---: | ---: | ---: | --- | ---: | ---: | ---: |\n%s",
      p.paper_row);
  std::printf("| the surface | | | | | | yes | %zu, %zu, %lld | | |\n", components.size() - cavities, cavities,
              static_cast<long long>(euler_number(file)));
  for (const double size_mm : p.sizes_mm) {
    job.size = std::make_shared<UniformSize>(size_mm);
    print_polyhedron_row("refined", size_mm, run(job, Optimize::none, 0), *job.domain);
    print_polyhedron_row("and exuded", size_mm, run(job, Optimize::exude, target_deg), *job.domain);
    print_polyhedron_row("or improved", size_mm, run(job, Optimize::full, target_deg), *job.domain);
  }
}

}  // namespace
}  // namespace scantet::bench

int main(int argc, char** argv) {
  using namespace scantet::bench;
  std::string volumes = ".";
  double target_deg = 20;
  std::vector<std::string> figures{"6", "7", "8", "10"};
  CLI::App app("The paper's Figures 6, 7, 8 and 10, run again", "paper");
  app.add_option("--volumes", volumes, "the folder with skull.nrrd")->capture_default_str();
  app.add_option("--min-dihedral", target_deg, "asked of exudation and improvement, degrees")->capture_default_str();
  app.add_option("--figures", figures, "which")
      ->delimiter(',')
      ->check(CLI::IsMember({"6", "7", "8", "10"}))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    std::printf("# The paper's figures\n\n<!-- Made by benchmarks/paper; do not edit. -->\n");
    const auto wanted = [&](const char* title) {
      const std::string start = title;  // "Figure 6: ..."
      const std::string number = start.substr(7, start.find(':') - 7);
      return std::find(figures.begin(), figures.end(), number) != figures.end();
    };
    for (const Case& c : all_cases(volumes)) {
      for (const PaperFigure& figure : kFigures) {
        if (c.name != figure.name || !wanted(figure.title)) continue;
        print_figure(figure, c.scan.empty() ? tanglecube_job() : image_job(c), target_deg);
      }
    }
    for (const Polyhedron& polyhedron : kPolyhedra) {
      if (wanted(polyhedron.title)) print_polyhedron(polyhedron, target_deg);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "paper: %s\n", error.what());
    return 1;
  }
  return 0;
}
