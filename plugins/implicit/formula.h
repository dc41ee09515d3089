// A function of x, y and z given as text.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "slope.h"

namespace implicit {

enum class Operation {
  x,
  y,
  z,
  constant,
  negate,
  add,
  subtract,
  multiply,
  divide,
  power,
  sine,
  cosine,
  sine_and_cosine,  ///< of one operand, which is cheaper than each alone
  exponential,
  logarithm,
  square_root,
  absolute,
  minimum,
  maximum
};

/// A number in a formula: a variable, a constant, or what an operation makes of earlier terms.
struct Term {
  Operation operation;
  std::size_t first = 0;   ///< operand, an index
  std::size_t second = 0;  ///< the same; 0 with one operand
  double value = 0;        ///< of a constant
  int exponent = 0;        ///< of a power
};
struct Terms {
  std::vector<Term> all;  ///< each after its operands; some may not be needed
  std::size_t whole = 0;  ///< the formula's value
};

/// One step of the evaluation, on numbers in numbered places: x, y and z in the first three.
struct Step {
  Operation operation;
  std::uint8_t first, second;  ///< of the operands
  std::uint8_t result;
  std::uint8_t cosine;  ///< of sine_and_cosine, whose sine goes to `result`
  int exponent;
  double value;
};
struct Program {
  static constexpr std::size_t kMostPlaces = 64;
  std::vector<Step> steps;
  std::uint8_t result = 0;  ///< the place of the formula's value
};

/// Evaluates on doubles, on intervals and on intervals with derivatives, with the same steps. Immutable, so safe to use
/// from many threads; evaluating allocates nothing.
class Formula {
 public:
  /// A formula may need this many intermediate results at once.
  static constexpr std::size_t kMostPending = 32;

  /// text: numbers, x, y, z, pi, + - * / and ^ with a whole exponent, parentheses, and the functions sin, cos, exp,
  /// log, sqrt, abs (one argument), min, max (two or more). Throws scantet::Error: input.formula, naming the character
  /// at which the mistake is.
  explicit Formula(const std::string& text);
  explicit Formula(Program program) : program_(std::move(program)) {}

  double operator()(double x, double y, double z) const;
  Interval operator()(const Interval& x, const Interval& y, const Interval& z) const;
  Slope operator()(const Slope& x, const Slope& y, const Slope& z) const;
  Slopes operator()(const Slopes& x, const Slopes& y, const Slopes& z) const;

 private:
  Program program_;
};

/// What parsing makes of the text; throws as Formula does. shared: equal terms are one.
Terms parse_formula(const std::string& text, bool shared);

/// The steps to the whole of the terms; none if they need more places than there are.
std::optional<Program> lay_out(const Terms& terms);

std::size_t operands(Operation operation);

/// What an operation makes of constants.
double evaluate(const Term& term, double first, double second);

}  // namespace implicit
