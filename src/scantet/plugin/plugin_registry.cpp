// Plugins of shared libraries are added like the built-in ones (plugin_loader.cpp); only messages tell where one is
// from.
#include "scantet/plugin/plugin_registry.h"

#include <filesystem>
#include <utility>

#include "scantet/base/error.h"
#include "scantet/base/file_extension.h"
#include "scantet/base/regular_file.h"

namespace scantet {
namespace {

[[noreturn]] void refuse(const std::string& input, const std::vector<std::unique_ptr<InputPlugin>>& plugins) {
  std::error_code code;
  const auto status = std::filesystem::status(input, code);
  if (!std::filesystem::exists(status)) {
    throw Error(Fault::input, "input.not_found", input + ": no such file or folder", "check the path");
  }
  if (std::filesystem::is_regular_file(status) && std::filesystem::file_size(input, code) == 0 && !code) {
    throw Error(Fault::input, "input.empty", input + ": the file is empty", "get the file anew from its source");
  }
  if (const std::string extension = file_extension(input); extension == ".mgz" || extension == ".mgh") {
    throw Error(Fault::input, "input.format", input + ": FreeSurfer's " + extension + " is not read",
                "convert it with FreeSurfer's 'mri_convert " + input + " " +
                    std::filesystem::path(input).replace_extension(".nii.gz").string() + "'");
  }
  std::string known;
  for (const auto& plugin : plugins) known += (known.empty() ? "" : "; ") + plugin->description();
  throw Error(Fault::input, "input.format", input + ": not a format that can be opened",
              "supported: " + (known.empty() ? "nothing, no plugin is registered" : known));
}

/// The plugin with the highest score, the first on a tie; null if all are 0.
template <class Score>
std::unique_ptr<InputPlugin> take_best(std::vector<std::unique_ptr<InputPlugin>>& plugins, const Score& score_of) {
  std::unique_ptr<InputPlugin>* best = nullptr;
  int best_score = 0;
  for (auto& plugin : plugins) {
    const int score = score_of(*plugin);
    if (score > best_score) {
      best_score = score;
      best = &plugin;
    }
  }
  return best == nullptr ? nullptr : std::move(*best);
}

}  // namespace

void PluginRegistry::add(InputPluginFactory create, std::string file) {
  const std::string name = create()->name();
  for (const PluginEntry& other : entries_) {
    if (other.create()->name() != name) continue;
    throw Error(Fault::usage, "usage.plugin",
                (file.empty() ? "" : file + ": ") + "a plugin named " + name + " is there already, " +
                    (other.file.empty() ? "built in" : "from " + other.file),
                "load one of the two, or rename one");
  }
  entries_.push_back({std::move(create), std::move(file)});
}

std::vector<std::unique_ptr<InputPlugin>> PluginRegistry::create_all() const {
  std::vector<std::unique_ptr<InputPlugin>> plugins;
  for (const PluginEntry& entry : entries_) plugins.push_back(entry.create());
  return plugins;
}

std::vector<std::string> PluginRegistry::files() const {
  std::vector<std::string> files;
  for (const PluginEntry& entry : entries_) {
    if (!entry.file.empty()) files.push_back(entry.file);
  }
  return files;
}

std::unique_ptr<InputPlugin> PluginRegistry::create_for(const std::string& input) const {
  check_regular_file(input);
  auto plugins = create_all();
  auto best = take_best(plugins, [&](const InputPlugin& plugin) { return plugin.can_open(input); });
  if (best == nullptr) refuse(input, plugins);
  return best;
}

std::unique_ptr<InputPlugin> PluginRegistry::create_converter(const std::string& input,
                                                              const std::string& output) const {
  check_regular_file(input);
  auto plugins = create_all();
  return take_best(plugins, [&](const InputPlugin& plugin) { return plugin.can_convert(input, output); });
}

}  // namespace scantet
