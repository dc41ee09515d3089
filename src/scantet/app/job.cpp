// The main job as a line of steps. Each step either moves on, or ends the job: with an Error (nobody can go on), or as
// cancelled (nothing is written then). What the user asked for and did not get is collected as findings.
#include "scantet/app/job.h"

#include <algorithm>
#include <filesystem>

#include "scantet/app/input_files.h"
#include "scantet/app/meshing.h"
#include "scantet/app/outputs.h"
#include "scantet/app/plugin_check.h"
#include "scantet/app/proven_range.h"
#include "scantet/app/size_choice.h"
#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/base/stopwatch.h"
#include "scantet/base/version.h"
#include "scantet/io/mesh_io.h"
#include "scantet/optimize/conformance.h"
#include "scantet/quality/audit.h"
#include "scantet/quality/quality.h"

namespace scantet {
namespace {

struct Input {
  std::unique_ptr<InputPlugin> plugin;
  OptionSet options;  // of the plugin
  OpenedDomain opened;
};

// The plugin's options are set, and so checked, before it reads anything.
Input open_input(const MeshJob& job, const PluginRegistry& plugins, Progress& progress) {
  Input input;
  input.plugin = plugins.create_for(job.input);
  input.plugin->declare_options(input.options);
  for (const OptionValue& value : job.input_options) input.options.set(value);
  progress.report({"read", {}, 0, std::nullopt, 0});
  input.opened = open_checked(*input.plugin, job.input, progress);
  return input;
}

// Vertices a mesh of that size will have, roughly: measured, it is about one for each cube of the size (skull.nrrd:
// 139,000 for a volume of 155,000 cubes). Where the volume is not known, a twentieth of the bounding box stands for it.
double expected_vertices(const Domain& domain, double size_mm) {
  constexpr double kShareOfBox = 0.05;
  double volume_mm3 = 0;
  for (const Component& component : domain.components()) {
    if (component.region != kOutside) volume_mm3 += component.volume_mm3;
  }
  if (volume_mm3 == 0) {
    const Vec extent = domain.bounds().extent();
    volume_mm3 = kShareOfBox * extent.x * extent.y * extent.z;
  }
  return volume_mm3 / size_mm / size_mm / size_mm;
}

// Two digits are all that an estimate is worth: 4200, 1.2e+31.
std::string about(double count) {
  constexpr double kPlain = 1e12;
  constexpr double kMost = 1e300;
  const double unit = std::pow(10, std::floor(std::log10(std::clamp(count, 1.0, kMost))) - 1);
  const double rounded = std::round(std::min(count, kMost) / unit) * unit;
  return rounded < kPlain ? std::to_string(static_cast<std::uint64_t>(rounded)) : number_text(rounded, 2);
}

// Three digits that are not below the value: what is advised is accepted.
std::string rounded_up(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 2);
  return number_text(std::ceil(value / unit) * unit, 3);
}

void refuse_too_fine(const MeshJob& job, const OpenedDomain& opened, double size_mm) {
  if (!opened.min_size_mm || size_mm >= *opened.min_size_mm) return;
  throw Error(
      Fault::usage, "usage.size",
      "--size: " + number_text(size_mm, 6) + " mm is finer than " + job.input + " can tell: " + opened.min_size_reason,
      "choose --size " + rounded_up(*opened.min_size_mm) + " or more");
}

// The options that sizes were given with, as they were given.
std::string asked_sizes(const SizeOptions& sizes, const std::string& inside) {
  std::string text = "--size " + inside;
  if (!sizes.boundary_size.empty()) text += ", --boundary-size " + sizes.boundary_size;
  for (const std::string& size : sizes.region_sizes) text += ", --region-size " + size;
  return text;
}

// The limit on vertices ends a refinement that is too fine. A size far below that would drown the sampling before it.
ChosenSize choose_affordable_size(const MeshJob& job, const SizePlan& plan, const OpenedDomain& opened,
                                  JobResult& result, Progress& progress) {
  ChosenSize chosen = choose_size(job.sizes, plan, opened, progress);
  if (!chosen.field) return chosen;
  for (std::string& note : chosen.notes) result.notes.push_back(std::move(note));
  refuse_too_fine(job, opened, chosen.field->min_size());
  constexpr double kHopeless = 10;
  const double expected =
      chosen.uniform_mm ? expected_vertices(*opened.domain, *chosen.uniform_mm) : chosen.expected_vertices;
  const double limit = static_cast<double>(job.mesher.max_vertices);
  const double hopeless = kHopeless * std::max(limit, static_cast<double>(MesherOptions{}.max_vertices));
  if (expected <= limit) return chosen;
  const double least_mm = chosen.field->min_size();
  const std::string asked = chosen.uniform_mm ? "--size: " + number_text(least_mm) + " mm means"
                                              : asked_sizes(job.sizes, chosen.text) + ": sizes from " +
                                                    number_text(least_mm, 3) + " mm on mean";
  const std::string what = asked + " about " + about(expected) + " vertices, and --max-vertices is " +
                           std::to_string(job.mesher.max_vertices);
  const double enough_mm = least_mm * std::cbrt(expected / limit);
  const std::string remedy =
      "choose a larger size" + (std::isfinite(enough_mm) ? ", about " + number_text(enough_mm, 2) + " mm or more" : "");
  if (expected > hopeless) throw Error(Fault::usage, "usage.size", what, remedy);
  result.notes.push_back(what + "; " + remedy);
  return chosen;
}

[[noreturn]] void refuse_too_coarse(const MeshJob& job, double size_mm) {
  throw Error(Fault::input, "input.empty_mesh",
              job.input + ": no tetrahedron of size " + number_text(size_mm, 6) + " mm fits into the object",
              "choose a smaller --size, and look at scantet info " + job.input);
}

void refuse_empty(const MeshJob& job, const MeshResult& mesh, double size_mm) {
  if (!mesh.mesh.tets.empty()) return;
  if (mesh.stop == Stop::limit) {
    throw Error(
        Fault::usage, "usage.max_vertices",
        "--max-vertices: with " + std::to_string(job.mesher.max_vertices) + " vertices no tetrahedron was found",
        "allow more, or choose a larger --size");
  }
  refuse_too_coarse(job, size_mm);
}

// What the mesher cannot know is said here: which input it was, and which option.
std::optional<Meshing> mesh_input(const MeshJob& job, const Domain& domain, const ChosenSize& size,
                                  const OptimizerOptions& optimizer, Progress& progress) {
  try {
    return mesh_and_optimize(domain, size.field, job.mesher, optimizer, progress);
  } catch (const Error& error) {
    if (error.code() == "input.flat") refuse_too_coarse(job, size.field->min_size());
    throw;
  }
}

std::string checksum(const std::vector<std::string>& files) {
  return files.empty() ? "" : input_sha256(files);
}

ReportRules report_rules(const MeshResult& mesh, const UnmetRules& unmet) {
  ReportRules rules;
  rules.initial_points = mesh.initial_points;
  rules.lattice_points = mesh.lattice_points;
  rules.repair_points = mesh.repair_points;
  rules.absorbed_tets = mesh.absorbed_tets;
  rules.r1 = mesh.inserted.r1;
  rules.r2 = mesh.inserted.r2;
  rules.r3_1 = mesh.inserted.r3_1;
  rules.r3_2 = mesh.inserted.r3_2;
  rules.unmet_r1 = unmet.r1;
  rules.unmet_r2 = unmet.r2;
  rules.unmet_r3 = unmet.r3;
  return rules;
}

ReportOptimization report_optimization(const Meshing& meshing, double target_deg) {
  ReportOptimization report;
  report.target_deg = target_deg;
  report.tets_below = meshing.sharp.size();
  for (const OptimizerStage& s : meshing.optimized.stages) {
    report.stages.push_back({s.stage, s.seconds, s.changes, s.min_dihedral_before_deg, s.min_dihedral_after_deg});
  }
  report.finer_places = meshing.finer.size();
  for (const FinerPlace& place : meshing.finer) {
    report.smallest_size_mm = std::min(report.smallest_size_mm.value_or(place.size_mm), place.size_mm);
  }
  return report;
}

std::vector<ReportStage> report_stages(const std::vector<StageAccount>& accounts) {
  std::vector<ReportStage> stages;
  for (const StageAccount& account : accounts) stages.push_back({account.stage, account.seconds, account.points});
  return stages;
}

// The job's options with the size that was chosen, then those of the plugin.
std::vector<ReportOption> resolved_options(MeshJob job, const std::string& size, const OptionSet& of_plugin) {
  job.sizes.size = size;
  OptionSet of_job;
  job.declare_options(of_job);
  std::vector<ReportOption> options = report_options(of_plugin);
  for (ReportOption& option : report_options(of_job)) options.push_back(std::move(option));
  return options;
}

// Recorded in the mesh files: what they were made from and how, the same wherever the files lie. An input of no file
// (a formula, say) is no path.
std::string provenance(const MeshJob& job, bool of_files, const std::vector<ReportOption>& options) {
  std::string text = std::string("scantet ") + kVersion + " mesh " +
                     (of_files ? std::filesystem::path(job.input).filename().string() : job.input);
  for (const ReportOption& option : options) {
    if (const auto* number = std::get_if<double>(&option.value))
      text += " --" + option.name + " " + number_text(*number);
    if (const auto* word = std::get_if<std::string>(&option.value)) text += " --" + option.name + " " + *word;
    if (const auto* numbers = std::get_if<std::vector<double>>(&option.value)) {
      for (const double each : *numbers) text += " --" + option.name + " " + number_text(each);
    }
  }
  return text;
}

void find_unmet(const MeshResult& mesh, const MesherOptions& options, JobResult& result) {
  if (mesh.stop == Stop::limit) {
    std::string text = "refinement stopped at --max-vertices " + std::to_string(options.max_vertices);
    if (mesh.limit) {
      const Point& p = mesh.limit->place;
      text += " while " + mesh.limit->rule + " kept firing, last at (" + number_text(p.x, 6) + ", " +
              number_text(p.y, 6) + ", " + number_text(p.z, 6) + ") mm, " +
              number_text(mesh.limit->insertion_radius_mm, 3) + " mm from the next vertex";
    }
    result.findings.push_back(text + "; allow more vertices, choose a larger --size, or loosen the bounds");
  }
  const ReportRules& rules = *result.report.rules;
  const auto unmet = [&](std::uint64_t count, const char* what) {
    if (count > 0) result.findings.push_back(std::to_string(count) + " " + what);
  };
  unmet(rules.unmet_r1,
        "boundary facets violate R1 (--facet-radius-edge, or a vertex off the boundary or on another surface)");
  unmet(rules.unmet_r2, "boundary facets violate R2 (--size, --alpha, --facet-distance)");
  unmet(rules.unmet_r3, "tets violate R3 (--size, --cell-radius-edge)");
}

void find_sharp(const Meshing& meshing, double target_deg, JobResult& result) {
  if (meshing.sharp.empty()) return;
  const WorstTet& worst = meshing.sharp.front();
  result.findings.push_back(std::to_string(meshing.sharp.size()) + " tets have a dihedral angle under --min-dihedral " +
                            number_text(target_deg) + ", the smallest of " + number_text(worst.value, 3) +
                            " degrees at (" + number_text(worst.place.x, 6) + ", " + number_text(worst.place.y, 6) +
                            ", " + number_text(worst.place.z, 6) +
                            ") mm; choose a smaller --size or a smaller --min-dihedral");
}

ReportConformance report_conformance(const RuleConformance& c) {
  return {c.r1, c.r2, c.r3, c.facets, c.tets};
}

void inspect(const Meshing& meshing, const Domain& domain, const SizingField& size, const MesherOptions& options,
             JobResult& result) {
  const MeshResult& mesh = meshing.refined;
  Report& report = result.report;
  report.quality = measure_quality(mesh.mesh, size.bounds_tets() ? &size : nullptr);
  report.mesh = report_mesh(mesh.mesh, *report.quality);
  // From scratch, with nothing taken over from the engine's books.
  report.rules = report_rules(mesh, check_rules(mesh.sample, mesh.sample_on_boundary, domain, size, options));
  if (!meshing.optimized.stages.empty()) {
    const RuleBounds bounds{options.alpha, options.facet_radius_edge, options.cell_radius_edge,
                            options.facet_distance_mm};
    report.optimization->after = report_conformance(check_conformance(mesh.mesh, domain, size, bounds));
  }
  find_unmet(mesh, options, result);
  AuditOptions audit_options;
  audit_options.restricted_delaunay = mesh.absorbed_tets == 0 && meshing.optimized.stages.empty();
  report.audit = audit(mesh.mesh, &domain, audit_options);
  if (mesh.absorbed_tets > 0) {
    result.notes.push_back(std::to_string(mesh.absorbed_tets) +
                           " tets in fragments smaller than the size, where the surface is pinched, changed sides");
  }
  if (!meshing.finer.empty()) {
    result.notes.push_back("the size was made finer at " + std::to_string(meshing.finer.size()) + " places, down to " +
                           number_text(*report.optimization->smallest_size_mm, 3) +
                           " mm, where larger tets would have stayed too flat or the surface tangled");
  }
  for (const Finding& finding : report.audit->findings) {
    result.findings.push_back(finding.message + "; " + finding.remedy);
  }
}

JobResult run_on_these_threads(const MeshJob& job, const PluginRegistry& plugins, Progress& progress) {
  const Stopwatch total;
  JobResult result;
  Report& report = result.report;
  JobResult cancelled;
  cancelled.cancelled = true;
  ReportTiming timing;

  check_outputs(job.outputs, job.reports, input_files(job.input));
  const SizePlan sizes = plan_sizes(job.sizes);
  const Stopwatch reading;
  const Input input = open_input(job, plugins, progress);
  if (progress.cancelled()) return cancelled;
  const ChosenSize size = choose_affordable_size(job, sizes, input.opened, result, progress);
  if (!size.field) return cancelled;
  timing.read = reading.seconds();

  const Domain& domain = *input.opened.domain;
  const bool has_target = job.optimize != Optimize::none || job.min_dihedral_deg;
  const OptimizerOptions optimizer{job.optimize, has_target ? job.min_dihedral_deg.value_or(kMinDihedralDeg) : 0};
  const std::optional<Meshing> meshing = mesh_input(job, domain, size, optimizer, progress);
  if (!meshing) return cancelled;
  const MeshResult* mesh = &meshing->refined;
  refuse_empty(job, *mesh, size.field->min_size());
  timing.sample = mesh->sample_s;
  timing.refine = mesh->refine_s;
  report.stages = report_stages(mesh->stages);
  if (has_target) report.optimization = report_optimization(*meshing, optimizer.min_dihedral_deg);
  if (job.optimize != Optimize::none) timing.optimize = meshing->optimize_s;

  progress.report({"audit", {}, 0, std::nullopt, 0});
  const Stopwatch auditing;
  inspect(*meshing, domain, FinerSize(size.field, meshing->finer), job.mesher, result);
  find_sharp(*meshing, optimizer.min_dihedral_deg, result);
  timing.audit = auditing.seconds();

  report.version = kVersion;
  report.input = ReportInput{job.input, checksum(input.opened.files), input.opened.frame};
  report.options = resolved_options(job, size.text, input.options);
  report.stop = mesh->stop == Stop::limit ? "limit" : "converged";
  if (mesh->limit) report.limit = ReportLimit{mesh->limit->rule, mesh->limit->place, mesh->limit->insertion_radius_mm};
  if (const auto note = beyond_proofs(job.mesher, job.sizes); note && !job.no_theory) result.notes.push_back(*note);
  if (progress.cancelled()) return cancelled;

  progress.report({"write", {}, 0, std::nullopt, 0});
  const Stopwatch writing;
  MeshWriteOptions how;
  how.ras = job.space == Space::ras;
  how.provenance = provenance(job, !input.opened.files.empty(), *report.options);
  for (const std::string& file : job.outputs) {
    write_mesh(mesh->mesh, file, how);
    result.written.push_back(file);
  }
  timing.write = writing.seconds();
  timing.total = total.seconds();
  report.timing_s = timing;
  for (const std::string& file : job.reports) {
    write_report({&report, 1}, {&mesh->mesh, 1}, file);
    result.written.push_back(file);
  }
  return result;
}

}  // namespace

JobResult run_mesh_job(const MeshJob& job, const PluginRegistry& plugins, Progress& progress) {
  JobResult result;
  with_threads(job.mesher.threads, [&] { result = run_on_these_threads(job, plugins, progress); });
  return result;
}

}  // namespace scantet
