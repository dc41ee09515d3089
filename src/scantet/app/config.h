// Options from a JSON file, and the options of a run as JSON.
#pragma once

#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/options.h"

namespace SCANTET_PROGRAM_API scantet {

/// Reads an object with option names (no dashes) as keys: {"level": 60, "size": 2.5, "output": ["a.vtu", "a.stl"]}.
/// null stands for "none"; a list gives a repeatable option several times. Names and values are checked when they are
/// set, not here.
/// Throws Error: usage.config (the file cannot be read, is not JSON, is no object, or has a key twice; with the place).
std::vector<OptionValue> read_config(const std::string& file);

}  // namespace scantet
