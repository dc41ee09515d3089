// What makes meshes knows neither the input's name nor the options' names; what it throws and returns is put into the
// job's words here.
#include "scantet/app/opened_job.h"

#include <algorithm>

#include "scantet/app/idle_options.h"
#include "scantet/app/job_report.h"
#include "scantet/app/proven_range.h"
#include "scantet/app/volume_settling.h"
#include "scantet/base/error.h"
#include "scantet/base/stopwatch.h"
#include "scantet/base/version.h"
#include "scantet/check/layers.h"
#include "scantet/check/losses.h"
#include "scantet/size_options/affordable_size.h"

namespace scantet {
namespace {

[[noreturn]] void refuse_too_coarse(const MeshJob& job, double size_mm) {
  throw Error(Fault::input, "input.empty_mesh",
              job.input + ": no tetrahedron of size " + number_text(size_mm, 6) + " mm fits into the object",
              "choose a smaller --size, and look at scantet info " + job.input);
}

void refuse_empty(const MeshJob& job, const MeshResult& mesh, double size_mm) {
  if (mesh.stop == Stop::limit) {
    throw Error(
        Fault::usage, "usage.max_vertices",
        "--max-vertices: with " + std::to_string(job.mesher.max_vertices) + " vertices no tetrahedron was found",
        "allow more, or choose a larger --size");
  }
  refuse_too_coarse(job, size_mm);
}

SizeLimits limits_of(const MeshJob& job) {
  return {job.input,
          job.mesher.bounds.alpha,
          job.mesher.max_vertices,
          MesherOptions{}.max_vertices,
          job.budget.memory_bytes(),
          job.budget.memory,
          !job.plan};
}

/// Of those that are asked for, if any are.
LayerSearch layer_search(const ChosenSize& size) {
  if (!size.layers) return {};
  return [asked = *size.layers](const TetMesh& mesh, const Progress& progress) {
    return check_layers(mesh, asked.regions, asked.layers, asked.thinnest_mm, progress);
  };
}

// What the mesher cannot know is said here: which input it was, and which option.
std::optional<Meshing> mesh_input(const MeshJob& job, OpenedDomain& opened, const ChosenSize& size,
                                  const FaultSearch& search, const LossSearch& losses, Progress& progress) {
  OptimizerOptions optimizer{job.optimize,
                             {job.min_dihedral_deg.value_or(0),
                              job.max_dihedral_deg.value_or(180),
                              job.min_scaled_jacobian.value_or(0),
                              {},
                              job.edge_target(*size.field)}};
  try {
    std::optional<Meshing> meshing = mesh_and_optimize(*opened.domain, size.field, job.mesher, optimizer, progress,
                                                       job.max_distance_mm, search, losses);
    if (!meshing) return std::nullopt;
    const FinerSize finer(size.field, meshing->finer);
    optimizer.bounds.rules = RuleTarget{bounds_on(*opened.domain, job.mesher.bounds), &finer};
    settle_volumes(optimizer, finer, {search, losses, layer_search(size)}, opened, progress, *meshing);
    if (progress.cancelled() && !progress.out_of_budget()) return std::nullopt;
    return meshing;
  } catch (const Error& error) {
    if (error.code() == "input.flat") refuse_too_coarse(job, size.field->min_size());
    throw;
  }
}

/// Of what was a grid of regions. grid: is found when it is asked for first.
LossSearch loss_search(const OpenedDomain& opened, const SizingField& size, std::optional<RegionGrid>& grid) {
  if (!opened.grid) return {};
  return [&](const TetMesh& mesh) {
    if (!grid) grid = opened.grid();
    return find_losses(mesh, *opened.domain, *grid, size);
  };
}

// Says in the report what is proven for the job's bounds; also as a note, if the user has set one of these bounds.
void say_what_is_proven(const MeshJob& job, JobResult& result) {
  result.report.theory = beyond_proofs(job.mesher, job.sizes);
  if (!result.report.theory) return;
  for (const char* bound : {"alpha", "facet-radius-edge", "cell-radius-edge"}) {
    if (!is_given(job, bound)) continue;
    result.notes.push_back(theory_note(*result.report.theory));
    return;
  }
}

// Where curves are, all elements keep the same ratios.
void say_what_slack_does(const MeshJob& job, const Domain& domain, JobResult& result) {
  if (!is_given(job, "small-slack") || domain.curves().empty()) return;
  result.notes.push_back(
      "--small-slack does nothing here: where surfaces meet in curves, small elements keep the ratios of all");
}

}  // namespace

JobResult ended_job(const MeshJob& job, const Budget& budget) {
  JobResult result;
  result.cancelled = !budget.out_of_budget();
  if (!result.cancelled) {
    result.findings.push_back(budget_text(job.budget, budget) +
                              "; there is no mesh yet, and nothing is written; allow more, or choose a larger --size");
  }
  return result;
}

ChosenSize choose_job_size(const MeshJob& job, const SizePlan& sizes, const OpenedDomain& opened, Budget& budget) {
  return choose_affordable_size(job.sizes, sizes, limits_of(job), opened, budget);
}

std::vector<PhaseAccount> fit_opened(const MeshJob& job, const SizePlan& sizes, ChosenSize& size, OpenedDomain& opened,
                                     Budget& budget) {
  if (!opened.fit || !size.field) return {};
  FacetSizes facets{*size.field, job.mesher.bounds.alpha};
  for (const std::optional<double>& most_mm : {job.mesher.bounds.facet_distance_mm, job.max_distance_mm}) {
    facets.distance_mm = std::min(facets.distance_mm, most_mm.value_or(facets.distance_mm));
  }
  FittedDomain fitted = opened.fit(facets, budget);
  if (!fitted.domain) {
    size.field = nullptr;
    return {};
  }
  opened.domain = std::move(fitted.domain);
  opened.grid = std::move(fitted.grid);
  opened.fit = nullptr;
  opened.settle = std::move(fitted.settle);
  const std::vector<std::string> notes = opened.notes;  // of the cuts, too
  cut_opened(job, opened);
  opened.notes = notes;
  if (size.layers) size = choose_job_size(job, sizes, opened, budget);
  return std::move(fitted.phases);
}

std::optional<Meshing> mesh_opened(const MeshJob& job, OpenedDomain& opened, const ChosenSize& size, Budget& budget,
                                   ReportTiming& timing, JobResult& result, const FaultSearch& search) {
  Report& report = result.report;
  result.notes = opened.notes;
  result.notes.insert(result.notes.end(), size.notes.begin(), size.notes.end());
  std::optional<RegionGrid> grid;
  std::optional<Meshing> meshing =
      mesh_input(job, opened, size, search, loss_search(opened, *size.field, grid), budget);
  budget.close();
  if (!meshing) return std::nullopt;
  const MeshResult& mesh = meshing->refined;
  if (mesh.mesh.tets.empty()) {
    if (budget.out_of_budget()) return std::nullopt;
    refuse_empty(job, mesh, size.field->min_size());
  }
  timing.sample = mesh.sample_s;
  timing.refine = mesh.refine_s;
  if (job.optimize != Optimize::none) timing.optimize = meshing->optimize_s;

  if (budget.out_of_budget()) result.findings.push_back(budget_text(job.budget, budget) + "; this is the mesh by then");
  const Stopwatch auditing;
  report.phases.insert(report.phases.end(), meshing->phases.begin(), meshing->phases.end());
  inspect(*meshing, opened, size, job, budget, std::move(grid), result);
  report.quality->set_wave_speed(job.wave_speed_m_per_s);
  timing.audit = auditing.seconds();
  for (const PhaseAccount& phase : meshing->phases) *timing.audit += phase.seconds;
  report.version = kVersion;
  report.components = opened.dropped;
  if (!job.no_theory) say_what_is_proven(job, result);
  say_what_slack_does(job, *opened.domain, result);
  return meshing;
}

}  // namespace scantet
