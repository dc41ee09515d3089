// A text is a number, the word auto, the name of something that exists, or a formula, in that order. What looks like a
// file but is none is said to be missing rather than a bad formula.
#include "scantet/size_options/size_request.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "scantet/base/error.h"
#include "scantet/sizing/size_formula.h"

namespace scantet {
namespace {

/// Whether it ends with an extension: a dot, a letter, letters and digits. No std::regex: a long text overflows its
/// stack.
bool looks_like_a_file(const std::string& text) {
  const std::size_t dot = text.rfind('.');
  if (dot == std::string::npos || dot + 1 == text.size()) return false;
  const auto is_letter = [](unsigned char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); };
  const auto is_part = [&](unsigned char c) { return is_letter(c) || (c >= '0' && c <= '9'); };
  const auto first = text.begin() + static_cast<std::ptrdiff_t>(dot) + 1;
  return is_letter(*first) && std::all_of(first, text.end(), is_part);
}

}  // namespace

std::optional<double> number_in(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  return code != std::errc{} || stop != end ? std::nullopt : std::optional(value);
}

SizeRequest read_size(const std::string& place, const std::string& text) {
  using Kind = SizeRequest::Kind;
  SizeRequest request;
  request.option = place;
  request.text = text;
  std::error_code ignored;
  if (text.empty()) return request;
  if (const auto number = number_in(text)) {
    request.kind = Kind::number;
    request.size_mm = *number;
  } else if (text == "auto") {
    request.kind = Kind::automatic;
  } else if (std::filesystem::exists(text, ignored)) {
    request.kind = Kind::source;
    request.image = text;
  } else if (looks_like_a_file(text)) {
    throw Error(Fault::usage, "usage.size", place + ": " + text + ": no such file",
                "give a number, auto, an image of sizes that exists, or a formula");
  } else {
    request.kind = Kind::source;
    request.source = std::make_shared<SizeFormula>(text, place);
  }
  return request;
}

}  // namespace scantet
