// What the JSON library says of a text, in words for people.
#pragma once

#include <string>

namespace scantet {

/// The message without its tag, which helps nobody: "[json.exception.parse_error.101] parse error at line 2, column 5:
/// syntax error ...".
inline std::string without_json_tag(const std::string& message) {
  const std::size_t end = message.find("] ");
  const bool tagged = message.starts_with("[json.") && end != std::string::npos;
  return tagged ? message.substr(end + 2) : message;
}

}  // namespace scantet
