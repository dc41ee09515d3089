// A rehearsal in a child process. Private.
#pragma once

#include <functional>
#include <string>

namespace scantet {

/// Runs `act` in a child process, silently, for 10 s at most. Returns how it ended, as the rest of a sentence about it
/// ("crashes: Segmentation fault"); empty if act() returned.
std::string try_in_child(const std::function<void()>& act);

}  // namespace scantet
