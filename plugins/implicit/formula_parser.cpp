// Recursive descent, one function a level of precedence, that writes the steps in the order in which a stack machine
// wants them. Steps on constants alone are carried out at once.
#include <cctype>
#include <charconv>
#include <optional>

#include "formula.h"
#include "scantet/base/error.h"
#include "scantet/base/options.h"

namespace implicit {
namespace {

constexpr int kDeepest = 200;  // parentheses, functions and signs within each other
constexpr int kLargestExponent = 64;

struct Function {
  const char* name;
  Operation operation;
  bool folds;  // takes two arguments or more, two at a time
};
constexpr std::array kFunctions{
    Function{"sin", Operation::sine, false},         Function{"cos", Operation::cosine, false},
    Function{"exp", Operation::exponential, false},  Function{"log", Operation::logarithm, false},
    Function{"sqrt", Operation::square_root, false}, Function{"abs", Operation::absolute, false},
    Function{"min", Operation::minimum, true},       Function{"max", Operation::maximum, true}};

std::size_t operands(Operation operation) {
  switch (operation) {
    case Operation::x:
    case Operation::y:
    case Operation::z:
    case Operation::constant:
      return 0;
    case Operation::add:
    case Operation::subtract:
    case Operation::multiply:
    case Operation::divide:
    case Operation::minimum:
    case Operation::maximum:
      return 2;
    default:
      return 1;
  }
}

class Parser {
 public:
  explicit Parser(const std::string& text) : text_(text) {}

  std::vector<Step> parse() {
    sum();
    if (peek() != '\0') refuse(at_, quoted_rest() + " is not expected here", "is an operator such as * missing?");
    return std::move(steps_);
  }

 private:
  [[noreturn]] void refuse(std::size_t at, const std::string& what, const std::string& remedy) const {
    throw scantet::Error(scantet::Fault::input, "input.formula",
                         "formula \"" + text_ + "\", character " + std::to_string(at + 1) + ": " + what, remedy);
  }
  std::string quoted_rest() const { return std::string("\"") + text_[at_] + "\""; }

  // The next character that is no space; '\0' at the end.
  char peek() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (take(c)) return;
    refuse(at_, std::string("a \"") + c + "\" is missing", "close every parenthesis");
  }

  void emit(const Step& step) {
    const std::size_t needed = operands(step.operation);
    pending_ = pending_ + 1 - needed;
    if (pending_ > Formula::kMostPending) {
      refuse(at_, "the formula is nested too deeply", "write the longer operand of + and * first");
    }
    steps_.push_back(step);
    bool constant = needed > 0;
    for (std::size_t i = 0; i < needed; ++i) {
      constant = constant && steps_[steps_.size() - 2 - i].operation == Operation::constant;
    }
    if (!constant) return;
    const auto first = steps_.end() - static_cast<std::ptrdiff_t>(needed + 1);
    const double value = evaluate({first, steps_.end()}, 0, 0, 0);
    steps_.erase(first, steps_.end());
    steps_.push_back({Operation::constant, value});
  }

  void sum() {
    product();
    while (true) {
      if (take('+')) {
        product();
        emit({Operation::add});
      } else if (take('-')) {
        product();
        emit({Operation::subtract});
      } else {
        return;
      }
    }
  }

  void product() {
    signed_factor();
    while (true) {
      if (take('*')) {
        signed_factor();
        emit({Operation::multiply});
      } else if (take('/')) {
        signed_factor();
        emit({Operation::divide});
      } else {
        return;
      }
    }
  }

  void signed_factor() {
    if (++depth_ > kDeepest) refuse(at_, "the formula is nested too deeply", "write it with fewer parentheses");
    if (take('-')) {
      signed_factor();
      emit({Operation::negate});
    } else if (take('+')) {
      signed_factor();
    } else {
      atom();
      if (take('^')) raise();
    }
    --depth_;
  }

  // After the sign ^. 2^3^2 is 2^(3^2).
  void raise() {
    peek();
    const std::size_t start = at_;
    const std::size_t before = steps_.size();
    signed_factor();
    const Step exponent = steps_.back();
    const bool whole = steps_.size() == before + 1 && exponent.operation == Operation::constant &&
                       exponent.value == std::floor(exponent.value) && std::abs(exponent.value) <= kLargestExponent;
    if (!whole) {
      refuse(start, "the exponent is not a whole number from -64 to 64", "use sqrt(u) or exp(v * log(u)) for others");
    }
    steps_.pop_back();
    --pending_;
    emit({Operation::power, 0, static_cast<int>(exponent.value)});
  }

  void atom() {
    const char c = peek();
    if (take('(')) {
      sum();
      expect(')');
    } else if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') {
      number();
    } else if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      name();
    } else if (c == '\0') {
      refuse(at_, "the formula ends where a number, a variable or a function is expected", "complete it");
    } else {
      refuse(at_, "a number, a variable or a function is expected, not " + quoted_rest(), "see docs/plugins.md");
    }
  }

  void number() {
    double value = 0;
    const char* end = text_.data() + text_.size();
    const auto [stop, code] = std::from_chars(text_.data() + at_, end, value);
    if (code != std::errc{}) refuse(at_, "this is not a number that a double can hold", "write it as 1.5 or 2e-3");
    at_ = static_cast<std::size_t>(stop - text_.data());
    emit({Operation::constant, value});
  }

  void name() {
    const std::size_t start = at_;
    while (at_ < text_.size() && std::isalnum(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    const std::string word = text_.substr(start, at_ - start);
    if (word == "x") return emit({Operation::x});
    if (word == "y") return emit({Operation::y});
    if (word == "z") return emit({Operation::z});
    if (word == "pi") return emit({Operation::constant, std::numbers::pi});
    for (const Function& function : kFunctions) {
      if (word == function.name) return call(function, start);
    }
    std::vector<std::string> names{"x", "y", "z", "pi"};
    for (const Function& function : kFunctions) names.emplace_back(function.name);
    const auto meant = scantet::closest_name(word, names);
    refuse(start, "\"" + word + "\" is not known" + (meant ? "; did you mean " + *meant + "?" : ""),
           "known are x, y, z, pi, sin, cos, exp, log, sqrt, abs, min and max");
  }

  void call(const Function& function, std::size_t start) {
    const std::string name = function.name;
    if (!take('(')) refuse(at_, "a \"(\" is missing after " + name, "write " + name + "(...)");
    sum();
    std::size_t arguments = 1;
    while (function.folds && take(',')) {
      sum();
      emit({function.operation});
      ++arguments;
    }
    if (function.folds && arguments == 1)
      refuse(start, name + " takes two arguments or more", "separate them by commas");
    expect(')');
    if (!function.folds) emit({function.operation});
  }

  const std::string& text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::size_t pending_ = 0;  // places of the stack in use
  std::vector<Step> steps_;
};

}  // namespace

std::vector<Step> parse_formula(const std::string& text) {
  return Parser(text).parse();
}

}  // namespace implicit
