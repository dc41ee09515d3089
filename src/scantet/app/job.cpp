// The main job is a line of steps. Each step either moves on or ends the job: with an Error (nobody can go on), or as
// cancelled (nothing is written then). Where the user does not get what was asked for, that is collected as findings.
// The steps that need no files are in opened_job.cpp, which mesh_scan() takes, too.
#include "scantet/app/job.h"

#include <algorithm>

#include "scantet/app/certify.h"
#include "scantet/app/field_options.h"
#include "scantet/app/idle_options.h"
#include "scantet/app/job_files.h"
#include "scantet/app/mesh_plan.h"
#include "scantet/app/model_options.h"
#include "scantet/app/opened_job.h"
#include "scantet/app/order_step.h"
#include "scantet/app/outputs.h"
#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/base/phase_clock.h"
#include "scantet/base/stopwatch.h"
#include "scantet/io/input_files.h"
#include "scantet/plugin/plugin_check.h"
#include "scantet/quality/quality_fields.h"

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
  input.plugin->expect_cuts(read_cuts(job.cut));
  input.opened = open_checked(*input.plugin, job.input, progress);
  if (!progress.cancelled()) cut_opened(job, input.opened);
  return input;
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
  job.sizes.target_tets.reset();  // has chosen it
  OptionSet of_job;
  job.declare_options(of_job);
  std::vector<ReportOption> options = report_options(of_plugin);
  for (ReportOption& option : report_options(of_job)) options.push_back(std::move(option));
  return options;
}

// All files that no output may replace, as far as they are known before the input is opened.
std::vector<std::string> files_read(const MeshJob& job, const PluginRegistry& plugins) {
  std::vector<std::string> files = input_files(job.input);
  const std::vector<std::string> of_plugins = plugins.files();
  LabelOptions labels;
  for (const OptionValue& value : job.input_options) {
    if (value.name == "labels") labels.labels = value.text;
    if (value.name == "label-names") labels.names = value.text;
  }
  const std::vector<std::string> tables = labels.files(job.input);
  for (const auto* more : {&job.read, &of_plugins, &tables}) files.insert(files.end(), more->begin(), more->end());
  for (const FieldRequest& field : read_field_requests(job.fields)) {
    for (const std::string& file : input_files(field.scan)) files.push_back(file);
  }
  return files;
}

// Reports, and the certificate.
std::vector<std::string> reports_of(const MeshJob& job) {
  std::vector<std::string> files = job.reports;
  if (!job.certificate.empty()) files.push_back(job.certificate);
  return files;
}

// Adds the parts of the last phase that are told apart, and takes them out of it.
void tell_apart(std::vector<PhaseAccount>& phases, const std::vector<PhaseAccount>& parts) {
  PhaseAccount& phase = phases.back();
  for (const PhaseAccount& part : parts) {
    phase.seconds = std::max(0.0, phase.seconds - part.seconds);
    phase.cpu_seconds = std::max(0.0, phase.cpu_seconds - part.cpu_seconds);
  }
  phases.insert(phases.end(), parts.begin(), parts.end());
}

// Written beside the outputs: decks, and what the caller writes itself.
std::vector<std::string> files_beside(const MeshJob& job) {
  std::vector<std::string> files = deck_files(job.model.deck, job.outputs);
  files.insert(files.end(), job.beside.begin(), job.beside.end());
  return files;
}

// Refuses what no input would make right; what the options say of sizes.
SizePlan check_options(const MeshJob& job) {
  if (job.plan) check_plan_reports(job);
  SizePlan sizes = plan_sizes(job.sizes);
  refuse_idle_options(job, sizes);
  read_cuts(job.cut);
  read_field_requests(job.fields);
  check_order(job);
  return sizes;
}

// What the mesh was made of, and how.
void report_input(const MeshJob& job, const Input& input, const ChosenSize& size, const FieldScans& fields,
                  Report& report) {
  std::vector<std::string> read_beside = size.files;
  read_beside.insert(read_beside.end(), fields.files().begin(), fields.files().end());
  report.input = ReportInput{job.input, checksum(input.opened.files, read_beside), input.opened.frame};
  report.options = resolved_options(job, size.text, input.options);
}

// Those of scans, then those of quality. Returns false if cancelled.
bool add_fields(const MeshJob& job, const FieldScans& fields, TetMesh& mesh, JobResult& result, PhaseClock& phase,
                Progress& progress) {
  if (!job.fields.empty()) {
    phase.begin("write", "fields");
    if (!run_interruptible(progress, [&] { fields.add_to(mesh, result.report, result.notes); })) return false;
  }
  if (!job.quality_fields) return true;
  for (MeshField& field : quality_fields(mesh)) mesh.fields.push_back(std::move(field));
  return true;
}

JobResult planned_job(const MeshJob& job, const OpenedDomain& opened, const ChosenSize& size, Budget& budget) {
  JobResult result;
  const std::optional<MeshPlan> plan = plan_mesh(job, opened, size, budget);
  if (!plan) return ended_job(job, budget);
  result.notes = opened.notes;
  result.notes.insert(result.notes.end(), size.notes.begin(), size.notes.end());
  result.plan = describe_plan(*plan);
  write_plan(job, result.plan);
  result.written = job.reports;
  return result;
}

JobResult run_on_these_threads(const MeshJob& job, const PluginRegistry& plugins, Budget& budget, Progress& progress) {
  const Stopwatch total;
  JobResult result;
  Report& report = result.report;
  ReportTiming timing;

  std::vector<std::string> read = files_read(job, plugins);
  const std::vector<std::string> reports = reports_of(job), beside = files_beside(job);
  check_outputs(job.outputs, reports, read, beside);
  const SizePlan sizes = check_options(job);
  ModelPlan model = plan_model(job.model, job.outputs, budget);
  read.insert(read.end(), model.files.begin(), model.files.end());
  const Stopwatch reading;
  PhaseClock phase(report.phases, budget);
  phase.begin("read", "input");
  Input input = open_input(job, plugins, budget);
  std::optional<Certifier> certifier;
  if (job.certify != Certify::no && !job.plan) certifier.emplace(job, plugins, input.plugin->name(), input.options);
  if (budget.cancelled()) return ended_job(job, budget);
  check_regions(model, input.opened);
  phase.begin("read", "sizes");
  tell_apart(report.phases, input.opened.phases);
  ChosenSize size = choose_job_size(job, sizes, input.opened, budget);
  if (!size.field) return ended_job(job, budget);
  for (const auto* files : {&input.opened.files, &size.files}) read.insert(read.end(), files->begin(), files->end());
  check_outputs(job.outputs, reports, read, beside);
  if (job.plan) return planned_job(job, input.opened, size, budget);
  const FieldScans fields(job.fields, input.opened.domain->bounds(), model.scans, budget);
  if (budget.cancelled()) return ended_job(job, budget);
  const std::vector<PhaseAccount> fitting = fit_opened(job, sizes, size, input.opened, budget);
  if (!size.field) return ended_job(job, budget);
  phase.end();
  tell_apart(report.phases, fitting);
  timing.read = reading.seconds();

  std::optional<Meshing> meshing =
      mesh_opened(job, input.opened, size, budget, timing, result, certifier ? certifier->search() : FaultSearch());
  if (!meshing) return ended_job(job, budget);
  add_model(model, meshing->refined.mesh);
  if (!add_fields(job, fields, meshing->refined.mesh, result, phase, progress)) return ended_job(job, budget);
  std::optional<TetMesh> curved;
  if (job.order == ElementOrder::second) {
    phase.begin("write", "second order");
    curved = meshing->refined.mesh;
    if (!make_order_two(*curved, *input.opened.domain, result, progress)) return ended_job(job, budget);
  }
  phase.begin("write", "checksum of the input");
  report_input(job, input, size, fields, report);
  phase.end();
  if (certifier) certifier->note_refinement(*meshing);
  if (!write_job_files(job, input.opened, meshing->refined.mesh, curved ? *curved : meshing->refined.mesh, model,
                       timing, total, result, certifier ? &*certifier : nullptr, progress)) {
    return ended_job(job, budget);
  }
  result.mesh = std::move(curved ? *curved : meshing->refined.mesh);
  return result;
}

}  // namespace

JobResult run_mesh_job(const MeshJob& job, const PluginRegistry& plugins, Progress& progress) {
  JobResult result;
  MeshJob resolved = job;
  resolved.resolve_bounds();
  const BudgetOptions allowed = job.plan ? BudgetOptions{} : job.budget;  // a plan says what is too much
  Budget budget(progress, allowed.time_s(), allowed.memory_bytes());
  with_threads(job.mesher.threads, [&] { result = run_on_these_threads(resolved, plugins, budget, progress); });
  return result;
}

}  // namespace scantet
