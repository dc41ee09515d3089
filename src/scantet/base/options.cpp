// Each overload of add() wraps its target in two functions, text -> value and value -> text; everything that uses
// options sees only those. Numbers are read and written with from_chars and to_chars: no locale, and nothing may follow
// a number.
#include "scantet/base/options.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>

#include "scantet/base/error.h"

namespace scantet {
namespace {

constexpr double kLargestExactInteger = 9007199254740992.0;  // 2^53

template <class Number>
std::optional<Number> parse(const std::string& text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  if (code != std::errc{} || stop != end || text.empty()) return std::nullopt;
  return value;
}

// 250000 and 2.5e5 are both counts; 2.5 and -1 are not.
std::optional<std::uint64_t> parse_count(const std::string& text) {
  if (const auto count = parse<std::uint64_t>(text)) return count;
  const auto number = parse<double>(text);
  if (!number || *number < 0 || *number > kLargestExactInteger || std::floor(*number) != *number) return std::nullopt;
  return static_cast<std::uint64_t>(*number);
}

std::string quoted(const std::string& text) {
  return "\"" + text + "\"";
}

[[noreturn]] void refuse(const OptionValue& value, const OptionText& text, const std::string& must_be) {
  const bool numeric = parse<double>(value.text).has_value();
  throw Error(Fault::usage, "usage.value",
              value.place + ": " + (numeric ? value.text : quoted(value.text)) + " is not " + text.noun +
                  ": it must be " + must_be,
              "--" + value.name + (text.metavar.empty() ? "" : " " + text.metavar) + ": " + text.help);
}

double checked_number(const OptionValue& value, const OptionText& text, const Range& range,
                      const std::string& alternative) {
  const auto number = parse<double>(value.text);
  if (range.is_any()) {
    if (!number || !std::isfinite(*number)) refuse(value, text, "a finite number" + alternative);
    return *number;
  }
  if (!number) refuse(value, text, "a number: " + range.text() + alternative);
  if (!std::isfinite(*number)) refuse(value, text, "finite and " + range.text() + alternative);
  if (!range.contains(*number)) refuse(value, text, range.text() + alternative);
  return *number;
}

}  // namespace

bool Range::contains(double value) const {
  if (!std::isfinite(value)) return false;
  if (lowest_ && (open_ ? value <= *lowest_ : value < *lowest_)) return false;
  return !highest_ || value <= *highest_;
}

std::string Range::text() const {
  if (lowest_ && highest_) return "from " + number_text(*lowest_) + " to " + number_text(*highest_);
  if (lowest_) return (open_ ? "greater than " : "at least ") + number_text(*lowest_);
  return "any finite number";
}

void OptionSet::add(std::string name, double& target, const Range& range, OptionText text) {
  Option option{std::move(name), std::move(text), OptionKind::number, range.text(), {}, false, {}, {}};
  option.assign = [&target, range, described = option.text](const OptionValue& value) {
    target = checked_number(value, described, range, "");
  };
  option.read = [&target] { return std::vector{number_text(target)}; };
  add_option(std::move(option));
}

void OptionSet::add(std::string name, std::optional<double>& target, const Range& range, OptionText text) {
  Option option{std::move(name), std::move(text), OptionKind::number, range.text(), {}, false, {}, {}};
  option.assign = [&target, range, described = option.text](const OptionValue& value) {
    if (value.text == "none") {
      target.reset();
    } else {
      target = checked_number(value, described, range, ", or none");
    }
  };
  option.read = [&target] { return target ? std::vector{number_text(*target)} : std::vector<std::string>{}; };
  add_option(std::move(option));
}

void OptionSet::add(std::string name, std::uint64_t& target, const Range& range, OptionText text) {
  Option option{std::move(name), std::move(text), OptionKind::integer, range.text(), {}, false, {}, {}};
  option.assign = [&target, range, described = option.text](const OptionValue& value) {
    const auto count = parse_count(value.text);
    if (!count) refuse(value, described, "a whole number: " + range.text());
    if (!range.contains(static_cast<double>(*count))) refuse(value, described, range.text());
    target = *count;
  };
  option.read = [&target] { return std::vector{std::to_string(target)}; };
  add_option(std::move(option));
}

void OptionSet::add(std::string name, std::string& target, OptionText text) {
  Option option{std::move(name), std::move(text), OptionKind::text, "", {}, false, {}, {}};
  option.assign = [&target, described = option.text](const OptionValue& value) {
    if (value.text.empty()) refuse(value, described, "not empty");
    target = value.text == "none" ? "" : value.text;
  };
  option.read = [&target] { return target.empty() ? std::vector<std::string>{} : std::vector{target}; };
  add_option(std::move(option));
}

void OptionSet::add(std::string name, std::string& target, const Range& range, const std::string& alternatives,
                    std::function<void(const OptionValue&)> check, OptionText text) {
  const std::string limits = range.text() + ", " + alternatives;
  Option option{std::move(name), std::move(text), OptionKind::number, limits, {}, false, {}, {}};
  option.assign = [&target, range, alternatives, check = std::move(check),
                   described = option.text](const OptionValue& value) {
    if (value.text.empty()) refuse(value, described, range.text() + ", " + alternatives);
    if (parse<double>(value.text)) checked_number(value, described, range, ", " + alternatives);
    if (value.text != "none") check(value);
    target = value.text == "none" ? "" : value.text;
  };
  // A value of its own where the default is another.
  const std::vector<std::string> none(target.empty() ? 0 : 1, "none");
  option.read = [&target, none] { return target.empty() ? none : std::vector{target}; };
  add_option(std::move(option));
}

void OptionSet::add(std::string name, std::vector<std::string>& target, OptionText text) {
  Option option{std::move(name), std::move(text), OptionKind::list, "", {}, false, {}, {}};
  option.assign = [&target, described = option.text](const OptionValue& value) {
    if (value.text.empty()) refuse(value, described, "not empty");
    if (value.text == "none") {
      target.clear();
    } else {
      target.push_back(value.text);
    }
  };
  option.read = [&target] { return target; };
  add_option(std::move(option));
}

void OptionSet::add(std::string name, std::vector<double>& target, const Range& range, OptionText text) {
  Option option{std::move(name), std::move(text), OptionKind::numbers, range.text(), {}, false, {}, {}};
  option.assign = [&target, range, described = option.text](const OptionValue& value) {
    if (value.text == "none") {
      target.clear();
    } else {
      target.push_back(checked_number(value, described, range, ""));
    }
  };
  option.read = [&target] {
    std::vector<std::string> texts;
    texts.reserve(target.size());
    for (const double number : target) texts.push_back(number_text(number));
    return texts;
  };
  add_option(std::move(option));
}

void OptionSet::add(std::string name, bool& target, OptionText text) {
  Option option{std::move(name), std::move(text), OptionKind::flag, "", {}, false, {}, {}};
  option.assign = [&target, described = option.text](const OptionValue& value) {
    if (value.text == "none") return;  // null in a configuration: as if it were not given
    if (value.text != "true" && value.text != "false") refuse(value, described, "true or false");
    target = value.text == "true";
  };
  option.read = [&target] { return std::vector<std::string>{target ? "true" : "false"}; };
  add_option(std::move(option));
}

void OptionSet::add_choice(std::string name, std::vector<std::string> words, std::function<void(std::size_t)> assign,
                           std::function<std::size_t()> read, OptionText text) {
  std::string all;
  for (const std::string& word : words) {
    if (!all.empty()) all += &word == &words.back() ? " or " : ", ";
    all += word;
  }
  Option option{std::move(name), std::move(text), OptionKind::choice, all, {}, false, {}, {}};
  option.assign = [words, assign = std::move(assign), all, described = option.text](const OptionValue& value) {
    const auto found = std::find(words.begin(), words.end(), value.text);
    if (found == words.end()) {
      const auto meant = closest_name(value.text, words);
      refuse(value, described, all + (meant ? " (did you mean " + *meant + "?)" : ""));
    }
    assign(static_cast<std::size_t>(found - words.begin()));
  };
  option.read = [words, read = std::move(read)] { return std::vector{words.at(read())}; };
  add_option(std::move(option));
}

void OptionSet::add_option(Option option) {
  assert(find(option.name) == nullptr);
  option.default_values = option.read();
  options_.push_back(std::move(option));
}

const Option* OptionSet::find(std::string_view name) const {
  const auto found = std::find_if(options_.begin(), options_.end(), [&](const Option& o) { return o.name == name; });
  return found == options_.end() ? nullptr : &*found;
}

void OptionSet::set(const OptionValue& value) {
  const auto found =
      std::find_if(options_.begin(), options_.end(), [&](const Option& o) { return o.name == value.name; });
  if (found == options_.end()) {
    std::vector<std::string> names;
    for (const Option& option : options_) names.push_back(option.name);
    const auto meant = closest_name(value.name, names);
    throw Error(Fault::usage, "usage.unknown_option",
                value.place + ": unknown option" + (meant ? "; did you mean " + *meant + "?" : ""));
  }
  if (found->given && !is_repeatable(found->kind)) {
    const auto before = found->read();
    throw Error(Fault::usage, "usage.repeated",
                value.place + ": given more than once (" + (before.empty() ? "none" : before.front()) + ", then " +
                    value.text + ")",
                "give it once");
  }
  found->assign(value);
  found->given = true;
}

std::optional<std::string> closest_name(std::string_view name, const std::vector<std::string>& candidates) {
  const std::size_t near_enough = name.size() <= 3 ? 1 : std::max<std::size_t>(2, name.size() / 3);
  std::optional<std::string> best;
  std::size_t best_distance = near_enough + 1;
  for (const std::string& candidate : candidates) {
    // Rows of the edit distance table: two above, one above, current.
    std::array<std::vector<std::size_t>, 3> rows;
    for (auto& row : rows) row.resize(candidate.size() + 1);
    for (std::size_t j = 0; j <= candidate.size(); ++j) rows[1][j] = j;
    for (std::size_t i = 1; i <= name.size(); ++i) {
      rows[2][0] = i;
      for (std::size_t j = 1; j <= candidate.size(); ++j) {
        const std::size_t replaced = rows[1][j - 1] + (name[i - 1] == candidate[j - 1] ? 0 : 1);
        rows[2][j] = std::min({replaced, rows[1][j] + 1, rows[2][j - 1] + 1});
        const bool swapped = i > 1 && j > 1 && name[i - 1] == candidate[j - 2] && name[i - 2] == candidate[j - 1];
        if (swapped) rows[2][j] = std::min(rows[2][j], rows[0][j - 2] + 1);
      }
      std::rotate(rows.begin(), rows.begin() + 1, rows.end());
    }
    if (rows[1][candidate.size()] < best_distance) {
      best_distance = rows[1][candidate.size()];
      best = candidate;
    }
  }
  return best;
}

std::string number_text(double value) {
  std::array<char, 32> buffer;
  const auto [end, code] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end};
}

std::string number_text(double value, int digits) {
  assert(digits >= 1 && digits <= 50);
  std::array<char, 64> buffer;  // with signs, exponent and leading zeros 50 digits take 57 at most
  const auto [end, code] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, digits);
  assert(code == std::errc{});
  return {buffer.data(), end};
}

}  // namespace scantet
