// One loop over the steps serves the three kinds of numbers; which sin or + is meant, overloading decides.
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
  return {{value, value}, {0, 0}};
}

template <class Number>
Number run(const std::vector<Step>& steps, const Number& x, const Number& y, const Number& z) {
  using std::abs;
  using std::cos;
  using std::exp;
  using std::log;
  using std::sin;
  using std::sqrt;
  std::array<Number, Formula::kMostPending> stack;
  Number* end = stack.data();  // one past the top
  for (const Step& step : steps) {
    switch (step.operation) {
      case Operation::x:
        *end++ = x;
        break;
      case Operation::y:
        *end++ = y;
        break;
      case Operation::z:
        *end++ = z;
        break;
      case Operation::constant:
        *end++ = constant<Number>(step.value);
        break;
      case Operation::negate:
        end[-1] = -end[-1];
        break;
      case Operation::add:
        --end, end[-1] = end[-1] + *end;
        break;
      case Operation::subtract:
        --end, end[-1] = end[-1] - *end;
        break;
      case Operation::multiply:
        --end, end[-1] = end[-1] * *end;
        break;
      case Operation::divide:
        --end, end[-1] = end[-1] / *end;
        break;
      case Operation::power:
        end[-1] = power(end[-1], step.exponent);
        break;
      case Operation::sine:
        end[-1] = sin(end[-1]);
        break;
      case Operation::cosine:
        end[-1] = cos(end[-1]);
        break;
      case Operation::exponential:
        end[-1] = exp(end[-1]);
        break;
      case Operation::logarithm:
        end[-1] = log(end[-1]);
        break;
      case Operation::square_root:
        end[-1] = sqrt(end[-1]);
        break;
      case Operation::absolute:
        end[-1] = abs(end[-1]);
        break;
      case Operation::minimum:
        --end, end[-1] = smaller(end[-1], *end);
        break;
      case Operation::maximum:
        --end, end[-1] = larger(end[-1], *end);
        break;
    }
  }
  return end[-1];
}

}  // namespace

Formula::Formula(const std::string& text) : steps_(parse_formula(text)) {}

double Formula::operator()(double x, double y, double z) const {
  return run(steps_, x, y, z);
}
Interval Formula::operator()(const Interval& x, const Interval& y, const Interval& z) const {
  return run(steps_, x, y, z);
}
Slope Formula::operator()(const Slope& x, const Slope& y, const Slope& z) const {
  return run(steps_, x, y, z);
}

double evaluate(const std::vector<Step>& steps, double x, double y, double z) {
  return run(steps, x, y, z);
}

}  // namespace implicit
