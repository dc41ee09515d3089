// Lines of Abaqus input, taken apart. Private to io/.
#pragma once

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scantet/base/ascii_text.h"
#include "scantet/base/stratum.h"
#include "scantet/io/text_scanner_impl.h"

namespace scantet {

/// The parts between commas; no last part after a comma at the end.
inline void split(std::string_view line, std::vector<std::string_view>& parts) {
  parts.clear();
  while (!line.empty()) {
    const std::size_t comma = std::min(line.find(','), line.size());
    parts.push_back(trimmed(line.substr(0, comma)));
    line.remove_prefix(std::min(comma + 1, line.size()));
  }
}

/// Whether elements of the type are surfaces, lines or points: they may lie beside the tets.
inline bool has_no_volume(std::string_view type) {
  constexpr std::string_view kBeginnings[] = {"CPS", "CPE", "CAX", "M3D", "R3D", "SFM3D", "STRI", "S3",
                                              "S4",  "S6",  "S8",  "T2D", "T3D", "B2",    "B3",   "MASS"};
  return std::any_of(std::begin(kBeginnings), std::end(kBeginnings),
                     [&](std::string_view beginning) { return type.starts_with(beginning); });
}

/// How many nodes elements of the type have if they are triangles, which may be faces of tets; 0 if they are not.
inline std::size_t nodes_of_triangle(std::string_view type) {
  constexpr std::string_view kOfThree[] = {"S3", "STRI3", "CPS3", "CPE3", "M3D3", "R3D3", "SFM3D3"};
  constexpr std::string_view kOfSix[] = {"S6", "STRI65", "CPS6", "CPE6", "M3D6", "SFM3D6"};
  const auto begins = [&](std::string_view beginning) { return type.starts_with(beginning); };
  if (std::any_of(std::begin(kOfThree), std::end(kOfThree), begins)) return 3;
  return std::any_of(std::begin(kOfSix), std::end(kOfSix), begins) ? 6 : 0;
}

/// Whether the keyword only says how the file is put together.
inline bool is_of_order(std::string_view keyword) {
  constexpr std::string_view kKeywords[] = {"HEADING",  "PREPRINT",     "PART",        "END PART",
                                            "ASSEMBLY", "END ASSEMBLY", "END INSTANCE"};
  return std::find(std::begin(kKeywords), std::end(kKeywords), keyword) != std::end(kKeywords);
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
