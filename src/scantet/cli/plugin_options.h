// The options of all plugins, for parsing and help before it is known which plugin opens the input.
#pragma once

#include <memory>
#include <vector>

#include "scantet/app/plugin_registry.h"

namespace scantet {

class PluginOptions {
 public:
  explicit PluginOptions(const PluginRegistry& registry) : plugins_(registry.create_all()), sets_(plugins_.size()) {
    for (std::size_t i = 0; i < plugins_.size(); ++i) plugins_[i]->declare_options(sets_[i]);
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
