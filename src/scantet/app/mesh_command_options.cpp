// A configuration is read after what is given, which names it, and is set before it.
#include "scantet/app/mesh_command_options.h"

#include <algorithm>

#include "scantet/app/config.h"
#include "scantet/base/error.h"
#include "scantet/base/regular_file.h"

namespace scantet {

void declare_plugin_files(OptionSet& options, std::vector<std::string>& files) {
  options.add("plugin", files,
              {"Input", "FILE", "a file name",
               "Shared library with a plugin that opens further inputs; scantet plugins lists those that are there."});
}

PluginOptions::PluginOptions(const PluginRegistry& registry, void (InputPlugin::*declare)(OptionSet&))
    : plugins_(registry.create_all()), sets_(plugins_.size()) {
  for (std::size_t i = 0; i < plugins_.size(); ++i) (plugins_[i].get()->*declare)(sets_[i]);
}

std::vector<const OptionSet*> PluginOptions::sets() const {
  std::vector<const OptionSet*> pointers;
  for (const OptionSet& set : sets_) pointers.push_back(&set);
  return pointers;
}

MeshCommandOptions::MeshCommandOptions(const PluginRegistry& plugins)
    : plugin_options_(plugins, &InputPlugin::declare_options) {
  job_.declare_options(job_options_);
  declare_plugin_files(options_, plugin_files_);
  options_.add("config", config_,
               {"Run", "FILE", "a file name",
                "JSON file with options, e.g. {\"level\": 60, \"size\": 3}; those on the command line win."});
  options_.add("quiet", quiet_,
               {"Run", "", "a flag", "Print no table and no progress; errors and unmet bounds still are."});
}

std::vector<const OptionSet*> MeshCommandOptions::sets() const {
  std::vector<const OptionSet*> sets = plugin_options_.sets();
  sets.push_back(&job_options_);
  sets.push_back(&options_);
  return sets;
}

void MeshCommandOptions::take(const std::vector<OptionValue>& given) {
  std::vector<OptionValue> for_job;
  const auto take_one = [&](const OptionValue& value) {
    if (options_.find(value.name) != nullptr) {
      options_.set(value);
    } else {
      for_job.push_back(value);
    }
  };
  for (const OptionValue& value : given) take_one(value);
  if (!config_.empty()) {
    check_regular_file(config_);
    for (const OptionValue& value : read_config(config_)) {
      if (value.name == "config") {
        throw Error(Fault::usage, "usage.config", value.place + ": a configuration cannot name another", "remove it");
      }
      if (value.name == "plugin") {
        throw Error(Fault::usage, "usage.config", value.place + ": a configuration cannot load plugins",
                    "name it on the command line");
      }
      const bool overridden =
          std::any_of(given.begin(), given.end(), [&](const OptionValue& other) { return other.name == value.name; });
      if (!overridden) take_one(value);
    }
  }
  distribute_options(for_job, job_options_, plugin_options_.sets(), job_);
  job_.read = plugin_files_;
  if (!config_.empty()) job_.read.push_back(config_);
}

}  // namespace scantet
