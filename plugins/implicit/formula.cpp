// One loop over the steps serves all kinds of numbers; which sin or + is meant, overloading decides.
#include "formula.h"

namespace implicit {
namespace {

double smaller(double a, double b) {
  return std::min(a, b);
}
double larger(double a, double b) {
  return std::max(a, b);
}

template <class Number>
Number constant(double value);
template <>
double constant(double value) {
  return value;
}
template <>
Interval constant(double value) {
  return {value, value};
}
template <>
Slope constant(double value) {
  return {{value, value}, {}};
}
template <>
Slopes constant(double value) {
  return {{value, value}, {}};
}

using std::abs;
using std::cos;
using std::exp;
using std::log;
using std::sin;
using std::sqrt;

/// angle: a copy, for its place may be the sine's.
template <class Number>
void set_sine_and_cosine(const Number angle, Number& sine, Number& cosine) {
  sine = sin(angle);
  cosine = cos(angle);
}

/// Does one step of a program, at the places of its values.
template <class Number>
void take(const Step& step, std::array<Number, Program::kMostPlaces>& at) {
  const Number& a = at[step.first];
  const Number& b = at[step.second];
  Number& to = at[step.result];
  switch (step.operation) {
    case Operation::constant:
      to = constant<Number>(step.value);
      break;
    case Operation::negate:
      to = -a;
      break;
    case Operation::add:
      to = a + b;
      break;
    case Operation::subtract:
      to = a - b;
      break;
    case Operation::multiply:
      to = a * b;
      break;
    case Operation::divide:
      to = a / b;
      break;
    case Operation::power:
      to = power(a, step.exponent);
      break;
    case Operation::sine:
      to = sin(a);
      break;
    case Operation::cosine:
      to = cos(a);
      break;
    case Operation::sine_and_cosine:
      set_sine_and_cosine(a, to, at[step.cosine]);
      break;
    case Operation::exponential:
      to = exp(a);
      break;
    case Operation::logarithm:
      to = log(a);
      break;
    case Operation::square_root:
      to = sqrt(a);
      break;
    case Operation::absolute:
      to = abs(a);
      break;
    case Operation::minimum:
      to = smaller(a, b);
      break;
    case Operation::maximum:
      to = larger(a, b);
      break;
    case Operation::x:
    case Operation::y:
    case Operation::z:
      break;  // in place from the start
  }
}

template <class Number>
Number run(const Program& program, const Number& x, const Number& y, const Number& z) {
  std::array<Number, Program::kMostPlaces> at;
  at[0] = x, at[1] = y, at[2] = z;
  for (const Step& step : program.steps) take(step, at);
  return at[program.result];
}

}  // namespace

Formula::Formula(const std::string& text) {
  std::optional<Program> program = lay_out(parse_formula(text, true));
  if (!program) program = lay_out(parse_formula(text, false));  // no more places than kMostPending and the variables
  program_ = std::move(*program);
}

double Formula::operator()(double x, double y, double z) const {
  return run(program_, x, y, z);
}
Interval Formula::operator()(const Interval& x, const Interval& y, const Interval& z) const {
  return run(program_, x, y, z);
}
Slope Formula::operator()(const Slope& x, const Slope& y, const Slope& z) const {
  return run(program_, x, y, z);
}
Slopes Formula::operator()(const Slopes& x, const Slopes& y, const Slopes& z) const {
  return run(program_, x, y, z);
}

double evaluate(const Term& term, double first, double second) {
  const Program program{{{term.operation, 0, 1, 2, 0, term.exponent, term.value}}, 2};
  return run(program, first, second, 0.0);
}

}  // namespace implicit
