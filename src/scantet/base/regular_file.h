// Only files and folders are opened.
#pragma once

#include <string>

#include "scantet/base/api.h"

namespace SCANTET_PROGRAM_API scantet {

/// Throws Error(Fault::input, input.not_a_file) if there is something at the path that is neither a file nor a folder:
/// a pipe, a device or a socket, whose opening or reading could wait for ever. What does not exist passes.
void check_regular_file(const std::string& path);

}  // namespace scantet
