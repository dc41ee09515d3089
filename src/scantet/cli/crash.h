// What the program says when it crashes.
#pragma once

#include <string>

namespace scantet {

/// From now on a crash removes unfinished output files, says what happened and to whom to tell it, and ends the
/// program with status 1. A sanitizer's own handlers stay.
void install_crash_handlers();

/// Names a plugin of the user's in that message.
void suspect_plugin(const std::string& file);

}  // namespace scantet
