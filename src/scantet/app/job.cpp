// The main job is a line of steps. Each step either moves on or ends the job: with an Error (nobody can go on), or as
// cancelled (nothing is written then). Where the user does not get what was asked for, that is collected as findings.
#include "scantet/app/job.h"

#include <algorithm>

#include "scantet/app/idle_options.h"
#include "scantet/app/job_files.h"
#include "scantet/app/job_report.h"
#include "scantet/app/meshing.h"
#include "scantet/app/outputs.h"
#include "scantet/app/proven_range.h"
#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/base/stopwatch.h"
#include "scantet/base/version.h"
#include "scantet/io/input_files.h"
#include "scantet/plugin/plugin_check.h"
#include "scantet/size_options/affordable_size.h"
#include "scantet/size_options/size_plan.h"

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
  for (const OptionValue& value : job.input_options) set_input_option(input.options, value, job.input);
  progress.report({"read", {}, 0, std::nullopt, 0});
  input.opened = open_checked(*input.plugin, job.input, progress);
  return input;
}

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
          job.budget.memory};
}

// The result of a job that has ended before there is a mesh: cancelled, or with its budget used up.
JobResult ended(const MeshJob& job, const Budget& budget) {
  JobResult result;
  result.cancelled = !budget.out_of_budget();
  if (!result.cancelled) {
    result.findings.push_back(budget_text(job.budget, budget) +
                              "; there is no mesh yet, and nothing is written; allow more, or choose a larger --size");
  }
  return result;
}

// What the mesher cannot know is said here: which input it was, and which option.
std::optional<Meshing> mesh_input(const MeshJob& job, const Domain& domain, const ChosenSize& size,
                                  Progress& progress) {
  const OptimizerOptions optimizer{
      job.optimize,
      {job.min_dihedral_deg.value_or(0), job.max_dihedral_deg.value_or(180), job.min_scaled_jacobian.value_or(0), {}}};
  try {
    return mesh_and_optimize(domain, size.field, job.mesher, optimizer, progress);
  } catch (const Error& error) {
    if (error.code() == "input.flat") refuse_too_coarse(job, size.field->min_size());
    throw;
  }
}

// The checksum of the input's files and then of those of sizes, each once.
std::string checksum(std::vector<std::string> files, const std::vector<std::string>& of_sizes) {
  for (const std::string& file : of_sizes) {
    if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  }
  return files.empty() ? "" : input_sha256(files);
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

// All files that no output may replace, as far as they are known before the input is opened.
std::vector<std::string> files_read(const MeshJob& job, const PluginRegistry& plugins) {
  std::vector<std::string> files = input_files(job.input);
  files.insert(files.end(), job.read.begin(), job.read.end());
  for (const PluginEntry& plugin : plugins.entries()) {
    if (!plugin.file.empty()) files.push_back(plugin.file);
  }
  return files;
}

JobResult run_on_these_threads(const MeshJob& job, const PluginRegistry& plugins, Budget& budget, Progress& progress) {
  const Stopwatch total;
  JobResult result;
  Report& report = result.report;
  ReportTiming timing;

  std::vector<std::string> read = files_read(job, plugins);
  check_outputs(job.outputs, job.reports, read);
  const SizePlan sizes = plan_sizes(job.sizes);
  refuse_idle_options(job, sizes);
  const Stopwatch reading;
  const Input input = open_input(job, plugins, budget);
  if (budget.cancelled()) return ended(job, budget);
  const ChosenSize size = choose_affordable_size(job.sizes, sizes, limits_of(job), input.opened, budget);
  if (!size.field) return ended(job, budget);
  for (const auto* files : {&input.opened.files, &size.files}) read.insert(read.end(), files->begin(), files->end());
  check_outputs(job.outputs, job.reports, read);
  result.notes = input.opened.notes;
  result.notes.insert(result.notes.end(), size.notes.begin(), size.notes.end());
  timing.read = reading.seconds();

  const Domain& domain = *input.opened.domain;
  const std::optional<Meshing> meshing = mesh_input(job, domain, size, budget);
  budget.close();
  if (!meshing) return ended(job, budget);
  const MeshResult& mesh = meshing->refined;
  if (mesh.mesh.tets.empty()) {
    if (budget.out_of_budget()) return ended(job, budget);
    refuse_empty(job, mesh, size.field->min_size());
  }
  timing.sample = mesh.sample_s;
  timing.refine = mesh.refine_s;
  if (job.optimize != Optimize::none) timing.optimize = meshing->optimize_s;

  if (budget.out_of_budget()) result.findings.push_back(budget_text(job.budget, budget) + "; this is the mesh by then");
  progress.report({"audit", {}, 0, std::nullopt, 0});
  const Stopwatch auditing;
  inspect(*meshing, domain, FinerSize(size.field, meshing->finer), job, budget, result);
  report.quality->set_wave_speed(job.wave_speed_m_per_s);
  timing.audit = auditing.seconds();

  report.version = kVersion;
  report.input = ReportInput{job.input, checksum(input.opened.files, size.files), input.opened.frame};
  report.options = resolved_options(job, size.text, input.options);
  report.components = input.opened.dropped;
  if (!job.no_theory) say_what_is_proven(job, result);
  progress.report({"write", {}, 0, std::nullopt, 0});
  if (!write_job_files(job, input.opened, mesh.mesh, timing, total, result, progress)) return ended(job, budget);
  return result;
}

}  // namespace

JobResult run_mesh_job(const MeshJob& job, const PluginRegistry& plugins, Progress& progress) {
  JobResult result;
  MeshJob resolved = job;
  resolved.resolve_bounds();
  Budget budget(progress, job.budget.time_s(), job.budget.memory_bytes());
  with_threads(job.mesher.threads, [&] { result = run_on_these_threads(resolved, plugins, budget, progress); });
  return result;
}

}  // namespace scantet
