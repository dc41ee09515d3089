// Help texts and docs/options.md, made from the commands' declarations.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scantet/cli/command.h"

namespace scantet {

/// The options of a command under one heading.
struct OptionGroup {
  std::string title;
  std::vector<const Option*> options;
};

/// In order of first appearance; an option that several plugins have is listed for each.
std::vector<OptionGroup> option_groups(const Command& command);

/// "greater than 0; default 1"; empty if there is nothing to say.
std::string option_facts(const Option& option);

/// The words that an option of the kind choice takes: "none, exude or full" are three.
std::vector<std::string> choice_words(const Option& option);

struct ExitStatus {
  int status;
  std::string meaning;
};

/// Of every command.
const std::vector<ExitStatus>& exit_statuses();

/// What the program is for, in a sentence.
extern const char* const kProgramPurpose;

/// "-o, --output FILE".
std::string option_form(const Option& option);

/// `scantet --help`.
std::string program_help(const std::vector<std::unique_ptr<Command>>& commands);

/// `scantet COMMAND --help`.
std::string command_help(const Command& command);

/// docs/options.md: every option of every command, in Markdown.
std::string options_markdown(const std::vector<std::unique_ptr<Command>>& commands);

}  // namespace scantet
