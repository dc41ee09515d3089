// `scantet plugins`: what can be opened, and what can be written.
#include <algorithm>

#include "scantet/cli/command.h"
#include "scantet/cli/help.h"
#include "scantet/cli/plugin_options.h"
#include "scantet/cli/print.h"
#include "scantet/io/mesh_io.h"
#include "scantet/plugin/plugin_loader.h"

namespace scantet {
namespace {

std::string describe(const PluginEntry& entry) {
  const std::unique_ptr<InputPlugin> plugin = entry.create();
  OptionSet options;
  plugin->declare_options(options);
  std::string forms;
  for (const Option& option : options.options()) forms += (forms.empty() ? "" : ", ") + option_form(option);
  return "  " + plugin->name() + ": " + plugin->description() + "\n    from     " +
         (entry.file.empty() ? "built in" : entry.file) + "\n    options  " + (forms.empty() ? "none" : forms) + "\n";
}

class PluginsCommand final : public Command {
 public:
  explicit PluginsCommand(const PluginRegistry& plugins) : plugins_(plugins) {
    declare_plugin_files(options_, plugin_files_);
  }
  const CommandText& text() const override {
    static const CommandText text{"plugins",
                                  "plugins [--plugin FILE]...",
                                  "what can be opened and written",
                                  "Lists the plugins that open inputs, each with what it opens, where it is from and "
                                  "its options, and the mesh formats by extension.",
                                  {{"list them", "scantet plugins"}},
                                  ""};
    return text;
  }
  std::vector<const OptionSet*> option_sets() const override { return {&options_}; }
  int run(const CommandLine& line) override {
    take_arguments(line, {});
    print("Inputs (plugin: what it opens)\n");
    for (const PluginEntry& entry : plugins_.entries()) print(describe(entry));
    print("  Plugins are looked for in " + plugin_folder() + "\n");
    print("\nMesh files\n");
    for (const MeshFormat& format : mesh_formats()) {
      const std::string use = format.can_read && format.can_write ? "read, write" : format.can_read ? "read" : "write";
      print("  " + format.extension + std::string(8 - std::min<std::size_t>(7, format.extension.size()), ' ') +
            format.description + " (" + use + ")\n");
    }
    return kExitDone;
  }

 private:
  const PluginRegistry& plugins_;
  std::vector<std::string> plugin_files_;
  OptionSet options_;
};

}  // namespace

std::unique_ptr<Command> make_plugins_command(const PluginRegistry& plugins) {
  return std::make_unique<PluginsCommand>(plugins);
}

}  // namespace scantet
