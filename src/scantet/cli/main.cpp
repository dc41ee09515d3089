// The program: finds the command, runs it, and turns errors into one line and an exit status.
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "scantet/app/built_in_plugins.h"
#include "scantet/base/error.h"
#include "scantet/base/version.h"
#include "scantet/cli/command.h"
#include "scantet/cli/completion.h"
#include "scantet/cli/crash.h"
#include "scantet/cli/help.h"
#include "scantet/cli/interrupt.h"
#include "scantet/cli/manual.h"
#include "scantet/cli/plugin_options.h"
#include "scantet/cli/print.h"
#include "scantet/cli/slicer_module.h"

namespace scantet {
namespace {

using Commands = std::vector<std::unique_ptr<Command>>;

Command& find_command(const Commands& commands, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& command : commands) {
    if (command->text().name == name) return *command;
    names.push_back(command->text().name);
  }
  const auto meant = closest_name(name, names);
  throw Error(Fault::usage, "usage.unknown_command",
              "unknown command " + name + (meant ? "; did you mean " + *meant + "?" : ""),
              "scantet --help lists the commands");
}

int run_command(Command& command, const std::vector<std::string>& words) {
  if (command.takes_words()) return command.run_words(words);
  const CommandLine line = parse_command_line(words, command.option_sets());
  if (line.help) {
    print(command_help(command));
    return kExitDone;
  }
  return command.run(line);
}

// Whether the command opens inputs, or explains commands that do. The others are spared the plugins.
bool needs_plugins(const std::string& command) {
  constexpr std::array kCommands{"mesh", "info", "convert", "plugins", "help", "options", "man", "completion"};
  return std::find(kCommands.begin(), kCommands.end(), command) != kCommands.end();
}

int run_program(const std::vector<std::string>& words) {
  if (words.empty()) {
    throw Error(Fault::usage, "usage.no_command", "no command given", "scantet --help shows how to start");
  }
  const std::string& first = words.front();
  const std::vector<std::string> rest(words.begin() + 1, words.end());
  const PluginRegistry plugins = needs_plugins(first) ? load_plugins(rest) : built_in_plugins();
  const Commands commands = make_commands(plugins);
  if (first == "--version") {
    print(std::string("scantet ") + kVersion + "\n");
  } else if (first == "--help" || first == "-h" || (first == "help" && rest.empty())) {
    print(program_help(commands));
  } else if (first == "help") {
    print(command_help(find_command(commands, rest.front())));
  } else if (first == "options") {
    print(options_markdown(commands));
  } else if (first == "--xml") {
    print(slicer_description(plugins));
  } else if (first == "slicer") {
    return run_slicer_module(rest, plugins);
  } else if (first == "man") {
    print(rest.empty() ? program_manual(commands) : command_manual(find_command(commands, rest.front())));
  } else if (first == "completion") {
    print(completion_script(rest.empty() ? "" : rest.front(), commands));
  } else {
    return run_command(find_command(commands, first), rest);
  }
  return kExitDone;
}

// The remedy goes on a line of its own.
int print_error(const Error& error) {
  std::string text = error.what();
  const std::string tail = "; " + error.remedy();
  if (!error.remedy().empty() && text.size() > tail.size() &&
      text.compare(text.size() - tail.size(), tail.size(), tail) == 0) {
    text.resize(text.size() - tail.size());
  }
  print_error_line("error: " + text);
  if (!error.remedy().empty()) print_error_line("hint: " + error.remedy());
  return static_cast<int>(error.fault());
}

int guarded_main(const std::vector<std::string>& words) {
  try {
    const int status = run_program(words);
    finish_printing();
    return status;
  } catch (const Error& error) {
    return interrupted() ? print_cancelled() : print_error(error);
  } catch (const std::bad_alloc&) {
    print_error_line("error: out of memory");
    print_error_line("hint: choose a larger --size, or a machine with more memory");
    return kExitNoMemory;
  } catch (const std::exception& error) {
    print_error_line(std::string("error: internal error: ") + error.what());
    print_error_line("hint: please report this, with the command and the version");
  } catch (...) {
    print_error_line("error: internal error of an unknown kind");
    print_error_line("hint: please report this, with the command and the version");
  }
  return static_cast<int>(Fault::internal);
}

}  // namespace
}  // namespace scantet

int main(int count, char** words) {
  scantet::install_signal_handlers();
  scantet::install_crash_handlers();
  return scantet::guarded_main(std::vector<std::string>(words + std::min(1, count), words + count));
}
