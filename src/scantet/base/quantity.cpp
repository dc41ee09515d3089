// A number and a letter for its unit.
#include "scantet/base/quantity.h"

#include <charconv>
#include <cmath>
#include <optional>

#include "scantet/base/error.h"
#include "scantet/base/options.h"

namespace scantet {
namespace {

constexpr double kKibi = 1024;

struct Unit {
  const char* name;
  double factor;
};

/// The number times its unit's factor; none if the text is anything else, or not positive and finite.
template <std::size_t kCount>
std::optional<double> read_quantity(const std::string& text, const Unit (&units)[kCount]) {
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, code] = std::from_chars(text.data(), end, number);
  if (code != std::errc{}) return std::nullopt;
  const std::string unit(rest, end);
  for (const Unit& known : units) {
    const double quantity = number * known.factor;
    if (unit == known.name && quantity > 0 && std::isfinite(quantity)) return quantity;
  }
  return std::nullopt;
}

[[noreturn]] void refuse(const std::string& place, const std::string& text, const char* what, const char* example) {
  throw Error(Fault::usage, "usage.value", place + ": '" + text + "' is not " + what, example);
}

}  // namespace

double read_duration(const std::string& place, const std::string& text) {
  constexpr Unit kUnits[] = {{"", 1}, {"s", 1}, {"m", 60}, {"min", 60}, {"h", 3600}};
  const auto seconds = read_quantity(text, kUnits);
  if (!seconds) refuse(place, text, "a duration greater than 0", "give seconds, or a unit as in 90s, 10m or 1.5h");
  return *seconds;
}

double read_bytes(const std::string& place, const std::string& text) {
  constexpr Unit kUnits[] = {
      {"", 1}, {"K", kKibi}, {"M", kKibi * kKibi}, {"G", kKibi * kKibi * kKibi}, {"T", kKibi * kKibi * kKibi * kKibi}};
  const auto bytes = read_quantity(text, kUnits);
  if (!bytes) refuse(place, text, "an amount of memory greater than 0", "give bytes, or a unit as in 500M or 8G");
  return *bytes;
}

LengthOrShare read_length_or_share(const std::string& place, const std::string& text) {
  constexpr Unit kLength[] = {{"", 1}, {"mm", 1}};
  constexpr Unit kShare[] = {{"%", 0.01}};
  if (text == "0" || text == "0%") return {};
  if (const auto mm = read_quantity(text, kLength)) return {*mm, 0};
  if (const auto share = read_quantity(text, kShare)) return {0, *share};
  refuse(place, text, "a length or a share", "give mm, as in 0.2, or a share, as in 5%");
}

std::string bytes_text(double bytes) {
  constexpr double kGibi = kKibi * kKibi * kKibi;
  return bytes < kGibi ? number_text(bytes / kKibi / kKibi, 3) + "M" : number_text(bytes / kGibi, 3) + "G";
}

}  // namespace scantet
