// Images are opened through the interface that every plugin has.
#include "scantet/app/built_in_plugins.h"

#include "scantet/app/mesh_job.h"
#include "scantet/scan_input/image_plugin.h"

namespace scantet {

PluginRegistry built_in_plugins(const std::shared_ptr<const ScansInMemory>& in_memory) {
  MeshJob job;
  OptionSet of_job;
  job.declare_options(of_job);
  std::vector<std::string> taken;
  taken.reserve(of_job.options().size());
  for (const Option& option : of_job.options()) taken.push_back(option.name);
  PluginRegistry registry(std::move(taken));
  registry.add([in_memory] { return make_image_plugin(in_memory); });
  return registry;
}

}  // namespace scantet
