// Formulas: values against the compiler's, mistakes against their places.
#include "formula.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "scantet/base/error.h"

namespace implicit {
namespace {

using Compiled = std::function<double(double, double, double)>;

TEST(Formula, ComesToWhatItSays) {
  const std::vector<std::pair<std::string, Compiled>> cases{
      {"1 + 2*3", [](double, double, double) { return 7; }},
      {"x - y - z", [](double x, double y, double z) { return x - y - z; }},
      {"x / y / z", [](double x, double y, double z) { return x / y / z; }},
      {"-x^2", [](double x, double, double) { return -(x * x); }},
      {"2^3^2", [](double, double, double) { return 512; }},
      {"2*-x", [](double x, double, double) { return -2 * x; }},
      {"x^-2", [](double x, double, double) { return 1 / (x * x); }},
      {"--x + +y", [](double x, double y, double) { return x + y; }},
      {"(x + y) * z", [](double x, double y, double z) { return (x + y) * z; }},
      {"min(x, y, z) + max(x, y)",
       [](double x, double y, double z) {
         return std::min({x, y, z}) + std::max(x, y);
       }},
      {"sin(x) + cos(y) * exp(z)",
       [](double x, double y, double z) { return std::sin(x) + std::cos(y) * std::exp(z); }},
      {"log(abs(x)) - sqrt(abs(y))",
       [](double x, double y, double) { return std::log(std::abs(x)) - std::sqrt(std::abs(y)); }},
      {"pi*1.5e-2*.5", [](double, double, double) { return std::numbers::pi * 1.5e-2 * .5; }},
      {" x\t+ 3 ^ 2 ", [](double x, double, double) { return x + 9; }},
      {"y", [](double, double y, double) { return y; }},
      {"1/(0*-1) + x", [](double, double, double) { return -kInfinity; }},
      {"cos(x + y) / (sin(x + y) - (x + y)) + cos(y + x)",
       [](double x, double y, double) { return std::cos(x + y) / (std::sin(x + y) - (x + y)) + std::cos(y + x); }},
      {"(x - y)^3 + z/(x - y)^3 - (x - y)",
       [](double x, double y, double z) {
         const double d = x - y;
         return d * (d * d) + z / (d * (d * d)) - d;
       }},
  };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-3, 3);
  for (const auto& [text, compiled] : cases) {
    const Formula formula(text);
    for (int i = 0; i < 100; ++i) {
      const double x = number(random);
      const double y = number(random);
      const double z = number(random);
      EXPECT_DOUBLE_EQ(formula(x, y, z), compiled(x, y, z)) << text;
    }
  }
}

TEST(Formula, MoreSharedTermsThanPlaces) {
  std::string sines;
  std::string multiples;
  constexpr int kTerms = 2 * Program::kMostPlaces;
  for (int i = 1; i <= kTerms; ++i) {
    const std::string sine = "sin(x + " + std::to_string(i) + ")";
    sines += sine + " + ";
    multiples += (i > 1 ? " + " : "") + ("y*" + sine);
  }
  EXPECT_FALSE(lay_out(parse_formula(sines + multiples, true)));
  double sum = 0;
  for (int i = 1; i <= kTerms; ++i) sum += std::sin(0.3 + i);
  EXPECT_NEAR(Formula(sines + multiples)(0.3, 0.7, 0), 1.7 * sum, 1e-12);
}

TEST(Formula, EqualTermsAreComputedOnce) {
  const auto steps = [](const std::string& text) { return lay_out(parse_formula(text, true))->steps.size(); };
  EXPECT_EQ(steps("x*y"), 1u);
  EXPECT_EQ(steps("x*y + x*y"), 2u);
  EXPECT_EQ(steps("sin(x) - cos(x)"), 2u);
  EXPECT_EQ(steps("sin(x) - cos(y)"), 3u);
  EXPECT_EQ(steps("2^3^2 + 1"), 1u);
}

TEST(Formula, MistakesAreNamedWithTheirPlace) {
  const std::vector<std::tuple<std::string, int, std::string>> mistakes{
      {"", 1, "ends where"},
      {"x +", 4, "ends where"},
      {"x + * y", 5, "not \"*\""},
      {"2x", 2, "\"x\" is not expected"},
      {"(x + y", 7, "\")\" is missing"},
      {"x + y)", 6, "\")\" is not expected"},
      {"sni(x)", 1, "did you mean sin?"},
      {"x + w", 5, "\"w\" is not known"},
      {"sin x", 5, "\"(\" is missing"},
      {"sin(x, y)", 6, "\")\" is missing"},
      {"x + max(y)", 5, "two arguments"},
      {"x^0.5", 3, "whole number"},
      {"x^y", 3, "whole number"},
      {"x^100", 3, "whole number"},
      {"x^(1/0)", 3, "whole number"},
      {"1e999", 1, "not a number"},
      {"x + .", 5, "not a number"},
      {"x # y", 3, "\"#\" is not expected"},
      {std::string(1000, '('), 201, "nested too deeply"},
      {std::string(1000, '-') + "x", 201, "nested too deeply"},
  };
  for (const auto& [text, at, says] : mistakes) {
    try {
      const Formula formula(text);
      ADD_FAILURE() << text << " was taken";
    } catch (const scantet::Error& error) {
      const std::string what = error.what();
      EXPECT_EQ(error.code(), "input.formula") << what;
      EXPECT_NE(what.find("character " + std::to_string(at) + ": "), std::string::npos) << what;
      EXPECT_NE(what.find(says), std::string::npos) << what;
    }
  }
}

TEST(Formula, WhatNeedsTooManyPlacesIsRefused) {
  std::string text = "x";
  for (int i = 0; i < 40; ++i) text = "x*(y+" + text + ")";
  EXPECT_THROW(Formula{text}, scantet::Error);
  text = "x";
  for (int i = 0; i < 40; ++i) text = "(" + text + "+y)*x";
  EXPECT_NO_THROW(Formula{text});
}

}  // namespace
}  // namespace implicit
