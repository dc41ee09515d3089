// The scan is an input of the image plugin, by a name that no file has.
#include "scantet/app/named_options.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>

#include "scantet/app/built_in_plugins.h"
#include "scantet/app/job.h"
#include "scantet/app/mesh_command_options.h"
#include "scantet/base/error.h"

namespace scantet {
namespace {

constexpr std::array kOfTheCommand{"config", "plugin", "plan", "quiet"};

bool is_of_the_command(const std::string& name) {
  return std::find(kOfTheCommand.begin(), kOfTheCommand.end(), name) != kOfTheCommand.end();
}

}  // namespace

std::vector<Option> named_mesh_options() {
  const MeshCommandOptions all(built_in_plugins());
  std::vector<Option> options;
  for (const OptionSet* set : all.sets()) {
    for (const Option& option : set->options()) {
      if (is_of_the_command(option.name)) continue;
      options.push_back(option);
      options.back().assign = nullptr;
      options.back().read = nullptr;
    }
  }
  return options;
}

MeshOutcome mesh_scan_named(const Scan& scan, const std::vector<OptionValue>& values, Progress& progress) {
  for (const OptionValue& value : values) {
    if (!is_of_the_command(value.name)) continue;
    throw Error(Fault::usage, "usage.unknown_option", value.place + ": only the command scantet mesh has this option",
                "leave it out");
  }
  const std::string name = "the scan (" + scan.format + ")";
  const auto in_memory = std::make_shared<const ScansInMemory>(ScansInMemory{{name, scan}});
  const PluginRegistry plugins = built_in_plugins(in_memory);
  MeshCommandOptions options(plugins);
  options.take(values);
  options.job().input = name;
  options.job().is_kept = true;
  JobResult result = run_mesh_job(options.job(), plugins, progress);
  return {result.cancelled, std::move(result.mesh), std::move(result.report), std::move(result.notes),
          std::move(result.findings)};
}

}  // namespace scantet
