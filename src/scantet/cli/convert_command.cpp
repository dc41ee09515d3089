// `scantet convert`: one mesh format into another, or what a plugin can turn into a file of another kind.
#include "scantet/app/idle_options.h"
#include "scantet/app/mesh_tools.h"
#include "scantet/cli/command.h"
#include "scantet/cli/plugin_options.h"
#include "scantet/cli/print.h"
#include "scantet/cli/progress_line.h"
#include "scantet/io/mesh_io.h"
#include "scantet/plugin/plugin_check.h"

namespace scantet {
namespace {

class ConvertCommand final : public Command {
 public:
  explicit ConvertCommand(const PluginRegistry& plugins)
      : plugins_(plugins), plugin_options_(plugins, &InputPlugin::declare_convert_options) {
    declare_space(mesh_options_, space_);
    declare_plugin_files(options_, plugin_files_);
  }
  const CommandText& text() const override {
    static const CommandText text{
        "convert",
        "convert INPUT FILE [options]",
        "turn a mesh file into another format, or a scan into .vdb",
        "Reads a tetrahedral mesh and writes it to FILE in the format of its extension; regions are kept, and the "
        "boundary is derived anew from the tetrahedra. Notes say what of the mesh FILE cannot hold. With the plugin "
        "vdb, a "
        "scan becomes an OpenVDB grid.",
        {{"for Abaqus or CalculiX", "scantet convert brain.vtu brain.inp"},
         {"the surface alone, in RAS coordinates", "scantet convert brain.vtu brain.stl --space ras"},
         {"a scan as a sparse grid", "scantet convert head.nii.gz head.vdb"}},
        ""};
    return text;
  }
  std::vector<const OptionSet*> option_sets() const override {
    std::vector<const OptionSet*> sets = plugin_options_.sets();
    sets.push_back(&mesh_options_);
    sets.push_back(&options_);
    return sets;
  }
  int run(const CommandLine& line) override {
    const std::vector<std::string> files = take_arguments(line, {"INPUT", "FILE"});
    const auto plugin = plugins_.create_converter(files[0], files[1]);
    OptionSet of_plugin;
    if (plugin) plugin->declare_convert_options(of_plugin);
    OptionSet& of_kind = plugin ? of_plugin : mesh_options_;
    for (const OptionValue& value : line.values) {
      if (options_.find(value.name) != nullptr) {
        options_.set(value);
      } else {
        set_input_option(of_kind, value, files[0]);
      }
    }
    ProgressLine progress(error_is_terminal());
    std::optional<std::vector<std::string>> notes;
    if (!plugin) {
      notes = convert_mesh(files[0], files[1], space_, progress, plugins_.files());
    } else if (convert_checked(*plugin, files[0], files[1], progress, plugins_.files())) {
      notes.emplace();
    }
    progress.clear();
    if (!notes) return print_cancelled();
    for (const std::string& file : mesh_files(files[1])) print("wrote " + file + "\n");
    finish_printing();
    for (const std::string& note : *notes) print_error_line("note: " + note);
    return kExitDone;
  }

 private:
  const PluginRegistry& plugins_;
  PluginOptions plugin_options_;
  Space space_ = Space::lps;
  OptionSet mesh_options_;
  std::vector<std::string> plugin_files_;
  OptionSet options_;
};

}  // namespace

std::unique_ptr<Command> make_convert_command(const PluginRegistry& plugins) {
  return std::make_unique<ConvertCommand>(plugins);
}

}  // namespace scantet
