// `scantet verify`: whether a mesh is the scan, proved.
#include "scantet/cli/command.h"
#include "scantet/cli/print.h"
#include "scantet/cli/progress_line.h"
#include "scantet/verification/verify_job.h"

namespace scantet {
namespace {

class VerifyCommand final : public Command {
 public:
  VerifyCommand() { job_.declare_options(options_); }
  const CommandText& text() const override {
    static const CommandText text{
        "verify",
        "verify MESH --against SCAN --level V [options]",
        "whether a mesh is the scan, proved",
        "Verifies a tetrahedral mesh, of whatever program, against the scan it was made from, by code that shares "
        "nothing "
        "with the mesher, with interval arithmetic. Certified: the mesh's boundary is isotopic to the level set, and "
        "no "
        "farther from it than the bound; bounded: distance bounded and components, cavities and handles the same; "
        "undecided: neither could be proved; not the scan: something is wrong. docs/certificate.md says how. Exit "
        "status "
        "0 if the grade is that of --require or better, 4 otherwise.",
        {{"a mesh of values above 60", "scantet verify ours.vtu --against head.nii.gz --level 60"},
         {"for an archive: the certificate as a file; distance and topology are enough",
          "scantet verify bone.msh --against ct.nrrd --level 300 --require bounded --json bone.cert.json"},
         {"the same again, by whoever has the certificate and both files",
          "scantet verify --certificate bone.cert.json"}},
        ""};
    return text;
  }
  std::vector<const OptionSet*> option_sets() const override { return {&options_}; }
  int run(const CommandLine& line) override {
    set_all(options_, line.values);
    const bool is_recorded = !job_.certificate.empty();
    if (!is_recorded || !line.arguments.empty()) job_.mesh = take_arguments(line, {"MESH"}).front();
    const VerifyJob job = is_recorded ? recorded_job(job_, line.values) : job_;
    ProgressLine progress(error_is_terminal());
    const VerifyOutcome outcome = run_verify(job, progress);
    progress.clear();
    if (outcome.cancelled) return print_cancelled();
    print(outcome.text);
    if (!job_.json.empty()) print("wrote " + job_.json + "\n");
    return outcome.is_as_required ? kExitDone : kExitUnmet;
  }

 private:
  VerifyJob job_;
  OptionSet options_;
};

}  // namespace

std::unique_ptr<Command> make_verify_command() {
  return std::make_unique<VerifyCommand>();
}

}  // namespace scantet
