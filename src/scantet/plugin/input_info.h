// Facts about an input, for people and for programs.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

/// A truth, a whole number, a number, a text or a list of numbers.
using InfoValue = std::variant<bool, std::int64_t, double, std::string, std::vector<double>>;

/// One fact about an input: "spacing_mm" = {0.5, 0.5, 1}.
struct InfoEntry {
  std::string key;    ///< in JSON, unique in its section; unit in the name where there is one
  std::string label;  ///< for people, "spacing"
  InfoValue value;
  std::string unit;  ///< follows the value for people: "mm"; may be empty
};

/// A block of facts under one heading; both lists keep their order.
struct InfoSection {
  std::string key;    ///< in JSON, unique among the sections
  std::string title;  ///< the heading, for people
  std::vector<InfoEntry> entries;
};

}  // namespace scantet
