// --plugin is looked for before the command line is parsed, because the plugins say what options there are.
#include "scantet/cli/plugin_options.h"

#include "scantet/app/built_in_plugins.h"
#include "scantet/base/error.h"
#include "scantet/cli/crash.h"
#include "scantet/cli/print.h"
#include "scantet/plugin/plugin_loader.h"

namespace scantet {
namespace {

const std::string kOption = "--plugin";

std::vector<std::string> plugin_files(const std::vector<std::string>& words) {
  std::vector<std::string> files;
  for (std::size_t i = 0; i < words.size() && words[i] != "--"; ++i) {
    if (words[i].starts_with(kOption + "=")) files.push_back(words[i].substr(kOption.size() + 1));
    if (words[i] == kOption && i + 1 < words.size()) files.push_back(words[++i]);
  }
  return files;
}

}  // namespace

PluginRegistry load_plugins(const std::vector<std::string>& words) {
  PluginRegistry plugins = built_in_plugins();
  for (const std::string& file : plugin_files(words)) {
    load_plugin(file, plugins);
    suspect_plugin(file);
  }
  for (const std::string& warning : load_plugin_folder(plugin_folder(), plugins)) {
    print_error_line("warning: passed over " + warning);
  }
  return plugins;
}

}  // namespace scantet
