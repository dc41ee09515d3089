// `scantet plugins`: what can be opened, and what can be written.
#include <algorithm>

#include "scantet/cli/command.h"
#include "scantet/cli/print.h"
#include "scantet/io/mesh_io.h"

namespace scantet {
namespace {

class PluginsCommand final : public Command {
 public:
  explicit PluginsCommand(const PluginRegistry& plugins) : plugins_(plugins) {}
  const CommandText& text() const override {
    static const CommandText text{"plugins",
                                  "plugins",
                                  "what can be opened and written",
                                  "Lists the plugins that open inputs, and the mesh formats by extension.",
                                  {{"list them", "scantet plugins"}},
                                  ""};
    return text;
  }
  int run(const CommandLine& line) override {
    take_arguments(line, {});
    print("Inputs (plugin: what it opens)\n");
    for (const auto& plugin : plugins_.create_all()) print("  " + plugin->name() + ": " + plugin->description() + "\n");
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
};

}  // namespace

std::unique_ptr<Command> make_plugins_command(const PluginRegistry& plugins) {
  return std::make_unique<PluginsCommand>(plugins);
}

}  // namespace scantet
