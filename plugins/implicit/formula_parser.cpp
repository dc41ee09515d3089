// Recursive descent, one function a level of precedence, that writes each term after its operands. Operations on
// constants alone are carried out at once.
#include <bit>
#include <cctype>
#include <charconv>
#include <map>
#include <tuple>

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

class Parser {
 public:
  Parser(const std::string& text, bool shared) : text_(text), shared_(shared) {}

  Terms parse() {
    sum();
    if (peek() != '\0') refuse(at_, quoted_rest() + " is not expected here", "is an operator such as * missing?");
    return {std::move(terms_), pending_.back()};
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

  // Takes the operands from what is pending.
  void emit(Term term) {
    const std::size_t count = operands(term.operation);
    if (pending_.size() + 1 - count > Formula::kMostPending) {
      refuse(at_, "the formula is nested too deeply", "write the longer operand of + and * first");
    }
    if (count > 1) term.second = take_pending();
    if (count > 0) term.first = take_pending();
    const auto constant = [&](std::size_t operand) { return terms_[operand].operation == Operation::constant; };
    if (count > 0 && constant(term.first) && (count == 1 || constant(term.second))) {
      term = {Operation::constant, 0, 0, evaluate(term, terms_[term.first].value, terms_[term.second].value)};
    }
    pending_.push_back(index_of(term));
  }

  std::size_t take_pending() {
    const std::size_t last = pending_.back();
    pending_.pop_back();
    return last;
  }

  std::size_t index_of(const Term& term) {
    if (shared_) {
      const auto bits = std::bit_cast<std::uint64_t>(term.value);  // tells 0 and -0 apart
      const auto [known, added] =
          known_.try_emplace({term.operation, term.first, term.second, bits, term.exponent}, terms_.size());
      if (!added) return known->second;
    }
    terms_.push_back(term);
    return terms_.size() - 1;
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
    signed_factor();
    const Term& exponent = terms_[take_pending()];
    const bool whole = exponent.operation == Operation::constant && exponent.value == std::floor(exponent.value) &&
                       std::abs(exponent.value) <= kLargestExponent;
    if (!whole) {
      refuse(start, "the exponent is not a whole number from -64 to 64", "use sqrt(u) or exp(v * log(u)) for others");
    }
    emit({Operation::power, 0, 0, 0, static_cast<int>(exponent.value)});
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
    emit({Operation::constant, 0, 0, value});
  }

  void name() {
    const std::size_t start = at_;
    while (at_ < text_.size() && std::isalnum(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    const std::string word = text_.substr(start, at_ - start);
    if (word == "x") return emit({Operation::x});
    if (word == "y") return emit({Operation::y});
    if (word == "z") return emit({Operation::z});
    if (word == "pi") return emit({Operation::constant, 0, 0, std::numbers::pi});
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
  const bool shared_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::vector<Term> terms_;
  std::vector<std::size_t> pending_;  // terms that are to be operands
  std::map<std::tuple<Operation, std::size_t, std::size_t, std::uint64_t, int>, std::size_t> known_;
};

}  // namespace

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

Terms parse_formula(const std::string& text, bool shared) {
  return Parser(text, shared).parse();
}

}  // namespace implicit
