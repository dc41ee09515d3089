// A command of the program: `scantet mesh`, `scantet info` ...
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scantet/cli/command_line.h"
#include "scantet/plugin/plugin_registry.h"

namespace scantet {

/// Exit statuses beyond those of Fault.
inline constexpr int kExitDone = 0;
inline constexpr int kExitUnmet = 4;
inline constexpr int kExitNoMemory = 6;
inline constexpr int kExitCancelled = 130;

struct Example {
  std::string what;     ///< one line, "mesh the tissue above 60 ..."
  std::string command;  ///< as typed
};

/// What help says of a command beside its options.
struct CommandText {
  std::string name;
  std::string usage;  ///< after "scantet "
  std::string brief;  ///< one line, for the list of commands
  std::string about;  ///< a paragraph
  std::vector<Example> examples;
  std::string notes;  ///< after the options; may be empty
};

class Command {
 public:
  virtual ~Command() = default;
  virtual const CommandText& text() const = 0;
  /// The options it knows, those of plugins included.
  virtual std::vector<const OptionSet*> option_sets() const { return {}; }
  /// Does the work and prints results; returns the exit status. Throws Error.
  virtual int run(const CommandLine& line) = 0;
  /// Whether the words after its name are for another program, and given to run_words as they are.
  virtual bool takes_words() const { return false; }
  /// Does the work of such a command.
  virtual int run_words(const std::vector<std::string>&) { return kExitDone; }
};

std::unique_ptr<Command> make_mesh_command(const PluginRegistry& plugins);
std::unique_ptr<Command> make_info_command(const PluginRegistry& plugins);
std::unique_ptr<Command> make_report_command();
std::unique_ptr<Command> make_verify_command();
std::unique_ptr<Command> make_diff_command();
std::unique_ptr<Command> make_convert_command(const PluginRegistry& plugins);
std::unique_ptr<Command> make_plugins_command(const PluginRegistry& plugins);
std::unique_ptr<Command> make_cohort_command();

/// The commands in the order in which help lists them. `plugins` must outlive them.
std::vector<std::unique_ptr<Command>> make_commands(const PluginRegistry& plugins);

/// Sets the options of a command that has no plugin options.
void set_all(OptionSet& options, const std::vector<OptionValue>& values);

/// The command's arguments, which must be as many as `names` ("INPUT"). Throws Error: usage.arguments.
std::vector<std::string> take_arguments(const CommandLine& line, const std::vector<std::string>& names);

}  // namespace scantet
