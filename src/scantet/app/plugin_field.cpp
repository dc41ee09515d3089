#include "scantet/app/plugin_field.h"

#include "scantet/base/error.h"

namespace scantet {

GridField plugin_field(const PluginRegistry& plugins, const std::string& input, const std::string& grid,
                       Progress& progress) {
  const std::unique_ptr<InputPlugin> plugin = plugins.create_for(input);
  OptionSet options;
  plugin->declare_options(options);
  if (!grid.empty()) {
    if (options.find("grid") == nullptr) {
      throw Error(Fault::usage, "usage.grid", "--grid: " + input + " has no grids to choose from", "leave it out");
    }
    options.set({"grid", grid, "--grid"});
  }
  std::optional<GridField> field = plugin->field(input, progress);
  if (field || progress.cancelled()) return std::move(field).value_or(GridField());
  throw Error(Fault::input, "input.no_field",
              input + " is no field between voxels, so that no mesh can be verified against it",
              "give an image or an OpenVDB grid");
}

}  // namespace scantet
