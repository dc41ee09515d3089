// A domain that a plugin opens, as a case of the contract suite: loaded and opened as the program does it.
#pragma once

#include <string>
#include <vector>

#include "contract/domain_contract.h"
#include "scantet/plugin/plugin_check.h"
#include "scantet/plugin/plugin_loader.h"

namespace scantet {

/// Opens the input with the plugin in the shared library `file` and the options given ({"bounds", "-1,-1,-1,1,1,1"}).
/// Throws Error as load_plugin, OptionSet::set and open_checked do.
inline std::unique_ptr<Domain> open_with_plugin(const std::string& file, const std::string& input,
                                                const std::vector<std::pair<std::string, std::string>>& options = {}) {
  PluginRegistry registry;
  load_plugin(file, registry);
  const std::unique_ptr<InputPlugin> plugin = registry.create_for(input);
  OptionSet set;
  plugin->declare_options(set);
  for (const auto& [name, text] : options) set.set({name, text, "--" + name});
  Progress progress;
  return open_checked(*plugin, input, progress).domain;
}

inline DomainCase plugin_case(const std::string& name, const std::string& file, const std::string& input,
                              const std::vector<std::pair<std::string, std::string>>& options = {}) {
  return {name, [=] { return open_with_plugin(file, input, options); }};
}

}  // namespace scantet
