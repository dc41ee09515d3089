// All that `scantet mesh` can be given, on a command line or from a program that calls it so: the options of the job,
// of the plugins, and of the call itself.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scantet/app/mesh_job.h"
#include "scantet/base/api.h"
#include "scantet/base/options.h"
#include "scantet/plugin/plugin_registry.h"

namespace SCANTET_PROGRAM_API scantet {

/// Declares --plugin, for whoever opens inputs. Who calls has loaded them: `files` is only written to.
void declare_plugin_files(OptionSet& options, std::vector<std::string>& files);

/// The options of all plugins, before it is known which of them opens the input.
class PluginOptions {
 public:
  /// declare: &InputPlugin::declare_options or &InputPlugin::declare_convert_options.
  PluginOptions(const PluginRegistry& registry, void (InputPlugin::*declare)(OptionSet&));
  /// One a plugin; valid as long as this object.
  std::vector<const OptionSet*> sets() const;

 private:
  std::vector<std::unique_ptr<InputPlugin>> plugins_;  // hold the values
  std::vector<OptionSet> sets_;
};

/// The options of `scantet mesh`, and the job that they make. Stays where it is: the options point into it.
class MeshCommandOptions {
 public:
  explicit MeshCommandOptions(const PluginRegistry& plugins);
  MeshCommandOptions(const MeshCommandOptions&) = delete;
  MeshCommandOptions& operator=(const MeshCommandOptions&) = delete;

  /// Of the plugins, the job and the call; valid as long as this object.
  std::vector<const OptionSet*> sets() const;
  /// Sets job() by the values, and by those of the configuration that they name: they win over it, option by option.
  /// Throws Error: usage.config, and as read_config() and distribute_options() do.
  void take(const std::vector<OptionValue>& given);
  /// Without its input, which is the caller's to set.
  MeshJob& job() { return job_; }
  /// --quiet.
  bool is_quiet() const { return quiet_; }

 private:
  PluginOptions plugin_options_;  // to be told apart by; the job makes its own plugin
  MeshJob job_;
  OptionSet job_options_;
  std::vector<std::string> plugin_files_;
  std::string config_;
  bool quiet_ = false;
  OptionSet options_;  // of the call itself
};

}  // namespace scantet
