// `scantet report`: the quality of any tetrahedral mesh.
#include "scantet/app/mesh_tools.h"
#include "scantet/cli/command.h"
#include "scantet/cli/print.h"
#include "scantet/cli/progress_line.h"
#include "scantet/cli/results.h"

namespace scantet {
namespace {

class ReportCommand final : public Command {
 public:
  ReportCommand() {
    options_.add("report", reports_,
                 {"Output", "FILE", "a file name", "Report file: .json (everything) or .csv (histograms)."});
  }
  const CommandText& text() const override {
    static const CommandText text{
        "report",
        "report MESH [--report FILE]...",
        "quality of any tetrahedral mesh",
        "Measures a tetrahedral mesh (angles, radius-edge ratios, edge lengths, volumes), audits it (orientation, "
        "conformity, manifold boundary, components) and prints both. Exit status 4 if the audit finds a fault.",
        {{"look at a mesh", "scantet report brain.vtu"},
         {"keep the figures and histograms", "scantet report brain.msh --report brain.json --report brain.csv"}},
        ""};
    return text;
  }
  std::vector<const OptionSet*> option_sets() const override { return {&options_}; }
  int run(const CommandLine& line) override {
    const std::string mesh = take_arguments(line, {"MESH"}).front();
    set_all(options_, line.values);
    ProgressLine progress(error_is_terminal());
    const JobResult result = report_on_mesh(mesh, reports_, progress);
    progress.clear();
    if (result.cancelled) return print_cancelled();
    return print_result(result, false);
  }

 private:
  std::vector<std::string> reports_;
  OptionSet options_;
};

}  // namespace

std::unique_ptr<Command> make_report_command() {
  return std::make_unique<ReportCommand>();
}

}  // namespace scantet
