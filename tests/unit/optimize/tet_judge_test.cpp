#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "scantet/optimize/tet_judge_impl.h"
#include "scantet/quality/measures.h"

namespace scantet::optimize {
namespace {

using Corners4 = std::array<Point, 4>;

double sharpness(const TetJudge& judge, const Corners4& p) {
  return judge.sharpness(p[0], p[1], p[2], p[3]);
}

/// Tets of all shapes with corners in the unit cube, positively oriented.
std::vector<Corners4> random_tets(std::size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(0, 1);
  std::vector<Corners4> tets;
  while (tets.size() < count) {
    Corners4 p;
    for (Point& corner : p) corner = {coordinate(random), coordinate(random), coordinate(random)};
    const double volume_mm3 = measure_tet(p[0], p[1], p[2], p[3]).volume_mm3;
    if (std::abs(volume_mm3) < 1e-3) continue;
    if (volume_mm3 < 0) std::swap(p[2], p[3]);
    tets.push_back(p);
  }
  return tets;
}

double squared(double x) {
  return x * x;
}

class Judged : public testing::Test {
 protected:
  UniformSize size_{0.6};
  ElementBounds bounds_{20, 140, 0.2, RuleTarget{{1, 1, 1.5, std::nullopt, 1}, &size_}};
  TetJudge judge_{bounds_};
  std::vector<Corners4> tets_ = random_tets(2000);
};

TEST_F(Judged, SharesAreThoseOfTheMeasures) {
  for (const Corners4& p : tets_) {
    const TetMeasures m = measure_tet(p[0], p[1], p[2], p[3]);
    const TetShares shares = judge_.shares(p[0], p[1], p[2], p[3]);
    const auto expect_share = [](double share, double expected) { EXPECT_NEAR(share, expected, 1e-6 * expected); };
    const auto [least, most] = std::minmax_element(m.dihedral_deg.begin(), m.dihedral_deg.end());
    const auto squared_sine = [](double degrees) { return squared(std::sin(degrees * std::numbers::pi / 180)); };
    if (*least < 90) expect_share(shares.min_dihedral, squared_sine(*least) / squared_sine(20));
    if (*most > 90) expect_share(shares.max_dihedral, squared_sine(*most) / squared_sine(140));
    expect_share(shares.scaled_jacobian, squared(m.scaled_jacobian / 0.2));
    expect_share(shares.radius_edge, squared(1.5 / m.radius_edge));
    expect_share(shares.size, squared(0.6 / m.circumradius_mm));
  }
}

TEST_F(Judged, SmallTetsMayHaveLargerRatios) {
  const UniformSize size(1.2);
  const FinerSize field(std::make_shared<UniformSize>(1.2), {});
  for (const SizingField* sizes : {static_cast<const SizingField*>(&size), static_cast<const SizingField*>(&field)}) {
    const ElementBounds strict_bounds{0, 180, 0, RuleTarget{{1, 1, 1, std::nullopt, 1}, sizes}};
    ElementBounds bounds = strict_bounds;
    bounds.rules->bounds.small_slack = 1.25;
    const TetJudge strict(strict_bounds);
    const TetJudge judge(bounds);
    int better = 0;
    for (const Corners4& p : tets_) {
      const double ratio_share = strict.shares(p[0], p[1], p[2], p[3]).radius_edge;
      const bool gains = measure_tet(p[0], p[1], p[2], p[3]).circumradius_mm < 0.6 && ratio_share < 1;
      const TetShares shares = judge.shares(p[0], p[1], p[2], p[3]);
      EXPECT_NEAR(shares.radius_edge, (gains ? squared(1.25) : 1) * ratio_share, 1e-9 * ratio_share);
      EXPECT_EQ(judge.keeps_all(p[0], p[1], p[2], p[3]), shares.least() >= 1);
      better += gains ? 1 : 0;
    }
    EXPECT_GT(better, 100);
  }
}

TEST_F(Judged, TetsThatKeepAllAreAsSharpAsTheBound) {
  int kept = 0;
  for (const Corners4& p : tets_) {
    const bool keeps = judge_.keeps_all(p[0], p[1], p[2], p[3]);
    kept += keeps ? 1 : 0;
    EXPECT_EQ(keeps, judge_.shares(p[0], p[1], p[2], p[3]).least() >= 1);
    if (keeps) {
      EXPECT_EQ(sharpness(judge_, p), judge_.bound());
    } else {
      EXPECT_GT(sharpness(judge_, p), judge_.bound());
      EXPECT_LT(sharpness(judge_, p), kInverted);
    }
  }
  EXPECT_GT(kept, 10);
  EXPECT_LT(kept, 1500);
}

TEST_F(Judged, TheWorstShareCounts) {
  for (const Corners4& p : tets_) {
    const double least = std::min(judge_.shares(p[0], p[1], p[2], p[3]).least(), 1.0);
    EXPECT_NEAR(sharpness(judge_, p), judge_.sharpness_of_share(least), 1e-6);
  }
}

TEST_F(Judged, SaysOnlyThatATetIsTooSharpWhereThatWillDo) {
  constexpr double kTooSharp = 0.95;
  for (const Corners4& p : tets_) {
    const double exact = sharpness(judge_, p);
    const double limited = judge_.sharpness(p[0], p[1], p[2], p[3], kTooSharp);
    if (exact < kTooSharp) {
      EXPECT_EQ(limited, exact);
    } else {
      EXPECT_GE(limited, kTooSharp);
    }
  }
}

TEST_F(Judged, InvertedTetsAreTheSharpest) {
  for (Corners4 p : tets_) {
    std::swap(p[0], p[1]);
    EXPECT_EQ(sharpness(judge_, p), kInverted);
    EXPECT_FALSE(judge_.keeps_all(p[0], p[1], p[2], p[3]));
    EXPECT_LT(judge_.shares(p[0], p[1], p[2], p[3]).least(), 0);
  }
}

TEST_F(Judged, WhoAsksForNothingSeesAnglesAlone) {
  const TetJudge judge;
  for (const Corners4& p : tets_) EXPECT_EQ(sharpness(judge, p), tet_sharpness(p[0], p[1], p[2], p[3]));
}

// A size that is the same everywhere is compared without asking the field.
TEST_F(Judged, AFieldOfOneSizeIsLikeThatSize) {
  const FinerSize field(std::make_shared<UniformSize>(0.6), {});
  ElementBounds bounds = bounds_;
  bounds.rules->size = &field;
  const TetJudge judge(bounds);
  for (const Corners4& p : tets_) {
    EXPECT_EQ(judge.keeps_all(p[0], p[1], p[2], p[3]), judge_.keeps_all(p[0], p[1], p[2], p[3]));
    EXPECT_NEAR(sharpness(judge, p), sharpness(judge_, p), 1e-9);
  }
}

}  // namespace
}  // namespace scantet::optimize
