// A text is a number, the word auto, the name of something that exists, or a formula, in that order. What looks like a
// file but is none is said to be missing rather than a bad formula.
#include "scantet/app/size_request.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <regex>

#include "scantet/base/error.h"
#include "scantet/sizing/size_formula.h"

namespace scantet {
namespace {

std::optional<double> number_in(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  return code != std::errc{} || stop != end ? std::nullopt : std::optional(value);
}

bool looks_like_a_file(const std::string& text) {
  static const std::regex extension(R"(.*\.[A-Za-z][A-Za-z0-9]*)");
  return std::regex_match(text, extension);
}

std::map<Region, double> region_sizes_of(const std::vector<std::string>& texts) {
  std::map<Region, double> sizes;
  static const std::regex form(R"((\d{1,9})=(.+))");
  for (const std::string& text : texts) {
    std::smatch parts;
    const bool matches = std::regex_match(text, parts, form);
    const std::optional<double> size = matches ? number_in(parts[2].str()) : std::nullopt;
    const Region region = matches ? std::stoi(parts[1].str()) : kOutside;
    if (!size || !(*size > 0) || !std::isfinite(*size) || region == kOutside) {
      throw Error(Fault::usage, "usage.region_size", "--region-size: \"" + text + "\" is not a region and its size",
                  "give the region's number, from 1, and a size in mm greater than 0: --region-size 2=1.5");
    }
    if (!sizes.emplace(region, *size).second) {
      throw Error(Fault::usage, "usage.region_size", "--region-size: region " + parts[1].str() + " has two sizes",
                  "give each region once");
    }
  }
  return sizes;
}

}  // namespace

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

SizePlan plan_sizes(const SizeOptions& options) {
  return {read_size("--size", options.size), read_size("--boundary-size", options.boundary_size),
          region_sizes_of(options.region_sizes)};
}

}  // namespace scantet
