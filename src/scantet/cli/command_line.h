// From the words of a command line to option values, for any set of declared options.
#pragma once

#include <string>
#include <vector>

#include "scantet/base/options.h"

namespace scantet {

/// What was typed after the command's name.
struct CommandLine {
  std::vector<std::string> arguments;  ///< words that are neither options nor their values
  std::vector<OptionValue> values;     ///< not checked yet: OptionSet::set does that
  bool help = false;                   ///< -h or --help
  /// An argument behind an option that may be given without a value, and no value of it: the option with its values,
  /// for a word too many.
  struct NoValue {
    std::string word;
    std::string takes;  ///< "--certify takes no, bounded, certified or refine"
  };
  std::vector<NoValue> no_values;
};

/// Splits `words` by the options declared in `sets` (several sets may declare the same name).
/// Throws Error: usage.unknown_option (with the closest name), usage.value_missing.
CommandLine parse_command_line(const std::vector<std::string>& words, const std::vector<const OptionSet*>& sets);

}  // namespace scantet
