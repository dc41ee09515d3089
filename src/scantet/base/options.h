// Options are declared once: a field with its default and one description. The command line, JSON configuration, help,
// validation, closest-name hints, the report and docs/options.md are all made from that declaration.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

/// The numbers an option accepts; always finite. Default: every finite number.
class Range {
 public:
  Range() = default;
  /// Numbers greater than the bound. Bounds are finite, here and below.
  static Range above(double bound) { return {bound, true, std::nullopt}; }
  /// Numbers from the bound on.
  static Range at_least(double bound) { return {bound, false, std::nullopt}; }
  /// Numbers from the lowest to the highest, both included.
  static Range between(double lowest, double highest) { return {lowest, false, highest}; }

  /// Whether an option takes the value.
  bool contains(double value) const;
  /// Whether it takes every finite number.
  bool is_any() const { return !lowest_ && !highest_; }
  /// "greater than 0", "at least 1", "from 0 to 4" or "any finite number".
  std::string text() const;

 private:
  Range(std::optional<double> lowest, bool open, std::optional<double> highest)
      : lowest_(lowest), open_(open), highest_(highest) {}
  std::optional<double> lowest_;
  bool open_ = false;  // lowest_ itself is not allowed
  std::optional<double> highest_;
};

/// The description of an option.
struct OptionText {
  std::string group;    ///< heading in help and docs, e.g. "Sizes and shapes"
  std::string metavar;  ///< stands for the value in help, with its unit if it has one: "MM"; empty for a flag
  std::string noun;     ///< what the value is, for messages: "a size in mm"
  std::string help;     ///< one or two sentences
  char letter = 0;      ///< one-letter form, 0 for none
  std::string unset{};  ///< what having no value means, where help would say "none": "required"
};

/// What an option takes: true or false; a number (or another text, where that is declared); a whole number; one of a
/// few words; a text; several texts; several numbers.
enum class OptionKind { flag, number, integer, choice, text, list, numbers };

/// Whether an option of the kind may be given several times.
inline bool is_repeatable(OptionKind kind) {
  return kind == OptionKind::list || kind == OptionKind::numbers;
}

/// A value for an option, and where it was given.
struct OptionValue {
  std::string name;   ///< of the option, without dashes
  std::string text;   ///< the value as typed
  std::string place;  ///< opens an error message: "--size", or "job.json: \"size\""
};

/// One declared option, with its type erased.
struct Option {
  std::string name;  ///< without dashes; also the key in JSON
  OptionText text;
  OptionKind kind = OptionKind::text;
  std::string limits;                       ///< what values are allowed, for people; empty if any
  std::vector<std::string> default_values;  ///< as texts; empty for none
  bool given = false;                       ///< set() was called, and took the value
  /// Writes a value to the target; throws Error as OptionSet::set(). For set() alone, which keeps account of it.
  std::function<void(const OptionValue&)> assign;
  std::function<std::vector<std::string>()> read;  ///< the current value as texts; empty for none
};

/// A set of declared options. The targets passed to add() must outlive the set. For one thread at a time.
class OptionSet {
 public:
  /// Declares an option whose value lives in `target`, which holds the default. `name` is unique in the set, in lower
  /// case with hyphens and without leading dashes.
  void add(std::string name, double& target, const Range& range, OptionText text);
  /// nullopt: no value ("none" on the command line, null in JSON).
  void add(std::string name, std::optional<double>& target, const Range& range, OptionText text);
  /// A whole number from 0 on, as "250000" or "2.5e5".
  void add(std::string name, std::uint64_t& target, const Range& range, OptionText text);
  /// Any text but an empty one; "none" empties it, so a file of that name is given as ./none.
  void add(std::string name, std::string& target, OptionText text);
  /// A number in the range, or another text; "none" empties it. alternatives: the texts that make sense, for people:
  /// "auto or a formula". check: called for every value but "none"; throws an Error for texts that make no sense.
  void add(std::string name, std::string& target, const Range& range, const std::string& alternatives,
           std::function<void(const OptionValue&)> check, OptionText text);
  /// Repeatable: each value, any text but an empty one, is appended; "none" (null in JSON) takes away those before it.
  void add(std::string name, std::vector<std::string>& target, OptionText text);
  /// Repeatable: each number is appended; "none" (null in JSON) takes away those before it.
  void add(std::string name, std::vector<double>& target, const Range& range, OptionText text);
  /// A flag: "true" or "false"; "none" leaves it as it is.
  void add(std::string name, bool& target, OptionText text);
  /// One of a few words. choices: the words, each with its value. Pre: the target has the value of one of them.
  template <class Enum>
  void add(std::string name, Enum& target, std::vector<std::pair<std::string, Enum>> choices, OptionText text);

  /// Sets one option. Throws Error: usage.unknown_option (with the closest name), usage.value (wrong type or out of
  /// range), usage.repeated (given twice though it is not repeatable), and what the check of an option throws; nothing
  /// has changed then.
  void set(const OptionValue& value);

  /// nullptr if there is none of that name; valid until the next add().
  const Option* find(std::string_view name) const;
  /// In the order of declaration.
  const std::vector<Option>& options() const { return options_; }

 private:
  void add_option(Option option);
  void add_choice(std::string name, std::vector<std::string> words, std::function<void(std::size_t)> assign,
                  std::function<std::size_t()> read, OptionText text);
  std::vector<Option> options_;
};

/// The candidate nearest to `name` in typing errors (insertion, deletion, replacement, swap of neighbours), if it is
/// near enough to be meant: one error in names of up to three letters, else two, or a third of its letters if that is
/// more; the first such candidate on a tie.
std::optional<std::string> closest_name(std::string_view name, const std::vector<std::string>& candidates);

/// The shortest text that reads back as the same number; "inf" or "nan", perhaps with a sign, if it is not finite.
std::string number_text(double value);
/// With at most `digits` significant digits, for people. digits: 1 … 50.
std::string number_text(double value, int digits);

template <class Enum>
void OptionSet::add(std::string name, Enum& target, std::vector<std::pair<std::string, Enum>> choices,
                    OptionText text) {
  std::vector<std::string> words;
  words.reserve(choices.size());
  for (const auto& choice : choices) words.push_back(choice.first);
  std::function<std::size_t()> read = [&target, choices] {
    std::size_t index = 0;
    while (index < choices.size() && choices[index].second != target) ++index;
    return index;
  };
  std::function<void(std::size_t)> assign = [&target, choices](std::size_t index) { target = choices[index].second; };
  add_choice(std::move(name), std::move(words), std::move(assign), std::move(read), std::move(text));
}

}  // namespace scantet
