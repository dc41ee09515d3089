// `scantet verify`: whether a mesh is the scan, proved.
#include "scantet/app/certify.h"
#include "scantet/app/plugin_object.h"
#include "scantet/cli/command.h"
#include "scantet/cli/plugin_options.h"
#include "scantet/cli/print.h"
#include "scantet/cli/progress_line.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/verification/verify_job.h"

namespace scantet {
namespace {

class VerifyCommand final : public Command {
 public:
  VerifyCommand() {
    job_.declare_options(options_);
    declare_reports(own_, reports_);
  }
  const CommandText& text() const override {
    static const CommandText text{
        "verify",
        "verify MESH --against SCAN [--level V | --labels LIST] [options]",
        "whether a mesh is the scan, proved",
        "Verifies a tetrahedral mesh, of whatever program, against the scan or surface it was made from, by code that "
        "shares "
        "nothing "
        "with the mesher, with interval arithmetic. Certified: the mesh's boundary is isotopic to the level set, and "
        "no "
        "farther from it than the bound; bounded: distance bounded and components, cavities and handles the same (of a "
        "label map: each label's parts that have voxels; its handles are not compared); "
        "undecided: neither could be proved; not the scan: something is wrong. docs/certificate.md says how. Exit "
        "status "
        "0 if the grade is that of --require or better, 4 otherwise.",
        {{"a mesh of values above 60", "scantet verify ours.vtu --against head.nii.gz --level 60"},
         {"for an archive: the certificate as a file; distance and topology are enough",
          "scantet verify bone.msh --against ct.nrrd --level 300 --require bounded --json bone.cert.json"},
         {"a mesh of a level set of OpenVDB's", "scantet verify ours.vtu --against shape.vdb --level 0 --inside below"},
         {"a mesh of what a surface encloses", "scantet verify ours.vtu --against bone.stl --require bounded"},
         {"the mesh over the scan, with the places where a proof fails",
          "scantet verify bone.msh --against ct.nrrd --level 300 --report bone.html"},
         {"the same again, by whoever has the certificate and both files",
          "scantet verify --certificate bone.cert.json"}},
        ""};
    return text;
  }
  std::vector<const OptionSet*> option_sets() const override { return {&options_, &own_}; }
  int run(const CommandLine& line) override {
    std::vector<OptionValue> values;  // of the job
    for (const OptionValue& value : line.values) {
      if (own_.find(value.name) == nullptr) {
        values.push_back(value);
      } else {
        own_.set(value);
      }
    }
    set_all(options_, values);
    const bool is_recorded = !job_.certificate.empty();
    if (!is_recorded || !line.arguments.empty()) job_.mesh = take_arguments(line, {"MESH"}).front();
    VerifyJob job = is_recorded ? recorded_job(job_, values) : job_;
    job.options.lists_facets = has_page(reports_);
    // Plugins are loaded only for what is no image: each of them takes a process of its own first.
    PluginRegistry plugins;
    if (!job.against.empty() && can_read_scan(job.against) == 0) {
      plugins = load_plugins({});
      job.read = plugins.files();
      job.read_object = [&plugins](const VerifyJob& of, Progress& progress) {
        return plugin_object(plugins, of, progress);
      };
    }
    check_reports(job, reports_);
    ProgressLine progress(error_is_terminal());
    VerifyOutcome outcome = run_verify(job, progress);
    std::vector<std::string> written;
    if (!outcome.cancelled && !reports_.empty()) {
      written = report_on_verification(job, outcome, reports_, progress);
      outcome.cancelled = written.empty();
    }
    progress.clear();
    if (outcome.cancelled) return print_cancelled();
    print(outcome.text);
    if (!job_.json.empty()) print("wrote " + job_.json + "\n");
    for (const std::string& file : written) print("wrote " + file + "\n");
    return outcome.is_as_required ? kExitDone : kExitUnmet;
  }

 private:
  VerifyJob job_;
  OptionSet options_;
  std::vector<std::string> reports_;
  OptionSet own_;  // of the command itself
};

}  // namespace

std::unique_ptr<Command> make_verify_command() {
  return std::make_unique<VerifyCommand>();
}

}  // namespace scantet
