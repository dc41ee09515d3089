// to_chars knows no locale: the same text everywhere.
#include <cmath>

#include "scantet/report/numbers_impl.h"

namespace scantet {

std::string grouped(std::uint64_t value) {
  std::string text = std::to_string(value);
  for (std::size_t i = text.size(); i > 3;) {
    i -= 3;
    text.insert(i, 1, ',');
  }
  return text;
}

std::string counted(std::uint64_t count, const char* one, const char* many) {
  return grouped(count) + " " + (count == 1 ? one : many);
}

std::string printed(double value, std::chars_format format, int precision) {
  char buffer[400];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value, format, precision).ptr};
}

std::string percent_text(std::uint64_t part, std::uint64_t whole) {
  const double share = whole == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(whole);
  return printed(share, std::chars_format::fixed, 2) + " %";
}

std::string number(double value) {
  if (std::isnan(value)) return "none";
  if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
  constexpr double kWhole = 1e3;
  constexpr double kScientific = 1e15;
  const double size = std::abs(value);
  if (std::round(size) < kWhole || size >= kScientific) return printed(value, std::chars_format::general, 4);
  const std::string digits = grouped(static_cast<std::uint64_t>(std::llround(size)));
  return value < 0 ? '-' + digits : digits;
}

}  // namespace scantet
