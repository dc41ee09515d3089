#include "scantet/sizing/size_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cancelled_after.h"
#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/domain/analytic.h"
#include "scantet/sizing/size_formula.h"

namespace scantet {
namespace {

GridShape small_grid() {
  return {{-1, 2, 3}, 0.5, {13, 11, 9}};
}

Point node(const GridShape& shape, std::size_t n) {
  const auto i = static_cast<int>(n);
  return shape.at(i % shape.nodes[0], i / shape.nodes[0] % shape.nodes[1], i / shape.nodes[0] / shape.nodes[1]);
}

std::vector<float> random_sizes(const GridShape& shape, unsigned seed, double share_of_small) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> chance(0, 1);
  std::uniform_real_distribution<double> size(0.1, 3);
  std::vector<float> sizes;
  for (std::size_t n = 0; n < shape.count(); ++n) {
    sizes.push_back(chance(random) < share_of_small ? static_cast<float>(size(random)) : 50.0F);
  }
  return sizes;
}

TEST(MakeLipschitz, IsTheInfimumOverAllNodes) {
  const GridShape shape = small_grid();
  double worst = 0;
  for (const double share : {0.005, 0.05, 0.5, 1.0}) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const std::vector<float> given = random_sizes(shape, seed, share);
      std::vector<float> sizes = given;
      make_lipschitz(shape, sizes);
      for (std::size_t n = 0; n < sizes.size(); ++n) {
        double least = 1e9;
        for (std::size_t m = 0; m < sizes.size(); ++m) {
          least = std::min(least, static_cast<double>(given[m]) + distance(node(shape, n), node(shape, m)));
        }
        EXPECT_LE(sizes[n], given[n]);
        EXPECT_GE(static_cast<double>(sizes[n]), least * (1 - 1e-6));
        worst = std::max(worst, static_cast<double>(sizes[n]) - least);
      }
    }
  }
  EXPECT_LE(worst, 0.1 * shape.step_mm);
}

TEST(MakeLipschitz, ThreadsMakeNoDifference) {
  for (const std::array<int, 3> nodes : {std::array{40, 37, 29}, std::array{5, 3, 90}, std::array{7, 80, 2}}) {
    const GridShape shape{{-1, 2, 3}, 0.5, nodes};
    const std::vector<float> sizes = random_sizes(shape, 5, 0.01);
    std::vector<float> one = sizes;
    std::vector<float> many = sizes;
    with_threads(1, [&] { make_lipschitz(shape, one); });
    with_threads(4, [&] { make_lipschitz(shape, many); });
    EXPECT_EQ(one, many);
  }
}

TEST(MakeLipschitz, LeavesLipschitzSizesAlone) {
  const GridShape shape = small_grid();
  std::vector<float> sizes;
  for (std::size_t n = 0; n < shape.count(); ++n) {
    sizes.push_back(static_cast<float>(1 + 0.99 * distance(node(shape, n), {1, 4, 5})));
  }
  const std::vector<float> given = sizes;
  make_lipschitz(shape, sizes);
  EXPECT_EQ(sizes, given);
}

TEST(MakeLipschitz, FillsWhereThereIsNone) {
  const GridShape shape = small_grid();
  std::vector<float> sizes(shape.count(), std::numeric_limits<float>::infinity());
  sizes[shape.index(2, 3, 4)] = 1;
  make_lipschitz(shape, sizes);
  EXPECT_NEAR(sizes[shape.index(12, 10, 0)], 1 + 0.5 * std::sqrt(100.0 + 49 + 16), 1e-4);
}

TEST(MakeLipschitz, CanBeCancelledAtEveryLayer) {
  const GridShape shape = small_grid();
  const std::vector<float> given = random_sizes(shape, 3, 0.1);
  test::CancelledAfter progress(1 + 4);  // asked before each sweep to and fro and at each layer
  std::vector<float> sizes = given;
  make_lipschitz(shape, sizes, progress);
  const auto fifth = static_cast<std::ptrdiff_t>(shape.index(0, 0, 4));
  EXPECT_FALSE(std::equal(sizes.begin(), sizes.begin() + fifth, given.begin()));
  EXPECT_TRUE(std::equal(sizes.begin() + fifth, sizes.end(), given.begin() + fifth));
}

TEST(SizeGrid, IsLipschitzButForItsCells) {
  const GridShape shape = small_grid();
  std::vector<float> sizes = random_sizes(shape, 9, 0.1);
  make_lipschitz(shape, sizes);
  const SizeGrid grid(shape, sizes, 1);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-0.2, 1.2);
  for (int i = 0; i < 20000; ++i) {
    const auto any = [&] { return shape.corner + Vec{6 * place(random), 5 * place(random), 4 * place(random)}; };
    const Point p = any();
    const Point q = any();
    EXPECT_LE(std::abs(grid.size_at(p) - grid.size_at(q)), distance(p, q) + 2 * grid.error_mm());
    EXPECT_GE(grid.size_at(p), grid.min_size());
  }
}

std::shared_ptr<const SizeGrid> grid_of(const Domain& domain, const std::string& formula, double least_mm = 0) {
  SizeGridOptions options;
  options.least_mm = least_mm;
  options.longest_mm = domain.bounds().diagonal();
  options.place = "--size";
  options.text = formula;
  Progress progress;
  return make_size_grid(domain, SizeFormula(formula, "--size"), options, progress);
}

TEST(MakeSizeGrid, IsTheFormulaWithinItsError) {
  const auto sphere = make_sphere({1, 2, 3}, 8);
  const auto grid = grid_of(*sphere, "1 + 0.3*d");
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-8, 8);
  for (int i = 0; i < 5000; ++i) {
    const Vec off{place(random), place(random), place(random)};
    if (length(off) > 8) continue;
    EXPECT_NEAR(grid->size_at(Point{1, 2, 3} + off), 1 + 0.3 * (8 - length(off)), grid->error_mm());
  }
  EXPECT_NEAR(grid->usual_size(), 1, grid->error_mm());
  EXPECT_LT(grid->error_mm(), 0.2);
  EXPECT_TRUE(grid->bounds_tets());
}

TEST(MakeSizeGrid, GradesAJump) {
  const auto sphere = make_sphere({0, 0, 0}, 8);
  const auto grid = grid_of(*sphere, "x < 0 ? 0.5 : 4");
  EXPECT_NEAR(grid->size_at({-3, 0, 0}), 0.5, 1e-6);
  EXPECT_NEAR(grid->size_at({2, 0, 0}), 2.5, grid->error_mm());
  EXPECT_NEAR(grid->size_at({6, 0, 0}), 4, grid->error_mm());
}

TEST(MakeSizeGrid, RaisesAndCutsSizes) {
  const auto sphere = make_sphere({0, 0, 0}, 8);
  const auto grid = grid_of(*sphere, "x < 0 ? 0.01 : 1/0", 1);
  EXPECT_EQ(grid->min_size(), 1);
  EXPECT_LE(grid->size_at({8, 0, 0}), 9 + grid->error_mm());
}

TEST(MakeSizeGrid, RefusesWhatIsNoSizeAndSaysWhere) {
  const auto sphere = make_sphere({0, 0, 0}, 8);
  for (const char* formula : {"x", "0*x", "sqrt(x)", "5 - d"}) {
    try {
      grid_of(*sphere, formula);
      FAIL() << formula;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), "usage.size") << formula;
      EXPECT_NE(std::string(error.what()).find(" mm"), std::string::npos) << error.what();
    }
  }
  EXPECT_NO_THROW(grid_of(*sphere, "abs(x) < 8.1 ? 1 : -1"));  // nobody asks outside
}

TEST(MakeSizeGrid, CanBeCancelledToTheEnd) {
  const auto sphere = make_sphere({0, 0, 0}, 8);
  const auto made = [&](Progress& progress) {
    return make_size_grid(*sphere, UniformSource(1), {0, 30, "--size", "1"}, progress) != nullptr;
  };
  constexpr int kMany = 1'000'000;
  test::CancelledAfter never(kMany);
  EXPECT_TRUE(made(never));
  test::CancelledAfter late(kMany - never.left() - 2);
  EXPECT_FALSE(made(late));
}

TEST(MakeSizeGrid, DoesNotDependOnThreads) {
  const auto torus = make_torus({0, 0, 0}, 8, 3);
  std::vector<double> first;
  for (const std::size_t threads : {1, 2, 8}) {
    std::vector<double> sizes;
    with_threads(threads, [&] {
      const auto grid = grid_of(*torus, "0.5 + 0.4*d + 0.1*abs(z)");
      for (int i = 0; i < 1000; ++i) sizes.push_back(grid->size_at({0.02 * i - 10, 0.011 * i - 5, 0.004 * i - 2}));
    });
    if (first.empty()) first = sizes;
    EXPECT_EQ(sizes, first) << threads;
  }
}

}  // namespace
}  // namespace scantet
