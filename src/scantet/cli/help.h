// Help texts and docs/options.md, made from the commands' declarations.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scantet/cli/command.h"

namespace scantet {

/// "-o, --output FILE".
std::string option_form(const Option& option);

/// `scantet --help`.
std::string program_help(const std::vector<std::unique_ptr<Command>>& commands);

/// `scantet COMMAND --help`.
std::string command_help(const Command& command);

/// docs/options.md: every option of every command, in Markdown.
std::string options_markdown(const std::vector<std::unique_ptr<Command>>& commands);

}  // namespace scantet
