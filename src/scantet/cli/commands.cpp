// The list of commands, and what they share.
#include <algorithm>

#include "scantet/base/error.h"
#include "scantet/cli/command.h"

namespace scantet {

std::vector<std::unique_ptr<Command>> make_commands(const PluginRegistry& plugins) {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(make_mesh_command(plugins));
  commands.push_back(make_info_command(plugins));
  commands.push_back(make_report_command());
  commands.push_back(make_verify_command());
  commands.push_back(make_diff_command());
  commands.push_back(make_convert_command(plugins));
  commands.push_back(make_cohort_command());
  commands.push_back(make_plugins_command(plugins));
  return commands;
}

void set_all(OptionSet& options, const std::vector<OptionValue>& values) {
  for (const OptionValue& value : values) options.set(value);
}

std::vector<std::string> take_arguments(const CommandLine& line, const std::vector<std::string>& names) {
  std::string wanted;
  for (const std::string& name : names) wanted += (wanted.empty() ? "" : " ") + name;
  if (line.arguments.size() < names.size()) {
    throw Error(Fault::usage, "usage.arguments", names[line.arguments.size()] + " is missing",
                "give " + wanted + "; --help shows examples");
  }
  if (line.arguments.size() > names.size()) {
    for (const auto& [word, takes] : line.no_values) {
      if (std::find(line.arguments.begin(), line.arguments.end(), word) == line.arguments.end()) continue;
      throw Error(Fault::usage, "usage.arguments", "unexpected argument \"" + word + "\": " + takes,
                  "give " + wanted + " alone, or one of these values");
    }
    throw Error(Fault::usage, "usage.arguments", "unexpected argument \"" + line.arguments[names.size()] + "\"",
                "give " + wanted + ", and quote names with spaces");
  }
  return line.arguments;
}

}  // namespace scantet
