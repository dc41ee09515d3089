#include "scantet/app/plugin_object.h"

#include <utility>

#include "scantet/base/error.h"

namespace scantet {

VerifiedObject plugin_object(const PluginRegistry& plugins, const VerifyJob& job, Progress& progress) {
  const std::string& input = job.against;
  const std::unique_ptr<InputPlugin> plugin = plugins.create_for(input);
  OptionSet options;
  plugin->declare_options(options);
  if (!job.grid.empty()) {
    if (options.find("grid") == nullptr) {
      throw Error(Fault::usage, "usage.grid", "--grid: " + input + " has no grids to choose from", "leave it out");
    }
    options.set({"grid", job.grid, "--grid"});
  }
  if (job.repairs) {
    if (options.find("repair") == nullptr) {
      throw Error(Fault::usage, "usage.repair", "--repair: " + input + " is no surface", "leave it out");
    }
    options.set({"repair", "true", "--repair"});
  }
  VerifiedObject object;
  object.surface = plugin->surface(input, progress);
  if (object.surface || progress.cancelled()) return object;
  std::optional<GridField> field = plugin->field(input, progress);
  if (field || progress.cancelled()) {
    object.field = std::move(field).value_or(GridField());
    return object;
  }
  throw Error(Fault::input, "input.no_field",
              input +
                  " is neither a field between voxels nor a surface of triangles, so that no mesh can be verified "
                  "against it",
              "give an image, an OpenVDB grid or a surface");
}

}  // namespace scantet
