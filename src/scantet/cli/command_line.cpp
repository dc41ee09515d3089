// The only file that knows CLI11. CLI11 splits words; names, types and ranges are OptionSet's business, so every option
// is a list of texts here.
#include "scantet/cli/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>

#include "scantet/base/error.h"

namespace scantet {
namespace {

struct Typed {
  const Option* option;
  std::vector<std::string> texts;  // of an option with a value
  std::int64_t count = 0;          // of a flag
};

// Options that may be given without a value, and what they mean then: a word behind them is theirs only if it is one of
// their values.
struct BareOption {
  const char* word;
  const char* meaning;
  std::vector<std::string> values;
};

std::string takes(const BareOption& bare) {
  std::string text = std::string(bare.word) + " takes ";
  for (std::size_t n = 0; n < bare.values.size(); ++n) {
    text += (n == 0 ? "" : n + 1 == bare.values.size() ? " or " : ", ") + bare.values[n];
  }
  return text;
}

std::vector<std::string> with_values(std::vector<std::string> words, std::vector<CommandLine::NoValue>& no_values) {
  static const BareOption bare_options[] = {
      {"--certify", "--certify=certified", {"no", "bounded", "certified", "refine"}}};
  for (std::size_t n = 0; n < words.size() && words[n] != "--"; ++n) {
    for (const BareOption& bare : bare_options) {
      if (words[n] != bare.word) continue;
      const bool has_value =
          n + 1 < words.size() && std::find(bare.values.begin(), bare.values.end(), words[n + 1]) != bare.values.end();
      if (has_value) continue;
      words[n] = bare.meaning;
      if (n + 1 < words.size()) no_values.push_back({words[n + 1], takes(bare)});
    }
  }
  return words;
}

[[noreturn]] void refuse_unknown(const std::string& word, const std::map<std::string, Typed>& known) {
  const std::string name = word.substr(0, word.find('='));
  std::vector<std::string> candidates{"--help"};
  for (const auto& entry : known) candidates.push_back("--" + entry.first);
  const auto meant = closest_name(name, candidates);
  throw Error(Fault::usage, "usage.unknown_option",
              "unknown option " + name + (meant ? "; did you mean " + *meant + "?" : ""), "--help lists the options");
}

void declare(CLI::App& app, Typed& typed) {
  const Option& option = *typed.option;
  const std::string names =
      (option.text.letter ? std::string("-") + option.text.letter + "," : "") + "--" + option.name;
  if (option.kind == OptionKind::flag) {
    app.add_flag(names, typed.count)->disable_flag_override();
  } else {
    app.add_option(names, typed.texts)->allow_extra_args(false)->type_name(option.text.metavar);
  }
}

// "--size: 1 required MM missing" and its like become a sentence.
Error translate(const CLI::ParseError& error) {
  const std::string text = error.what();
  const std::size_t colon = text.find(": ");
  if (text.rfind('-', 0) == 0 && colon != std::string::npos && text.find("required") != std::string::npos) {
    return {Fault::usage, "usage.value_missing", text.substr(0, colon) + ": its value is missing",
            "write the value after the option"};
  }
  return {Fault::usage, "usage.command_line", text, "--help shows how to call the command"};
}

}  // namespace

CommandLine parse_command_line(const std::vector<std::string>& words, const std::vector<const OptionSet*>& sets) {
  std::map<std::string, Typed> known;
  for (const OptionSet* set : sets) {
    for (const Option& option : set->options()) known.emplace(option.name, Typed{&option, {}, 0});
  }
  CommandLine line;
  CLI::App app;
  app.set_help_flag();
  app.add_flag("-h,--help", line.help)->disable_flag_override();
  app.allow_extras();
  for (auto& entry : known) declare(app, entry.second);
  try {
    const std::vector<std::string> full = with_values(words, line.no_values);
    app.parse(std::vector<std::string>(full.rbegin(), full.rend()));  // CLI11 takes them last first
  } catch (const CLI::ParseError& error) {
    throw translate(error);
  }
  bool options_over = false;
  for (const std::string& word : app.remaining()) {
    if (!options_over && word == "--") {
      options_over = true;
    } else if (!options_over && word.size() > 1 && word.front() == '-') {
      refuse_unknown(word, known);
    } else {
      line.arguments.push_back(word);
    }
  }
  for (const auto& [name, typed] : known) {
    for (const std::string& text : typed.texts) line.values.push_back({name, text, "--" + name});
    for (std::int64_t i = 0; i < typed.count; ++i) line.values.push_back({name, "true", "--" + name});
  }
  return line;
}

}  // namespace scantet
