// Text as XML takes it.
#pragma once

#include <string>

namespace scantet {

/// The text of a comment, which must not hold two hyphens in a row: a space goes between.
inline std::string xml_comment(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '-' && !safe.empty() && safe.back() == '-') safe += ' ';
    safe += c;
  }
  return "<!-- " + safe + " -->";
}

/// The text between tags or quotes.
inline std::string xml_escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

}  // namespace scantet
