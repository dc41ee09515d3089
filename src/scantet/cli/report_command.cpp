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
    declare_reports(options_, reports_);
    declare_wave_speed(options_, wave_speed_m_per_s_);
  }
  const CommandText& text() const override {
    static const CommandText text{
        "report",
        "report MESH... [--report FILE]...",
        "quality of tetrahedral meshes",
        "Measures a tetrahedral mesh (angles, radius-edge ratios, edge lengths, volumes), audits it (orientation, "
        "conformity, manifold boundary, components) and prints both. Several meshes are reported side by side, with "
        "their "
        "histograms laid over each other. Exit status 4 if the audit finds a fault.",
        {{"look at a mesh", "scantet report brain.vtu"},
         {"explore it in a browser, and keep the numbers",
          "scantet report brain.vtu --report brain.html --report brain.json"},
         {"compare meshers in one picture", "scantet report ours.vtu theirs.msh --report compared.svg"}},
        ""};
    return text;
  }
  std::vector<const OptionSet*> option_sets() const override { return {&options_}; }
  int run(const CommandLine& line) override {
    if (line.arguments.empty()) take_arguments(line, {"MESH"});  // says what is missing
    set_all(options_, line.values);
    ProgressLine progress(error_is_terminal());
    const MeshFindings found = report_on_meshes(line.arguments, reports_, progress, wave_speed_m_per_s_);
    progress.clear();
    if (found.cancelled) return print_cancelled();
    return print_findings(found);
  }

 private:
  std::vector<std::string> reports_;
  double wave_speed_m_per_s_ = kWaveSpeedMPerS;
  OptionSet options_;
};

}  // namespace

std::unique_ptr<Command> make_report_command() {
  return std::make_unique<ReportCommand>();
}

}  // namespace scantet
