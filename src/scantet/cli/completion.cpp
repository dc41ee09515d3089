// Each shell's script is data for functions that stand in it as they are: which options a command has, what a value can
// be. Commands that are no Command (help, man ...) are listed in one place, below.
#include "scantet/cli/completion.h"

#include <algorithm>

#include "scantet/base/error.h"
#include "scantet/cli/help.h"

namespace scantet {
namespace {

// An option of a command, as all plugins together have it.
struct Known {
  std::string name;
  char letter = 0;
  bool takes_value = false;
  bool takes_file = false;
  bool is_repeatable = false;
  std::vector<std::string> words;  // that it takes; empty: any
  std::string help;                // its first sentence
};

struct KnownCommand {
  std::string name;
  std::string brief;
  std::vector<Known> options;
  std::vector<std::string> words;  // that its arguments can be; empty: files
};

std::string first_sentence(const std::string& help) {
  const std::size_t end = std::min(help.find(". "), help.find("; "));
  std::string sentence = help.substr(0, end);
  if (!sentence.empty() && sentence.back() == '.') sentence.pop_back();
  return sentence;
}

void add(const Option& option, std::vector<Known>& options) {
  auto known = std::find_if(options.begin(), options.end(), [&](const Known& k) { return k.name == option.name; });
  if (known == options.end()) {
    options.push_back({option.name,
                       option.text.letter,
                       option.kind != OptionKind::flag,
                       false,
                       is_repeatable(option.kind),
                       {},
                       first_sentence(option.text.help)});
    known = options.end() - 1;
  }
  const std::string& metavar = option.text.metavar;
  // --size and --boundary-size take a file, too; a formula or a number is typed.
  known->takes_file =
      known->takes_file || metavar == "FILE" || metavar == "SCAN" || option.limits.find("a file") != std::string::npos;
  if (option.kind != OptionKind::choice) return;
  for (const std::string& word : choice_words(option)) {
    if (std::find(known->words.begin(), known->words.end(), word) == known->words.end()) known->words.push_back(word);
  }
}

std::vector<KnownCommand> known_commands(const std::vector<std::unique_ptr<Command>>& commands) {
  std::vector<KnownCommand> known;
  std::vector<std::string> names;
  for (const auto& command : commands) {
    KnownCommand& one = known.emplace_back(KnownCommand{command->text().name, command->text().brief, {}, {}});
    for (const OptionSet* set : command->option_sets()) {
      for (const Option& option : set->options()) add(option, one.options);
    }
    one.options.push_back({"help", 'h', false, false, false, {}, "What the command does"});
    names.push_back(one.name);
  }
  known.push_back({"help", "what a command does", {}, names});
  known.push_back({"man", "a manual page, for man -l -", {}, names});
  known.push_back(
      {"completion", "a script for the shell that completes what follows scantet", {}, completion_shells()});
  return known;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

// In single quotes of a shell; `quote` is how a quote stands between them.
std::string quoted(const std::string& text, const std::string& quote) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? quote : std::string(1, c);
  return result + "'";
}

std::string names_of(const std::vector<KnownCommand>& commands) {
  std::vector<std::string> names;
  names.reserve(commands.size());
  for (const KnownCommand& command : commands) names.push_back(command.name);
  return joined(names, " ");
}

// "mesh --output" and "mesh -o"; what a case of bash matches.
std::string bash_pattern(const std::string& command, const Known& option) {
  std::string pattern = "'" + command + " --" + option.name + "'";
  if (option.letter) pattern += std::string("|'") + command + " -" + option.letter + "'";
  return pattern;
}

// clang-format off
constexpr const char* kBashHead = R"end(# Completion of scantet for bash, made by scantet completion bash; do not edit.
_scantet_options() {
  case $1 in
)end";

constexpr const char* kBashTail = R"end(  esac
}

_scantet() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}
  local words='' files=''
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "$(_scantet_options '')" -- "$current")
    return
  fi
  if [[ $current == '=' ]]; then
    current=''
  elif [[ $previous == '=' ]]; then
    previous=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  if ! _scantet_value "$command $previous"; then
    if [[ $current == -* ]]; then
      words=$(_scantet_options "$command")
    else
      _scantet_argument "$command"
    fi
  fi
  if [[ $files ]]; then
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  elif [[ $words ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  fi
}
complete -F _scantet scantet
)end";
// clang-format on

std::string bash_script(const std::vector<KnownCommand>& commands) {
  std::string options = "    '') echo '" + names_of(commands) + " --help --version' ;;\n";
  std::string values;
  std::string arguments;
  for (const KnownCommand& command : commands) {
    std::vector<std::string> all;
    for (const Known& option : command.options) {
      all.push_back("--" + option.name);
      if (option.letter) all.push_back(std::string("-") + option.letter);
      if (!option.takes_value) continue;
      const std::string pattern = "    " + bash_pattern(command.name, option) + ") ";
      if (option.takes_file) {
        values += pattern + "files=1 ;;\n";
      } else {
        values += pattern + (option.words.empty() ? ";;\n" : "words='" + joined(option.words, " ") + "' ;;\n");
      }
    }
    options += "    " + command.name + ") echo '" + joined(all, " ") + "' ;;\n";
    if (!command.words.empty())
      arguments += "    " + command.name + ") words='" + joined(command.words, " ") + "' ;;\n";
  }
  return kBashHead + options +
         "  esac\n}\n\n# What the value of an option can be, for _scantet; not 0 if the word is none that takes one.\n"
         "_scantet_value() {\n  case $1 in\n" +
         values + "    *) return 1 ;;\n  esac\n}\n\n_scantet_argument() {\n  case $1 in\n" + arguments +
         "    *) files=1 ;;\n" + kBashTail;
}

// One specification of _arguments: '*--level[Value of the surface]:V:'.
std::string zsh_option(const Known& option, const std::string& form) {
  std::string help;
  for (const char c : option.help) {
    if (c == '[' || c == ']' || c == '\\' || c == ':') help += '\\';
    help += c;
  }
  std::string text = (option.is_repeatable ? "*" : "") + form + "[" + help + "]";
  if (option.takes_value) {
    text += ":value:";
    if (option.takes_file) {
      text += "_files";
    } else if (!option.words.empty()) {
      text += "(" + joined(option.words, " ") + ")";
    }
  }
  return quoted(text, "'\\''");
}

std::string zsh_script(const std::vector<KnownCommand>& commands) {
  std::string text =
      "#compdef scantet\n# Completion of scantet for zsh, made by scantet completion zsh; do not edit.\n"
      "_scantet() {\n  local -a commands\n  local curcontext=$curcontext state line\n  commands=(\n";
  for (const KnownCommand& command : commands) {
    text += "    " + quoted(command.name + ":" + command.brief, "'\\''") + "\n";
  }
  text +=
      "  )\n  _arguments -C '(- *)'{-h,--help}'[What the program does]' '(- *)--version[Its version]' "
      "'1: :->command' '*:: :->arguments'\n"
      "  case $state in\n    command) _describe -t commands command commands ;;\n    arguments)\n      case $words[1] "
      "in\n";
  for (const KnownCommand& command : commands) {
    text += "        " + command.name + ")\n          _arguments";
    for (const Known& option : command.options) {
      if (option.letter) {
        text += " \\\n            " +
                zsh_option(option, std::string("-") + option.letter + (option.takes_value ? "+" : ""));
      }
      text += " \\\n            " + zsh_option(option, "--" + option.name + (option.takes_value ? "=" : ""));
    }
    text += std::string(" \\\n            ") +
            (command.words.empty() ? "'*:file:_files'" : "'1: :(" + joined(command.words, " ") + ")'") +
            "\n          ;;\n";
  }
  return text +
         "      esac\n      ;;\n  esac\n}\n\nif [[ $funcstack[1] == _scantet ]]; then\n  _scantet \"$@\"\nelse\n"
         "  compdef _scantet scantet\nfi\n";
}

std::string fish_script(const std::vector<KnownCommand>& commands) {
  const std::string quote = "\\'";
  std::string text = "# Completion of scantet for fish, made by scantet completion fish; do not edit.\n";
  for (const KnownCommand& command : commands) {
    text += "complete -c scantet -n __fish_use_subcommand -f -a " + command.name + " -d " +
            quoted(command.brief, quote) + "\n";
  }
  text +=
      "complete -c scantet -n __fish_use_subcommand -f -l help -s h -d 'What the program does'\n"
      "complete -c scantet -n __fish_use_subcommand -f -l version -d 'Its version'\n";
  for (const KnownCommand& command : commands) {
    const std::string start = "complete -c scantet -n '__fish_seen_subcommand_from " + command.name + "' ";
    for (const Known& option : command.options) {
      text += start + "-l " + option.name;
      if (option.letter) text += std::string(" -s ") + option.letter;
      if (option.takes_value) text += option.takes_file ? " -r -F" : " -x";
      if (!option.words.empty()) text += " -a '" + joined(option.words, " ") + "'";
      text += " -d " + quoted(option.help, quote) + "\n";
    }
    if (!command.words.empty()) text += start + "-f -a '" + joined(command.words, " ") + "'\n";
  }
  return text;
}

}  // namespace

const std::vector<std::string>& completion_shells() {
  static const std::vector<std::string> shells{"bash", "zsh", "fish"};
  return shells;
}

std::string completion_script(const std::string& shell, const std::vector<std::unique_ptr<Command>>& commands) {
  const std::vector<KnownCommand> known = known_commands(commands);
  if (shell == "bash") return bash_script(known);
  if (shell == "zsh") return zsh_script(known);
  if (shell == "fish") return fish_script(known);
  throw Error(Fault::usage, "usage.shell", "no completion for the shell \"" + shell + "\"", "give bash, zsh or fish");
}

}  // namespace scantet
