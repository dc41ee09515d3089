// Manual pages, made from the commands' declarations.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scantet/cli/command.h"

namespace scantet {

/// scantet(1), in the language of man(7): what the program is for, its commands and exit statuses.
std::string program_manual(const std::vector<std::unique_ptr<Command>>& commands);

/// scantet-COMMAND(1): what the command does, its options, examples and exit statuses.
std::string command_manual(const Command& command);

}  // namespace scantet
