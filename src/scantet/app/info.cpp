// Numbers appear with the fewest digits that keep their value in JSON, and with six digits for people.
#include "scantet/app/info.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace scantet {
namespace {

constexpr int kDigits = 6;

struct ToText {
  std::string operator()(bool value) const { return value ? "yes" : "no"; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return number_text(value, kDigits); }
  /// On one line, whatever a file calls things.
  std::string operator()(std::string value) const {
    std::replace(value.begin(), value.end(), '\n', ' ');
    return value;
  }
  std::string operator()(const std::vector<double>& values) const {
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : "  ") + number_or_label(value);
    return text.empty() ? "none" : text;
  }
  /// Labels are whole, and have up to nineteen digits.
  static std::string number_or_label(double value) {
    constexpr double kLargestWhole = 9e15;  // that a double holds with all of its digits
    if (value != std::floor(value) || std::abs(value) > kLargestWhole) return number_text(value, kDigits);
    return std::to_string(static_cast<std::int64_t>(value));
  }
};

}  // namespace

std::string info_text(const std::vector<InfoSection>& sections) {
  std::size_t width = 0;
  for (const InfoSection& section : sections) {
    for (const InfoEntry& entry : section.entries) width = std::max(width, entry.label.size());
  }
  std::string text;
  for (const InfoSection& section : sections) {
    text += (text.empty() ? "" : "\n") + section.title + "\n";
    for (const InfoEntry& entry : section.entries) {
      text += "  " + entry.label + std::string(width - entry.label.size() + 2, ' ') +
              std::visit(ToText{}, entry.value) + (entry.unit.empty() ? "" : " " + entry.unit) + "\n";
    }
  }
  return text;
}

std::string info_json(const std::vector<InfoSection>& sections) {
  nlohmann::ordered_json root = nlohmann::ordered_json::object();
  for (const InfoSection& section : sections) {
    auto& block = root[section.key] = nlohmann::ordered_json::object();
    for (const InfoEntry& entry : section.entries) {
      std::visit([&](const auto& value) { block[entry.key] = value; }, entry.value);
    }
  }
  return root.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace scantet
