// Read from the left by one function a rule of the grammar. What is no word with parentheses is a half-space, which is
// read as cuts are; it ends where a joining word or a parenthesis comes.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "scantet/base/ascii_text.h"
#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/cuts/cut_text.h"
#include "scantet/places/place.h"

namespace scantet {
namespace {

struct Shape {
  const char* word;
  Place::Kind kind;
  std::size_t numbers;
  const char* form;
};

constexpr std::array kShapes{
    Shape{"box", Place::Kind::box, 6, "box(x, y, z, x, y, z), two corners opposite each other, mm"},
    Shape{"ball", Place::Kind::ball, 4, "ball(x, y, z, radius), mm"},
    Shape{"cylinder", Place::Kind::cylinder, 7, "cylinder(x, y, z, x, y, z, radius), the ends of its axis, mm"},
    Shape{"normal", Place::Kind::normal, 4, "normal(x, y, z, angle), a direction and degrees"},
    Shape{"nearest", Place::Kind::nearest, 4, "nearest(how many, x, y, z), mm"},
};

struct Name {
  const char* word;
  Place::Kind kind;
  const char* form;
};

constexpr std::array kNames{
    Name{"region", Place::Kind::region, "region(name or number)"},
    Name{"label", Place::Kind::region, "label(name or number)"},
    Name{"patch", Place::Kind::patch, "patch(name)"},
    Name{"curve", Place::Kind::curve, "curve(name), or curve() for all"},
    Name{"border", Place::Kind::border, "border(left), or right, anterior, posterior, superior, inferior"},
    Name{"set", Place::Kind::set, "set(name)"},
    Name{"scan", Place::Kind::above, "scan(\"file\") > value"},
};

constexpr std::array kSides{"left", "right", "anterior", "posterior", "superior", "inferior"};

bool is_word_char(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

class PlaceReader {
 public:
  PlaceReader(const std::string& option, const std::string& text, std::size_t from)
      : option_(option), text_(text), at_(from) {}

  Place read() {
    Place place = read_any_of();
    skip_blanks();
    if (at_ < text_.size()) {
      fail(at_, text_[at_] == ')' ? "this parenthesis was not opened" : "\"and\", \"or\" or \"minus\" is missing here");
    }
    return place;
  }

 private:
  [[noreturn]] void fail(std::size_t at, const std::string& why) const {
    throw Error(Fault::usage, "usage.place",
                option_ + ": \"" + text_ + "\", column " + std::to_string(at + 1) + ": " + why,
                "docs/places.md says how places are written");
  }

  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }

  char next() {
    skip_blanks();
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  /// The word that begins at a place of the text; empty if none does.
  std::string word_at(std::size_t at) const {
    std::size_t end = at;
    while (end < text_.size() && is_word_char(text_[end])) ++end;
    return text_.substr(at, end - at);
  }

  bool take_word(const std::string& word, char sign) {
    const char c = next();
    if (c != '\0' && c == sign) {
      ++at_;
      return true;
    }
    if (word_at(at_) != word) return false;
    at_ += word.size();
    return true;
  }

  Place read_any_of() {
    Place first = read_all_of();
    if (!take_word("or", '|')) return first;
    Place any;
    any.kind = Place::Kind::any_of;
    any.parts.push_back(std::move(first));
    do {
      any.parts.push_back(read_all_of());
    } while (take_word("or", '|'));
    return any;
  }

  Place read_all_of() {
    Place all;
    all.kind = Place::Kind::all_of;
    all.parts.push_back(read_one());
    while (true) {
      if (take_word("and", '&')) {
        all.parts.push_back(read_one());
      } else if (take_word("minus", '\0')) {
        all.parts.push_back(complement_of(read_one()));
      } else {
        break;
      }
    }
    if (all.parts.size() > 1) return all;
    Place only = std::move(all.parts.front());
    return only;
  }

  static Place complement_of(Place of) {
    Place place;
    place.kind = Place::Kind::not_in;
    place.parts.push_back(std::move(of));
    return place;
  }

  Place read_one() {
    if (take_word("not", '!')) {
      const Depth depth(*this);
      return complement_of(read_one());
    }
    const char c = next();
    if (c == '\0') fail(at_, "a place is missing at the end");
    if (c == '(') {
      const Depth depth(*this);
      ++at_;
      Place place = read_any_of();
      if (next() != ')') fail(at_, "a closing parenthesis is missing");
      ++at_;
      return place;
    }
    const std::string word = word_at(at_);
    std::size_t after = at_ + word.size();
    while (after < text_.size() && text_[after] == ' ') ++after;
    if (!word.empty() && after < text_.size() && text_[after] == '(') return read_call(word, after);
    if (word == "all" || word == "everything") {
      at_ += word.size();
      return {};
    }
    return read_half_space();
  }

  /// Guards against texts of nothing but parentheses.
  struct Depth {
    explicit Depth(PlaceReader& of) : reader(of) {
      constexpr int kMost = 100;
      if (++reader.depth_ > kMost) reader.fail(reader.at_, "places are nested too deeply");
    }
    ~Depth() { --reader.depth_; }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;
    PlaceReader& reader;
  };

  Place read_call(const std::string& word, std::size_t parenthesis) {
    const std::size_t start = at_;
    at_ = parenthesis + 1;
    for (const Shape& shape : kShapes) {
      if (word == shape.word) return read_shape(shape, start);
    }
    for (const Name& name : kNames) {
      if (word != name.word) continue;
      Place place = read_name(name, start);
      return word == std::string("scan") ? read_threshold(std::move(place)) : place;
    }
    std::vector<std::string> known;
    known.reserve(std::size(kShapes) + std::size(kNames));
    for (const Shape& shape : kShapes) known.emplace_back(shape.word);
    for (const Name& name : kNames) known.emplace_back(name.word);
    const auto meant = closest_name(word, known);
    std::string list;
    for (const std::string& each : known) list += (list.empty() ? "" : ", ") + each;
    fail(start, "\"" + word + "\" is no place; " + (meant ? "did you mean " + *meant + "?" : "there are " + list));
  }

  Place read_shape(const Shape& shape, std::size_t start) {
    Place place;
    place.kind = shape.kind;
    while (true) {
      place.numbers.push_back(read_number());
      if (next() != ',') break;
      ++at_;
    }
    if (next() != ')') fail(at_, std::string("a comma or a closing parenthesis is missing: ") + shape.form);
    ++at_;
    if (place.numbers.size() != shape.numbers) {
      fail(start, std::to_string(place.numbers.size()) + " numbers instead of " + std::to_string(shape.numbers) + ": " +
                      shape.form);
    }
    check_shape(place, start);
    return place;
  }

  void check_shape(Place& place, std::size_t start) const {
    std::vector<double>& n = place.numbers;
    const auto is_zero = [&n](std::size_t i) { return n[i] == 0 && n[i + 1] == 0 && n[i + 2] == 0; };
    if (place.kind == Place::Kind::box) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (n[i] > n[i + 3]) std::swap(n[i], n[i + 3]);
      }
    }
    if (place.kind == Place::Kind::ball && !(n[3] > 0)) fail(start, "the radius is not greater than 0");
    if (place.kind == Place::Kind::cylinder) {
      if (!(n[6] > 0)) fail(start, "the radius is not greater than 0");
      if (n[0] == n[3] && n[1] == n[4] && n[2] == n[5]) fail(start, "the ends of the axis are the same point");
    }
    if (place.kind == Place::Kind::normal) {
      if (is_zero(0)) fail(start, "the direction is 0");
      constexpr double kStraight = 180;
      if (!(n[3] > 0 && n[3] <= kStraight)) fail(start, "the angle is not above 0 and up to 180 degrees");
    }
    if (place.kind == Place::Kind::nearest && !(n[0] >= 1 && n[0] == std::floor(n[0]))) {
      fail(start, "how many is not a whole number from 1 on");
    }
  }

  double read_number() {
    skip_blanks();
    const std::size_t start = at_;
    if (at_ < text_.size() && text_[at_] == '+') ++at_;
    double value = 0;
    const auto [stop, code] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (code != std::errc{} || !std::isfinite(value)) fail(start, "a number is missing here");
    at_ = static_cast<std::size_t>(stop - text_.data());
    return value;
  }

  Place read_name(const Name& form, std::size_t start) {
    Place place;
    place.kind = form.kind;
    const char quote = next();
    if (quote == '"' || quote == '\'') {
      const std::size_t end = text_.find(quote, at_ + 1);
      if (end == std::string::npos) fail(at_, "the name that begins here has no closing quote");
      place.name = text_.substr(at_ + 1, end - at_ - 1);
      at_ = end + 1;
    } else {
      const std::size_t end = std::min(text_.find(')', at_), text_.size());
      place.name = text_.substr(at_, end - at_);
      while (!place.name.empty() && place.name.back() == ' ') place.name.pop_back();
      at_ = end;
    }
    if (next() != ')') fail(at_, std::string("a closing parenthesis is missing: ") + form.form);
    ++at_;
    if (place.name.empty() && form.kind != Place::Kind::curve) {
      fail(start, std::string("a name is missing: ") + form.form);
    }
    if (form.kind == Place::Kind::border && std::find(kSides.begin(), kSides.end(), place.name) == kSides.end()) {
      fail(start, "\"" + place.name + "\" is no side: " + form.form);
    }
    return place;
  }

  /// What follows scan("file").
  Place read_threshold(Place place) {
    const char sign = next();
    if (sign != '<' && sign != '>') fail(at_, "< or > and a value are missing: scan(\"file\") > value");
    ++at_;
    if (at_ < text_.size() && text_[at_] == '=') ++at_;
    place.kind = sign == '>' ? Place::Kind::above : Place::Kind::below;
    place.numbers.push_back(read_number());
    return place;
  }

  /// A half-space, up to a joining word, a sign or a parenthesis.
  Place read_half_space() {
    const std::size_t start = at_;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == ')' || c == '(' || c == '|' || c == '&' || c == '!') break;
      const std::string word = at_ > start && !is_word_char(text_[at_ - 1]) ? word_at(at_) : "";
      if (word == "and" || word == "or" || word == "minus") break;
      ++at_;
    }
    const std::string half = text_.substr(start, at_ - start);
    Place place;
    place.kind = Place::Kind::planes;
    if (half.find_first_of("<>") == std::string::npos) {
      fail(start, "no place begins like this; half-spaces are written \"x < 10\", names patch(name), region(name)");
    }
    if (half.find(':') != std::string::npos) fail(start + half.find(':'), "a colon makes no sense here");
    try {
      read_cut(option_, half, place.planes);
    } catch (const Error& error) {
      const std::string what = error.what();
      fail(start, what.substr(std::min(what.size(), option_.size() + 2)));
    }
    return place;
  }

  const std::string& option_;
  const std::string& text_;
  std::size_t at_;
  int depth_ = 0;
};

/// What files have the name for, whatever its capitals; empty: nothing.
std::string taken_for(const std::string& any_case) {
  const std::string name = ascii_lower(any_case);
  const auto is_numbered = [&](const std::string& prefix) {
    return name.size() > prefix.size() && name.starts_with(prefix) &&
           name.find_first_not_of("0123456789_", prefix.size()) == std::string::npos;
  };
  if (is_numbered("region_")) return "regions, which have numbers";
  if (is_numbered("boundary_")) return "boundaries, which have the numbers of the regions on either side";
  if (is_numbered("curve_")) return "curves, which have the numbers of the regions around them";
  if (name == "corners") return "the corners where curves meet";
  constexpr std::array kTaken{"all", "nall", "eall", "boundary", "nodes", "mesh", "region", "on_boundary"};
  const bool is_taken = std::find(kTaken.begin(), kTaken.end(), name) != kTaken.end() || name.starts_with("nodes_") ||
                        name.starts_with("elements_");
  return is_taken ? "something else" : "";
}

}  // namespace

Place read_place(const std::string& option, const std::string& text) {
  return PlaceReader(option, text, 0).read();
}

NamedPlace read_named_place(const std::string& option, const std::string& text) {
  const auto refuse = [&](const std::string& why) {
    throw Error(Fault::usage, "usage.place", option + ": \"" + text + "\": " + why,
                "write NAME=PLACE, such as \"foot=z < -40\"; docs/places.md says how places are written");
  };
  NamedPlace named;
  named.text = text;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) refuse("there is no name before a sign =");
  named.name = text.substr(0, equals);
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  if (named.name.empty() || !is_letter(named.name[0]) ||
      !std::all_of(named.name.begin(), named.name.end(), is_word_char)) {
    refuse("a name has letters, digits and _, and begins with a letter");
  }
  constexpr std::size_t kLongest = 60;
  if (named.name.size() > kLongest) refuse("the name is longer than 60 letters");
  const std::string other_use = taken_for(named.name);
  if (!other_use.empty()) refuse("files use the name " + named.name + " for " + other_use);
  std::size_t from = equals + 1;
  while (from < text.size() && text[from] == ' ') ++from;
  constexpr std::array<std::pair<const char*, PlaceItems>, 3> kItems{
      {{"nodes:", PlaceItems::nodes}, {"facets:", PlaceItems::facets}, {"elements:", PlaceItems::elements}}};
  for (const auto& [word, items] : kItems) {
    if (text.compare(from, std::string(word).size(), word) != 0) continue;
    named.items = items;
    from += std::string(word).size();
    break;
  }
  named.place = PlaceReader(option, text, from).read();
  return named;
}

}  // namespace scantet
