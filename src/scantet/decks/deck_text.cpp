#include <algorithm>
#include <charconv>
#include <cmath>

#include "scantet/base/error.h"
#include "scantet/decks/deck.h"

namespace scantet {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& text, const std::string& why) {
  throw Error(Fault::usage, "usage.deck", option + ": \"" + text + "\": " + why,
              "docs/decks.md says how it is written");
}

bool read_number(const std::string& text, double& value) {
  const char* const end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  return code == std::errc{} && stop == end && std::isfinite(value);
}

bool is_mechanical(DeckKind kind) {
  return kind == DeckKind::statics || kind == DeckKind::modal;
}

}  // namespace

DeckHold read_hold(const std::string& text, DeckKind kind) {
  DeckHold hold;
  const std::size_t equals = text.find('=');
  hold.set = text.substr(0, equals);
  if (hold.set.empty()) refuse("--hold", text, "the name of a set is missing");
  const std::string value = equals == std::string::npos ? "" : text.substr(equals + 1);
  if (is_mechanical(kind)) {
    if (equals == std::string::npos) return hold;
    hold.axes = value;
    if (value.empty() || value.find_first_not_of("xyz") != std::string::npos) {
      refuse("--hold", text, "what follows the sign = are the axes along which nothing moves, such as xz");
    }
  } else if (!read_number(value, hold.value)) {
    refuse("--hold", text,
           std::string("a ") + (kind == DeckKind::heat ? "temperature" : "potential") + " is missing: SET=VALUE");
  }
  return hold;
}

DeckLoad read_load(const std::string& text, DeckKind kind) {
  DeckLoad load;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) refuse("--load", text, "it is not SET=VALUE");
  load.set = text.substr(0, equals);
  for (std::size_t from = equals + 1; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    double number = 0;
    if (!read_number(text.substr(from, comma - from), number)) refuse("--load", text, "a number is missing");
    load.numbers.push_back(number);
    from = comma + 1;
  }
  if (kind == DeckKind::modal) refuse("--load", text, "natural frequencies have no load");
  const bool is_force = kind == DeckKind::statics && load.numbers.size() == 3;
  if (load.numbers.size() != 1 && !is_force) {
    refuse("--load", text,
           kind == DeckKind::statics ? "give a pressure, or the three parts of a force" : "give one number");
  }
  return load;
}

const char* deck_word(DeckKind kind) {
  switch (kind) {
    case DeckKind::statics:
      return "static";
    case DeckKind::modal:
      return "modal";
    case DeckKind::heat:
      return "heat";
    case DeckKind::electro:
      return "electro";
    default:
      return "none";
  }
}

}  // namespace scantet
