// A function of x, y and z given as text.
#pragma once

#include <array>
#include <string>
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
  exponential,
  logarithm,
  square_root,
  absolute,
  minimum,
  maximum
};

/// One step of the evaluation on a stack.
struct Step {
  Operation operation;
  double value = 0;  ///< of a constant
  int exponent = 0;  ///< of a power
};

/// Evaluates on doubles, on intervals and on slopes with the same steps. Immutable, so safe to use from many threads;
/// evaluating allocates nothing.
class Formula {
 public:
  /// A formula may need this many intermediate results at once.
  static constexpr std::size_t kMostPending = 32;

  /// text: numbers, x, y, z, pi, + - * / and ^ with a whole exponent, parentheses, and the functions sin, cos, exp,
  /// log, sqrt, abs (one argument), min, max (two or more). Throws scantet::Error: input.formula, naming the character
  /// at which the mistake is.
  explicit Formula(const std::string& text);

  double operator()(double x, double y, double z) const;
  Interval operator()(const Interval& x, const Interval& y, const Interval& z) const;
  Slope operator()(const Slope& x, const Slope& y, const Slope& z) const;

 private:
  std::vector<Step> steps_;
};

/// What parsing makes of the text; throws as Formula does.
std::vector<Step> parse_formula(const std::string& text);

/// Runs steps that use no more than Formula::kMostPending places of the stack.
double evaluate(const std::vector<Step>& steps, double x, double y, double z);

}  // namespace implicit
