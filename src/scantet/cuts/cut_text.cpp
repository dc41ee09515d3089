// A cut is taken apart at its signs < and >, of which it has one or two; each part is a number or a sum of axes.
#include "scantet/cuts/cut_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "scantet/base/error.h"

namespace scantet {
namespace {

constexpr const char* kForm =
    "give what is to be kept: \"x < 10\", \"x + 2z > -3.5\" or \"-10 < y < 10\", in mm, with a name before it if it is "
    "to have one: \"clamp: z > -40\"";

[[noreturn]] void refuse(const std::string& place, const std::string& text, const std::string& why) {
  throw Error(Fault::usage, "usage.cut", place + ": \"" + text + "\" is no plane: " + why, kForm);
}

bool is_axis(char c) {
  return c >= 'x' && c <= 'z';
}

/// The number that the text starts with, which is cut off; none if it starts with none.
std::optional<double> take_number(std::string& text) {
  double value = 0;
  const auto [stop, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc{} || !std::isfinite(value)) return std::nullopt;
  text.erase(0, static_cast<std::size_t>(stop - text.data()));
  return value;
}

/// "-x+2*z" without blanks as (-1, 0, 2).
std::optional<Vec> sum_of_axes(std::string text) {
  Vec sum;
  for (bool is_first = true; !text.empty() || is_first; is_first = false) {
    double factor = 1;
    if (!text.empty() && (text[0] == '+' || text[0] == '-')) {
      factor = text[0] == '-' ? -1 : 1;
      text.erase(0, 1);
    } else if (!is_first) {
      return std::nullopt;
    }
    if (!text.empty() && text[0] != '-') factor *= take_number(text).value_or(1);
    if (!text.empty() && text[0] == '*') text.erase(0, 1);
    if (text.empty() || !is_axis(text[0])) return std::nullopt;
    sum[text[0] - 'x'] += factor;
    text.erase(0, 1);
  }
  return sum;
}

std::optional<double> number_in(std::string text) {
  if (!text.empty() && text[0] == '+') text.erase(0, 1);
  const std::optional<double> value = take_number(text);
  return text.empty() ? value : std::nullopt;
}

struct Inequality {
  std::vector<std::string> parts;  // two or three, without blanks
  bool is_rising = true;           // "<" between them
};

Inequality take_apart(const std::string& place, const std::string& whole, const std::string& text) {
  Inequality found;
  found.parts.emplace_back();
  std::string signs;
  for (const char c : text) {
    if (c == ' ' || c == '\t' || (c == '=' && found.parts.back().empty())) continue;  // "<=" is "<"
    if (c == '<' || c == '>') {
      signs += c;
      found.parts.emplace_back();
    } else {
      found.parts.back() += c;
    }
  }
  if (signs.empty()) refuse(place, whole, "it has neither < nor >");
  if (signs.size() > 2) refuse(place, whole, "it has more than two signs < or >");
  if (signs.size() == 2 && signs[0] != signs[1]) refuse(place, whole, "its signs point both ways");
  found.is_rising = signs[0] == '<';
  return found;
}

/// What is kept is where sum < value.
CutPlane plane_of(const Vec& sum, double value, std::string name) {
  const double norm = length(sum);
  return {(1 / norm) * sum, value / norm, std::move(name)};
}

std::string name_in(const std::string& place, const std::string& text, std::string& rest) {
  const std::size_t colon = text.find(':');
  rest = colon == std::string::npos ? text : text.substr(colon + 1);
  std::string name = colon == std::string::npos ? "" : text.substr(0, colon);
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  if (colon != std::string::npos && (name.empty() || !std::all_of(name.begin(), name.end(), is_plain))) {
    refuse(place, text, "a name has letters, digits, _ and -");
  }
  return name;
}

}  // namespace

void read_cut(const std::string& place, const std::string& text, std::vector<CutPlane>& planes) {
  std::string rest;
  const std::string name = name_in(place, text, rest);
  Inequality found = take_apart(place, text, rest);
  std::vector<std::string>& parts = found.parts;
  if (!found.is_rising) std::reverse(parts.begin(), parts.end());
  if (parts.size() == 2 && number_in(parts[0])) {
    parts.emplace_back();  // 3 < x: no upper bound
  } else if (parts.size() == 2) {
    parts.insert(parts.begin(), "");
  }
  const std::optional<Vec> sum = sum_of_axes(parts[1]);
  if (!sum) refuse(place, text, "\"" + parts[1] + "\" is no sum of x, y and z");
  if (!(squared_length(*sum) > 0)) refuse(place, text, "\"" + parts[1] + "\" is 0 everywhere");
  std::array<std::optional<double>, 2> bounds;
  for (const std::size_t end : {0, 1}) {
    const std::string& bound = parts[2 * end];
    if (bound.empty() && !parts[2 - 2 * end].empty() && found.parts.size() == 3) continue;
    bounds[end] = number_in(bound);
    if (!bounds[end]) refuse(place, text, "\"" + bound + "\" is no number");
  }
  if (bounds[0] && bounds[1] && !(*bounds[0] < *bounds[1])) refuse(place, text, "it keeps nothing");
  const bool are_two = bounds[0] && bounds[1];
  for (const std::size_t end : {0, 1}) {
    if (!bounds[end]) continue;
    std::string own = name.empty() ? "cut_" + std::to_string(planes.size() + 1) : name;
    if (!name.empty() && are_two) own += end == 0 ? "_low" : "_high";
    const auto has_name = [&](const CutPlane& plane) { return plane.name == own; };
    if (std::any_of(planes.begin(), planes.end(), has_name)) refuse(place, text, "another cut is called " + own);
    const double sign = end == 0 ? -1 : 1;
    planes.push_back(plane_of(sign * *sum, sign * *bounds[end], std::move(own)));
  }
}

}  // namespace scantet
