// Names in a sentence, where there may be too many for one.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace scantet {

/// "foot, tip and 3 more": the first of them, at most so many. most: at least 1. Empty if there are none.
inline std::string name_list(const std::vector<std::string>& names, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) text += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > most) text += " and " + std::to_string(names.size() - most) + " more";
  return text;
}

}  // namespace scantet
