// No system renames several files in one step. So everything slow is done before, and the report that tells whether the
// set is complete is renamed last.
#include "scantet/app/job_files.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "scantet/base/file_extension.h"
#include "scantet/base/phase_clock.h"
#include "scantet/base/version.h"
#include "scantet/io/file_set.h"
#include "scantet/io/mesh_io.h"
#include "scantet/io/mesh_losses.h"

namespace scantet {
namespace {

// A value as typed, but for folders: FILE, NAME=FILE.
std::string told(const std::string& value) {
  const std::size_t equals = value.find('=');
  const std::size_t begin = equals == std::string::npos ? 0 : equals + 1;
  std::error_code failure;
  for (const std::size_t at : {std::size_t{0}, begin}) {
    const std::filesystem::path path = value.substr(at);
    if (!std::filesystem::is_regular_file(path, failure)) continue;
    return value.substr(0, at) + path.filename().string();
  }
  return value.find(' ') == std::string::npos ? value : "\"" + value + "\"";
}

// " --name value" for each value; nothing for what is off, as whole numbers are at 0.
struct OptionWords {
  const std::string& name;

  std::string of(const std::string& value) const { return " --" + name + " " + value; }
  std::string operator()(std::nullptr_t) const { return ""; }
  std::string operator()(bool is_on) const { return is_on ? " --" + name : ""; }
  std::string operator()(std::uint64_t number) const { return number == 0 ? "" : of(std::to_string(number)); }
  std::string operator()(double number) const { return of(number_text(number)); }
  std::string operator()(const std::string& word) const { return of(told(word)); }
  std::string operator()(const std::vector<std::string>& words) const {
    std::string text;
    for (const std::string& word : words) text += of(told(word));
    return text;
  }
  std::string operator()(const std::vector<double>& numbers) const {
    std::string text;
    for (const double number : numbers) text += of(number_text(number));
    return text;
  }
};

// What is recorded in the mesh files: what they were made from and how, the same wherever the files lie. of_files:
// whether the input is a path, which a formula, say, is not.
std::string provenance(const MeshJob& job, bool of_files, const std::vector<ReportOption>& options) {
  std::string text = std::string("scantet ") + kVersion + " mesh " +
                     (of_files ? std::filesystem::path(job.input).filename().string() : job.input);
  for (const ReportOption& option : options) {
    constexpr std::array kOfNoMesh{"wave-speed", "max-time", "max-memory", "max-vertices", "certificate",
                                   "threads",    "output",   "report",     "no-theory",    "plan",
                                   "deck",       "hold",     "load",       "deck-template"};
    if (std::find(kOfNoMesh.begin(), kOfNoMesh.end(), option.name) != kOfNoMesh.end()) continue;
    if (option.name == "certify" && job.certify != Certify::refine) continue;  // others only look at the mesh
    text += std::visit(OptionWords{option.name}, option.value);
  }
  return text;
}

std::string name_of(const std::string& file) {
  return std::filesystem::path(file).filename().string();
}

// Names that an input brings along by itself are not.
bool are_names_asked_for(const MeshJob& job) {
  return std::any_of(job.input_options.begin(), job.input_options.end(),
                     [](const OptionValue& value) { return value.name == "label-names"; });
}

// The reports in the order in which they appear.
std::vector<std::string> json_last(std::vector<std::string> reports) {
  std::stable_partition(reports.begin(), reports.end(),
                        [](const std::string& file) { return file_extension(file) != ".json"; });
  return reports;
}

// What a complete set of files consists of.
std::vector<std::string> files_written(const MeshJob& job, const std::vector<std::string>& reports) {
  std::vector<std::string> written;
  for (const std::string& output : job.outputs) {
    for (const std::string& file : mesh_files(output)) written.push_back(file);
  }
  for (const std::string& file : deck_files(job.model.deck, job.outputs)) written.push_back(file);
  written.insert(written.end(), reports.begin(), reports.end());
  if (!job.certificate.empty()) written.push_back(job.certificate);
  return written;
}

}  // namespace

bool write_job_files(const MeshJob& job, const OpenedDomain& opened, const TetMesh& mesh, const TetMesh& written,
                     const ModelPlan& model, ReportTiming timing, const Stopwatch& total, JobResult& result,
                     Certifier* certifier, Progress& progress) {
  const Stopwatch writing;
  Report& report = result.report;
  FileSet set;
  MeshWriteOptions how;
  how.ras = job.space == Space::ras;
  how.provenance = provenance(job, !opened.files.empty(), *report.options);
  result.provenance = how.provenance;
  how.set = &set;
  const DeckKind deck = model.deck.kind;
  how.with_material_constants = deck != DeckKind::heat && deck != DeckKind::electro;  // which bring their own
  double certifying_s = 0;
  const std::vector<std::string> reports = json_last(job.reports);
  PhaseClock phase(report.phases, progress);
  phase.expect(job.outputs.size() + reports.size());
  const auto end_phase = [&] {
    phase.end();
    timing.write = writing.seconds() - certifying_s;
    timing.total = total.seconds();
    report.timing_s = timing;
  };
  for (const std::string& file : job.outputs) {
    if (progress.cancelled()) return false;
    phase.begin("write", name_of(file), 1);
    write_mesh(written, file, how);
    const std::string loss = loss_text(written, file, are_names_asked_for(job));
    if (!loss.empty()) result.notes.push_back(loss);
    if (!deck_files(deck, {file}).empty()) write_deck(model.deck, written, file, how);
  }
  if (certifier != nullptr) {
    if (progress.cancelled()) return false;
    phase.begin("audit", "certificate");
    const Stopwatch certifying;
    if (!certifier->certify(set, mesh, result, progress)) return false;
    certifying_s = certifying.seconds();
    timing.audit = timing.audit.value_or(0) + certifying_s;
  }
  report.notes = result.notes;
  bool are_listed = false;
  for (const std::string& file : reports) {
    if (progress.cancelled()) return false;
    const bool is_json = file_extension(file) == ".json";
    if (is_json && !are_listed) {
      phase.begin("write", "checksums");
      for (const FileSet::Entry& entry : set.entries()) report.files.push_back({entry.path, entry.sha256});
      are_listed = true;
    }
    end_phase();
    phase.begin("write", name_of(file), 1);
    write_report({&report, 1}, {&mesh, 1}, file, &set);
  }
  if (progress.cancelled()) return false;
  phase.begin("write", "renaming");
  set.commit();
  end_phase();
  result.written = files_written(job, reports);
  return true;
}

}  // namespace scantet
