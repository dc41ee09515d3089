// Text that may come from a file, for a terminal.
#pragma once

#include <algorithm>
#include <string>

namespace scantet {

/// The text with a question mark for each control character but line ends and tabs: a terminal would obey them.
inline std::string printable(std::string text) {
  constexpr unsigned char kDelete = 127;
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return (c < ' ' && c != '\n' && c != '\t') || c == kDelete; },
      '?');
  return text;
}

}  // namespace scantet
