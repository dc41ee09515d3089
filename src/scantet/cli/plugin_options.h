// The plugins of a run, and their options for parsing and help before it is known which plugin opens the input.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scantet/plugin/plugin_registry.h"

namespace scantet {

/// What is built in, the files given to --plugin among the words of the command line, and the plugin folder, in this
/// order. Prints a warning for each plugin of the folder that cannot be loaded.
/// Throws Error: usage.plugin (one named with --plugin cannot be loaded).
PluginRegistry load_plugins(const std::vector<std::string>& words);

/// Declares --plugin, for whoever opens inputs. The values are load_plugins' business: `files` is only written to.
void declare_plugin_files(OptionSet& options, std::vector<std::string>& files);

class PluginOptions {
 public:
  /// declare: &InputPlugin::declare_options or &InputPlugin::declare_convert_options.
  PluginOptions(const PluginRegistry& registry, void (InputPlugin::*declare)(OptionSet&))
      : plugins_(registry.create_all()), sets_(plugins_.size()) {
    for (std::size_t i = 0; i < plugins_.size(); ++i) (plugins_[i].get()->*declare)(sets_[i]);
  }
  std::vector<const OptionSet*> sets() const {
    std::vector<const OptionSet*> pointers;
    for (const OptionSet& set : sets_) pointers.push_back(&set);
    return pointers;
  }

 private:
  std::vector<std::unique_ptr<InputPlugin>> plugins_;  // hold the values
  std::vector<OptionSet> sets_;
};

}  // namespace scantet
