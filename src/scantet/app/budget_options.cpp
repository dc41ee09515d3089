// A number and a letter for its unit.
#include "scantet/app/budget_options.h"

#include <charconv>
#include <cmath>

#include "scantet/base/error.h"

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

std::string bytes_text(double bytes) {
  constexpr double kGibi = kKibi * kKibi * kKibi;
  return bytes < kGibi ? number_text(bytes / kKibi / kKibi, 3) + "M" : number_text(bytes / kGibi, 3) + "G";
}

std::optional<double> BudgetOptions::time_s() const {
  return time.empty() ? std::nullopt : std::optional(read_duration("--max-time", time));
}

std::optional<double> BudgetOptions::memory_bytes() const {
  return memory.empty() ? std::nullopt : std::optional(read_bytes("--max-memory", memory));
}

void declare_budget_options(OptionSet& options, BudgetOptions& budget, const char* group) {
  options.add("max-time", budget.time, Range::above(0), "or with a unit: 90s, 10m, 1.5h",
              [](const OptionValue& value) { read_duration(value.place, value.text); },
              {group, "TIME", "a duration",
               "Sampling, refinement and improvement give up after this time (wall, seconds without a unit), with exit "
               "status 4 and the mesh there is by then, if there is one. Audit and writing follow and take their time. "
               "What is cut off by the clock is not the same in every run."});
  options.add("max-memory", budget.memory, Range::above(0), "or with a unit: 500M, 8G",
              [](const OptionValue& value) { read_bytes(value.place, value.text); },
              {group, "SIZE", "an amount of memory",
               "As --max-time, of the memory that the program holds (bytes without a unit). A size that will take more "
               "is refused before the work; without the option, one that will take more than the machine has."});
}

std::string budget_text(const BudgetOptions& options, const Budget& budget) {
  const bool is_time = budget.end() == Budget::End::time;
  return (is_time ? "--max-time " + options.time : "--max-memory " + options.memory) + " was over while busy with '" +
         budget.busy_with() + "'";
}

}  // namespace scantet
