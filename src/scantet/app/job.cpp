// The main job as a line of steps. Each step either moves on, or ends the job: with an Error (nobody can go on), or as
// cancelled (nothing is written then). What the user asked for and did not get is collected as findings.
#include "scantet/app/job.h"

#include <algorithm>
#include <filesystem>

#include "scantet/app/affordable_size.h"
#include "scantet/app/idle_options.h"
#include "scantet/app/input_files.h"
#include "scantet/app/inspection.h"
#include "scantet/app/meshing.h"
#include "scantet/app/outputs.h"
#include "scantet/app/plugin_check.h"
#include "scantet/app/proven_range.h"
#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/base/stopwatch.h"
#include "scantet/base/version.h"
#include "scantet/io/mesh_io.h"

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

// Of the input's files, then those of sizes, each once.
std::string checksum(std::vector<std::string> files, const std::vector<std::string>& of_sizes) {
  for (const std::string& file : of_sizes) {
    if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  }
  return files.empty() ? "" : input_sha256(files);
}

ReportComponents report_components(const DroppedComponents& dropped) {
  ReportComponents report{dropped.found, 0, {}};
  for (const Component& component : dropped.components) {
    report.dropped_volume_mm3 += component.volume_mm3;
    report.dropped.push_back({component.witness, component.volume_mm3, component.region});
  }
  return report;
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
    if (option.name == "wave-speed") continue;  // of reports alone
    if (const auto* number = std::get_if<double>(&option.value))
      text += " --" + option.name + " " + number_text(*number);
    if (const auto* word = std::get_if<std::string>(&option.value)) text += " --" + option.name + " " + *word;
    if (const auto* numbers = std::get_if<std::vector<double>>(&option.value)) {
      for (const double each : *numbers) text += " --" + option.name + " " + number_text(each);
    }
  }
  return text;
}

// In the report; as a note, too, if the user has set one of the bounds that it is about.
void say_what_is_proven(const MeshJob& job, JobResult& result) {
  result.report.theory = beyond_proofs(job.mesher, job.sizes);
  if (!result.report.theory) return;
  for (const char* bound : {"alpha", "facet-radius-edge", "cell-radius-edge"}) {
    if (!is_given(job, bound)) continue;
    result.notes.push_back(theory_note(*result.report.theory));
    return;
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
  refuse_idle_options(job, sizes);
  const Stopwatch reading;
  const Input input = open_input(job, plugins, progress);
  if (progress.cancelled()) return cancelled;
  const ChosenSize size = choose_affordable_size(job, sizes, input.opened, progress);
  if (!size.field) return cancelled;
  result.notes = input.opened.notes;
  result.notes.insert(result.notes.end(), size.notes.begin(), size.notes.end());
  timing.read = reading.seconds();

  const Domain& domain = *input.opened.domain;
  const OptimizerOptions optimizer{
      job.optimize,
      {job.min_dihedral_deg.value_or(0), job.max_dihedral_deg.value_or(180), job.min_scaled_jacobian.value_or(0), {}}};
  const std::optional<Meshing> meshing = mesh_input(job, domain, size, optimizer, progress);
  if (!meshing) return cancelled;
  const MeshResult* mesh = &meshing->refined;
  refuse_empty(job, *mesh, size.field->min_size());
  timing.sample = mesh->sample_s;
  timing.refine = mesh->refine_s;
  if (job.optimize != Optimize::none) timing.optimize = meshing->optimize_s;

  progress.report({"audit", {}, 0, std::nullopt, 0});
  const Stopwatch auditing;
  inspect(*meshing, domain, FinerSize(size.field, meshing->finer), job, result);
  report.quality->set_wave_speed(job.wave_speed_m_per_s);
  timing.audit = auditing.seconds();

  report.version = kVersion;
  report.input = ReportInput{job.input, checksum(input.opened.files, size.files), input.opened.frame};
  report.options = resolved_options(job, size.text, input.options);
  if (input.opened.dropped) report.components = report_components(*input.opened.dropped);
  if (!job.no_theory) say_what_is_proven(job, result);
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
  MeshJob resolved = job;
  resolved.resolve_bounds();
  with_threads(job.mesher.threads, [&] { result = run_on_these_threads(resolved, plugins, progress); });
  return result;
}

}  // namespace scantet
