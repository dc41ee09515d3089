// What the grid says of a point or a segment is true of the formula on doubles.
#include "formula_grid.h"

#include <gtest/gtest.h>

#include <random>

namespace implicit {
namespace {

using scantet::CubeState;
using scantet::Point;

const std::vector<std::string> kFormulas{"x^2 + y^2 + z^2 - 1",
                                         "sin(3*x) * cos(2*y) + z/3",
                                         "max(abs(x), abs(y), abs(z)) - 1",
                                         "(x - 0.3)^9 * (y - 0.9) - 1e-9*z",
                                         "exp(x*y) - 1.5 - z^3",
                                         "sqrt(x^2 + y^2) - 0.7",
                                         "(x + 1e6) - 1e6 - y",
                                         "1e-60*(x^2 - y)",
                                         "1e60*(x^2 - y)",
                                         "1/x + y",
                                         "sqrt(x) - 0.5*z",
                                         "log(x^2 + y^2)"};

class FormulaGridOf : public testing::TestWithParam<std::string> {
 protected:
  Point random_point() {
    std::uniform_real_distribution<double> coordinate(-1.7, 1.7);
    return {coordinate(random_), coordinate(random_), coordinate(random_)};
  }
  double value_at(const Point& p) const { return formula_(p.x, p.y, p.z); }
  std::size_t cube_at(const Point& p) const { return grid_.clear().grid().index(grid_.clear().at(p).cube); }

  std::mt19937 random_{7};
  Formula formula_{GetParam()};
  FormulaGrid grid_{formula_, {{-1.75, -1.75, -1.75}, {1.75, 1.75, 1.75}}};
};

TEST_P(FormulaGridOf, ValuesAreWithinTheModels) {
  for (int i = 0; i < 100'000; ++i) {
    const Point p = random_point();
    const double value = value_at(p);
    const CubeState state = grid_.clear().at(p).state;
    if (state != CubeState::near) {
      EXPECT_EQ(state == CubeState::inside, value < 0) << i;
      continue;
    }
    const Interval values = grid_.model(cube_at(p)).values_at(p);
    EXPECT_FALSE(value < values.lo || value > values.hi || (std::isnan(value) && values.excludes_zero()))
        << i << ": " << value << " is not in " << values.lo << " to " << values.hi;
  }
}

TEST_P(FormulaGridOf, ChangesAreWithinTheModels) {
  for (int i = 0; i < 100'000; ++i) {
    const Point p = random_point();
    const Point q = p + 0.01 * random_point();
    const std::size_t cube = cube_at(p);
    if (grid_.clear().at(p).state != CubeState::near || cube_at(q) != cube) continue;
    const CubeModel& model = grid_.model(cube);
    const Interval change = model.change_along(q - p);
    const double rounding = model.high - model.low;
    EXPECT_FALSE(value_at(q) - value_at(p) < change.lo - rounding) << i;
    EXPECT_FALSE(value_at(q) - value_at(p) > change.hi + rounding) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Formulas, FormulaGridOf, testing::ValuesIn(kFormulas),
                         [](const auto& test) { return "N" + std::to_string(test.index); });

TEST(FormulaGrid, AFewQuestionsAreLeftOpen) {
  const Formula sphere("x^2 + y^2 + z^2 - 1");
  const FormulaGrid grid(sphere, {{-1.75, -1.75, -1.75}, {1.75, 1.75, 1.75}});
  std::mt19937 random{7};
  std::uniform_real_distribution<double> coordinate(-1.7, 1.7);
  int near = 0;
  int open = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Point p{coordinate(random), coordinate(random), coordinate(random)};
    const scantet::ClearanceGrid::Place place = grid.clear().at(p);
    if (place.state != CubeState::near) continue;
    ++near;
    open += grid.model(grid.clear().grid().index(place.cube)).values_at(p).excludes_zero() ? 0 : 1;
  }
  EXPECT_GT(near, 1000);
  EXPECT_LT(open, near / 20);
}

}  // namespace
}  // namespace implicit
