// One walk over the declared options, two renderings: columns for a terminal and tables for the documentation.
#include "scantet/cli/help.h"

#include <sstream>

namespace scantet {
namespace {

constexpr std::size_t kWidth = 100;
constexpr std::size_t kColumn = 28;  // where the description of an option starts

std::string default_text(const Option& option) {
  if (option.kind == OptionKind::flag) return "";
  if (!option.default_values.empty()) return option.default_values.front();
  if (!option.text.unset.empty()) return option.text.unset;
  return option.kind == OptionKind::number ? "none" : "";
}

// "greater than 0", "any finite number, repeatable"
std::string range_text(const Option& option) {
  if (!is_repeatable(option.kind)) return option.limits;
  return option.limits + (option.limits.empty() ? "" : ", ") + "repeatable";
}

// Breaks text into lines of at most kWidth, each indented.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t used) {
  std::istringstream words(text);
  std::string result;
  std::string word;
  while (words >> word) {
    if (used > indent && used + 1 + word.size() > kWidth) {
      result += '\n';
      result.append(indent, ' ');
      used = indent;
    } else if (used > indent) {
      result += ' ';
      ++used;
    }
    result += word;
    used += word.size();
  }
  return result + "\n";
}

std::string option_help(const Option& option) {
  std::string text = "  " + option_form(option);
  text += text.size() + 2 > kColumn ? "\n" + std::string(kColumn, ' ') : std::string(kColumn - text.size(), ' ');
  const std::string extra = option_facts(option);
  return text + wrapped(option.text.help + (extra.empty() ? "" : " [" + extra + "]"), kColumn, kColumn);
}

std::string examples_help(const CommandText& text) {
  std::string result;
  for (const Example& example : text.examples) {
    result += "  # " + example.what + "\n  " + example.command + "\n";
  }
  return result;
}

std::string exit_status_help() {
  std::string text = "Exit status:\n";
  for (const ExitStatus& exit : exit_statuses()) {
    const std::string number = std::to_string(exit.status);
    text += "  " + number + std::string(5 - number.size(), ' ') + wrapped(exit.meaning, 7, 7);
  }
  return text;
}

std::string markdown_row(const Option& option) {
  const std::string standard = default_text(option);
  const auto cell = [](const std::string& text) {
    std::string escaped;
    for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
    return escaped;
  };
  return "| `" + cell(option_form(option)) + "` | " + cell(standard) + " | " + cell(range_text(option)) + " | " +
         cell(option.text.help) + " |\n";
}

}  // namespace

const char* const kProgramPurpose =
    "scantet turns a medical scan into a tetrahedral mesh that a solver can use, and checks that it matches the scan.";

std::vector<OptionGroup> option_groups(const Command& command) {
  std::vector<OptionGroup> groups;
  for (const OptionSet* set : command.option_sets()) {
    for (const Option& option : set->options()) {
      auto group = groups.begin();
      while (group != groups.end() && group->title != option.text.group) ++group;
      if (group == groups.end()) group = groups.insert(groups.end(), OptionGroup{option.text.group, {}});
      group->options.push_back(&option);
    }
  }
  return groups;
}

std::string option_facts(const Option& option) {
  std::string text = range_text(option);
  const std::string standard = default_text(option);
  if (!standard.empty()) text += (text.empty() ? "default " : "; default ") + standard;
  return text;
}

std::vector<std::string> choice_words(const Option& option) {
  const std::string& limits = option.limits;
  std::vector<std::string> words(1);
  for (std::size_t i = 0; i < limits.size(); ++i) {
    if (limits.compare(i, 2, ", ") == 0) {
      words.emplace_back();
      ++i;
    } else if (limits.compare(i, 4, " or ") == 0) {
      words.emplace_back();
      i += 3;
    } else {
      words.back() += limits[i];
    }
  }
  return words;
}

const std::vector<ExitStatus>& exit_statuses() {
  static const std::vector<ExitStatus> statuses{
      {0, "done, and every requested bound is met"},
      {1, "internal error"},
      {2, "wrong use: an option or argument"},
      {3, "the input cannot be read or makes no sense"},
      {4,
       "written, but a requested bound is unmet or the audit found a fault: the report says which; or --max-time or "
       "--max-memory ended it, perhaps with nothing written; of verify: another grade than asked for; of diff: the "
       "meshes "
       "differ"},
      {5, "the output cannot be written"},
      {6, "out of memory"},
      {130, "cancelled (Ctrl-C): no file was written"}};
  return statuses;
}

std::string option_form(const Option& option) {
  std::string text = option.text.letter ? std::string("-") + option.text.letter + ", " : "";
  text += "--" + option.name;
  return option.text.metavar.empty() ? text : text + " " + option.text.metavar;
}

std::string program_help(const std::vector<std::unique_ptr<Command>>& commands) {
  std::string text = std::string(kProgramPurpose) + "\n\nUsage: scantet COMMAND [arguments] [options]\n\nCommands:\n";
  for (const auto& command : commands) {
    const std::string& name = command->text().name;
    text += "  " + name + std::string(12 - name.size(), ' ') + command->text().brief + "\n";
  }
  text += "\nStart with:\n";
  for (const auto& command : commands) {
    if (!command->text().examples.empty()) text += "  " + command->text().examples.front().command + "\n";
  }
  return text +
         "\nscantet COMMAND --help explains a command, scantet --version prints the version; scantet man [COMMAND] "
         "prints a\nmanual page, scantet completion bash (or zsh, fish) what completes commands and options in a "
         "shell.\n\n" +
         exit_status_help();
}

std::string command_help(const Command& command) {
  const CommandText& about = command.text();
  std::string text = "Usage: scantet " + about.usage + "\n\n" + wrapped(about.about, 0, 0);
  if (!about.examples.empty()) text += "\nExamples:\n" + examples_help(about);
  for (const OptionGroup& group : option_groups(command)) {
    text += "\n" + group.title + ":\n";
    for (const Option* option : group.options) text += option_help(*option);
  }
  if (!about.notes.empty()) text += "\n" + about.notes;
  return text + "\n" + exit_status_help();
}

std::string options_markdown(const std::vector<std::unique_ptr<Command>>& commands) {
  std::string text =
      "# Options\n\nMade by `scantet options` from the declarations in the source; do not edit.\n\n"
      "Every option of `scantet mesh` but `--plugin` can also stand in a JSON file given to `--config`: the same name "
      "without the two leading dashes,\n"
      "a list for a repeatable option, `null` for none. The command line wins over the file.\n";
  for (const auto& command : commands) {
    text += "\n## scantet " + command->text().usage + "\n\n" + command->text().about + "\n";
    for (const OptionGroup& group : option_groups(*command)) {
      text += "\n### " + group.title + "\n\n| option | default | range | meaning |\n| --- | --- | --- | --- |\n";
      for (const Option* option : group.options) text += markdown_row(*option);
    }
  }
  return text;
}

}  // namespace scantet
