// Lines of Abaqus input, taken apart. Private to io/.
#pragma once

#include <algorithm>
#include <cctype>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scantet/base/stratum.h"
#include "scantet/io/text_scanner_impl.h"

namespace scantet {

/// Without blanks and the carriage return at its ends.
inline std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// In capitals: Abaqus does not tell a from A.
inline std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

/// The parts between commas; no last part after a comma at the end.
inline void split(std::string_view line, std::vector<std::string_view>& parts) {
  parts.clear();
  while (!line.empty()) {
    const std::size_t comma = std::min(line.find(','), line.size());
    parts.push_back(trimmed(line.substr(0, comma)));
    line.remove_prefix(std::min(comma + 1, line.size()));
  }
}

/// The region that a set of elements stands for by its name, -3 for REGION_M3; none for other names.
inline std::optional<Region> region_in(std::string_view name) {
  constexpr std::string_view kPrefix = "REGION_";
  if (!name.starts_with(kPrefix)) return std::nullopt;
  std::string digits(name.substr(kPrefix.size()));
  if (digits.starts_with('M')) digits[0] = '-';
  std::int64_t region = 0;
  const bool fits = parse_number(digits, region) && region >= std::numeric_limits<Region>::min() &&
                    region <= std::numeric_limits<Region>::max();
  return fits ? std::optional(static_cast<Region>(region)) : std::nullopt;
}

}  // namespace scantet
