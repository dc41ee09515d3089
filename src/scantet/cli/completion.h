// What a shell completes after `scantet`, made from the commands' declarations.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scantet/cli/command.h"

namespace scantet {

/// The shells that completion_script() knows.
const std::vector<std::string>& completion_shells();

/// A script for the shell, to be put where it looks for such, or to be sourced: commands, options, words that an option
/// takes, and names of files where there may be some. Throws Error: usage.shell.
std::string completion_script(const std::string& shell, const std::vector<std::unique_ptr<Command>>& commands);

}  // namespace scantet
