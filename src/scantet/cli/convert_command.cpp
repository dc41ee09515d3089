// `scantet convert`: one mesh format into another.
#include "scantet/app/mesh_tools.h"
#include "scantet/cli/command.h"
#include "scantet/cli/print.h"
#include "scantet/cli/progress_line.h"

namespace scantet {
namespace {

class ConvertCommand final : public Command {
 public:
  ConvertCommand() { declare_space(options_, space_); }
  const CommandText& text() const override {
    static const CommandText text{
        "convert",
        "convert MESH FILE [options]",
        "turn a mesh file into another format",
        "Reads a tetrahedral mesh and writes it to FILE in the format of its extension; regions are kept, and the "
        "boundary is derived anew from the tetrahedra.",
        {{"for Abaqus or CalculiX", "scantet convert brain.vtu brain.inp"},
         {"the surface alone, in RAS coordinates", "scantet convert brain.vtu brain.stl --space ras"}},
        ""};
    return text;
  }
  std::vector<const OptionSet*> option_sets() const override { return {&options_}; }
  int run(const CommandLine& line) override {
    const std::vector<std::string> files = take_arguments(line, {"MESH", "FILE"});
    set_all(options_, line.values);
    ProgressLine progress(error_is_terminal());
    const bool done = convert_mesh(files[0], files[1], space_, progress);
    progress.clear();
    if (!done) return print_cancelled();
    print("wrote " + files[1] + "\n");
    return kExitDone;
  }

 private:
  Space space_ = Space::lps;
  OptionSet options_;
};

}  // namespace

std::unique_ptr<Command> make_convert_command() {
  return std::make_unique<ConvertCommand>();
}

}  // namespace scantet
