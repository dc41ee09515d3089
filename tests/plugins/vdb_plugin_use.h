// The plugin of OpenVDB on a grid of a test's.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "contract/plugin_case.h"
#include "vdb_files.h"

namespace scantet::test {

/// What use(plugin, path) makes of a file that holds the grid, with these options set.
template <class Use>
auto use_vdb_plugin(const openvdb::GridBase::Ptr& grid, const std::vector<std::pair<std::string, std::string>>& options,
                    const Use& use) {
  const TemporaryFile file("grid.vdb");
  write_grids(file.path(), {grid});
  PluginRegistry registry;
  load_plugin(SCANTET_VDB_PLUGIN, registry);
  const std::unique_ptr<InputPlugin> plugin = registry.create_for(file.path());
  OptionSet set;
  plugin->declare_options(set);
  for (const auto& [name, text] : options) set.set({name, text, "--" + name});
  return use(*plugin, file.path());
}

}  // namespace scantet::test
