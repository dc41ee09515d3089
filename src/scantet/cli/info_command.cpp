// `scantet info`: what there is to know about an input before meshing it.
#include "scantet/app/idle_options.h"
#include "scantet/app/info.h"
#include "scantet/cli/command.h"
#include "scantet/cli/plugin_options.h"
#include "scantet/cli/print.h"
#include "scantet/cli/progress_line.h"

namespace scantet {
namespace {

class InfoCommand final : public Command {
 public:
  explicit InfoCommand(const PluginRegistry& plugins)
      : plugins_(plugins), plugin_options_(plugins, &InputPlugin::declare_options) {
    declare_plugin_files(options_, plugin_files_);
    options_.add("json", json_, {"Output", "", "a flag", "Print JSON instead of text."});
  }
  const CommandText& text() const override {
    static const CommandText text{"info",
                                  "info INPUT [--level V]... [options]",
                                  "what is in a scan: size, orientation, values, a level to start from",
                                  "Prints size, spacing, orientation, pixel type, values, a suggested level (Otsu's "
                                  "threshold), and what there is "
                                  "at the level given with --level, or at the suggested one: which faces of the image "
                                  "the object touches, and how "
                                  "many components and cavities it has. Of a label map it lists the labels.",
                                  {{"look at a scan", "scantet info head.nii.gz"},
                                   {"how many pieces are there above 60?", "scantet info head.nii.gz --level 60"},
                                   {"for a script", "scantet info head.nii.gz --json"}},
                                  ""};
    return text;
  }
  std::vector<const OptionSet*> option_sets() const override {
    std::vector<const OptionSet*> sets = plugin_options_.sets();
    sets.push_back(&options_);
    return sets;
  }
  int run(const CommandLine& line) override {
    const std::string input = take_arguments(line, {"INPUT"}).front();
    const auto plugin = plugins_.create_for(input);
    OptionSet plugin_set;
    plugin->declare_options(plugin_set);
    for (const OptionValue& value : line.values) {
      if (options_.find(value.name) != nullptr) {
        options_.set(value);
      } else {
        set_input_option(plugin_set, value, input);
      }
    }
    ProgressLine progress(error_is_terminal());
    const std::vector<InfoSection> sections = plugin->info(input, progress);
    progress.clear();
    if (progress.cancelled()) return print_cancelled();
    print(json_ ? info_json(sections) : info_text(sections));
    return kExitDone;
  }

 private:
  const PluginRegistry& plugins_;
  PluginOptions plugin_options_;
  OptionSet options_;
  std::vector<std::string> plugin_files_;
  bool json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_info_command(const PluginRegistry& plugins) {
  return std::make_unique<InfoCommand>(plugins);
}

}  // namespace scantet
