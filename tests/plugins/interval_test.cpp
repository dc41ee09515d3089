// Inclusion: what a formula comes to at points is in what it comes to on intervals that hold them, and its slopes are
// in the interval of slopes.
#include "interval.h"

#include <gtest/gtest.h>

#include <random>

#include "formula.h"

namespace implicit {
namespace {

const std::vector<std::string> kBounded{"x + y - z",
                                        "x * y * z",
                                        "x / y",
                                        "x^2",
                                        "x^3 - y^5",
                                        "x^-3",
                                        "sin(3*x)",
                                        "cos(x*y)",
                                        "exp(x) - y",
                                        "log(x)",
                                        "sqrt(x + y)",
                                        "abs(x - y)",
                                        "min(x, y, z)",
                                        "max(x, -y)",
                                        "x^4 - 5*x^2",
                                        "1/(x^2 + z)",
                                        "sin(x)/x + cos(50*z)",
                                        "exp(-x^2) * sin(1/y)",
                                        "sin(x + 40000)",
                                        "x^64 - y^63",
                                        "exp(400*x) - 1",
                                        "log(x^2)",
                                        "(x - x)*exp(900*y)"};

struct Lane {
  double from, to;
};

bool holds(const Interval& interval, double value) {
  return std::isnan(value) ? interval.lo == -kInfinity && interval.hi == kInfinity
                           : interval.lo <= value && value <= interval.hi;
}

class Inclusion : public testing::TestWithParam<std::string> {
 protected:
  Lane lane() {
    std::uniform_real_distribution<double> middle(-4, 4);
    std::uniform_real_distribution<double> exponent(-14, 1);
    const double from = middle(random_);
    return {from, from + std::pow(10, exponent(random_))};
  }
  double within(const Lane& lane) {
    std::uniform_real_distribution<double> share(0, 1);
    return std::clamp(lane.from + share(random_) * (lane.to - lane.from), lane.from, lane.to);
  }
  std::mt19937 random_{42};
  Formula formula_{GetParam()};
};

TEST_P(Inclusion, OfValues) {
  for (int i = 0; i < 3000; ++i) {
    const Lane x = lane();
    const Lane y = lane();
    const Lane z = lane();
    const Interval all = formula_(Interval{x.from, x.to}, Interval{y.from, y.to}, Interval{z.from, z.to});
    ASSERT_TRUE(all.lo <= all.hi) << all.lo << " " << all.hi;
    for (int k = 0; k < 20; ++k) {
      const double a = within(x);
      const double b = within(y);
      const double c = within(z);
      ASSERT_TRUE(holds(all, formula_(a, b, c)))
          << a << " " << b << " " << c << ": " << formula_(a, b, c) << " is not in " << all.lo << " " << all.hi;
    }
  }
}

// The mean value theorem: (f(b) - f(a)) / (b - a) is a slope somewhere between, up to the rounding of f.
TEST_P(Inclusion, OfSlopes) {
  for (int i = 0; i < 3000; ++i) {
    const Lane x = lane();
    const Lane y = lane();
    const Lane z = lane();
    const auto moving = [&](const Lane& l) {
      const double d = l.to - l.from;
      return Slope{{std::min(l.from, l.to), std::max(l.from, l.to)}, {d, d}};
    };
    const Slope slope = formula_(moving(x), moving(y), moving(z));
    const double first = formula_(x.from, y.from, z.from);
    const double last = formula_(x.to, y.to, z.to);
    if (!std::isfinite(first) || !std::isfinite(last)) continue;
    const Interval rounding = formula_(Interval{x.from, x.from}, Interval{y.from, y.from}, Interval{z.from, z.from}) -
                              formula_(Interval{x.to, x.to}, Interval{y.to, y.to}, Interval{z.to, z.to});
    const double slack = rounding.hi - rounding.lo;
    ASSERT_GE(last - first, slope.rate.lo - slack) << "lane " << i;
    ASSERT_LE(last - first, slope.rate.hi + slack) << "lane " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Formulas, Inclusion, testing::ValuesIn(kBounded),
                         [](const auto& test) { return "N" + std::to_string(test.index); });

TEST(Interval, IsTightWhereItMatters) {
  const Interval square = power(Interval{-1, 2}, 2);
  EXPECT_EQ(square.lo, 0);
  EXPECT_NEAR(square.hi, 4, 1e-12);
  const Interval top = sin(Interval{1, 2});
  EXPECT_EQ(top.hi, 1);
  EXPECT_NEAR(top.lo, std::sin(1.0), 1e-12);
  EXPECT_TRUE((Interval{1, 2} + Interval{3, 4}).excludes_zero());
  EXPECT_FALSE((Interval{1, 1} / Interval{-1, 1}).excludes_zero());
}

}  // namespace
}  // namespace implicit
