#include "scantet/sampling/curve_sample.h"

#include <gtest/gtest.h>

#include <set>

#include "scantet/domain/curve.h"
#include "unit/cut_balls.h"
#include "unit/sharp_cube.h"

namespace scantet {
namespace {

CurveSample curve_sample_of(const Domain& domain, double size_mm) {
  return sample_curves(domain, UniformSize(size_mm), 1);
}

/// Neighbours overlap, others do not, and no ball holds the centre of another.
void expect_cover(const CurveSample& sample) {
  std::set<std::array<std::uint32_t, 2>> neighbors;
  for (const CurveSample::Piece& piece : sample.pieces) {
    const auto [a, b] = std::minmax(piece.vertices[0], piece.vertices[1]);
    neighbors.insert({a, b});
  }
  int faults = 0;
  for (std::uint32_t i = 0; i < sample.vertices.size(); ++i) {
    for (std::uint32_t j = 0; j < i; ++j) {
      const CurveVertex& a = sample.vertices[i];
      const CurveVertex& b = sample.vertices[j];
      const double apart = distance(a.point, b.point);
      faults += apart > std::max(a.radius_mm, b.radius_mm) ? 0 : 1;
      faults += (apart < a.radius_mm + b.radius_mm) == (neighbors.count({j, i}) > 0) ? 0 : 1;
    }
  }
  EXPECT_EQ(faults, 0);
}

TEST(CurveSample, OfNoCurvesIsEmpty) {
  class Curveless final : public Domain {
    Box bounds() const override { return {{0, 0, 0}, {1, 1, 1}}; }
    Region region_at(const Point&) const override { return kOutside; }
    void crossings(const Segment&, Crossings& out) const override { out.clear(); }
  };
  EXPECT_TRUE(curve_sample_of(Curveless(), 1).vertices.empty());
}

TEST(CurveSample, IsACoverOfClosedAndOpenCurves) {
  for (const int cells : {2, 3, 4}) {
    for (const double size_mm : {4.0, 1.0, 0.3}) {
      const CurveSample sample = curve_sample_of(test::CutBall(10, cells), size_mm);
      expect_cover(sample);
      EXPECT_TRUE(sample.merged.empty());
    }
  }
  expect_cover(curve_sample_of(test::SharpCube(20), 2));
}

TEST(CurveSample, HasTheCornersFirstAndTheRegionsThatMeet) {
  const CurveSample sample = curve_sample_of(test::CutBall(10, 4), 1);
  ASSERT_GT(sample.vertices.size(), 5U);
  EXPECT_EQ(sample.vertices[0].dimension, 0);
  EXPECT_EQ(sample.vertices[0].regions, (std::vector<Region>{1, 2, 3, 4}));
  EXPECT_EQ(sample.vertices[5].dimension, 1);
  EXPECT_EQ(sample.vertices[5].regions.size(), 3U);
}

TEST(CurveSample, IsAsDenseAsTheSizeAsks) {
  const CurveSample sample = curve_sample_of(test::CutBall(10, 2), 1);
  EXPECT_GE(sample.vertices.size(), 62U);  // 20π at 1 mm
  EXPECT_LE(sample.vertices.size(), 66U);
  for (const CurveVertex& vertex : sample.vertices) EXPECT_LE(vertex.radius_mm, 2.0 / 3);
}

TEST(CurveSample, KeepsItsPointsFarFromWhereTheSizeChanges) {
  const test::CutBall ball(20, 3);
  const auto usual = std::make_shared<UniformSize>(1);
  const Point place = ball.corners()[0].point;
  const CurveSample before = sample_curves(ball, *usual, 1);
  const CurveSample after = sample_curves(ball, FinerSize(usual, {{place, 0.3}}), 1);
  expect_cover(after);
  EXPECT_GT(after.vertices.size(), before.vertices.size());
  std::set<std::array<double, 3>> points;
  for (const CurveVertex& vertex : after.vertices) points.insert({vertex.point.x, vertex.point.y, vertex.point.z});
  std::size_t far = 0;
  std::size_t moved = 0;
  for (const CurveVertex& vertex : before.vertices) {
    if (distance(vertex.point, place) < 14) continue;  // a stretch is 12 long at most, and the size grows over 0.7
    ++far;
    moved += 1 - points.count({vertex.point.x, vertex.point.y, vertex.point.z});
  }
  EXPECT_GT(far, 100U);
  EXPECT_EQ(moved, 0U);
}

/// Two circles around the z axis, so close that they are one at this size.
TEST(CurveSample, MergesWhatIsFarCloserThanTheSize) {
  class Rings final : public Domain {
    Box bounds() const override { return {{-11, -11, -1}, {11, 11, 1}}; }
    Region region_at(const Point&) const override { return kOutside; }
    void crossings(const Segment&, Crossings& out) const override { out.clear(); }
    std::vector<std::shared_ptr<const Curve>> curves() const override {
      const auto ring = [](double radius_mm, std::vector<Region> regions) {
        return std::make_shared<test::Arc>(radius_mm, Vec{1, 0, 0}, Vec{0, 1, 0}, 2 * M_PI, std::move(regions),
                                           std::nullopt);
      };
      return {ring(10, {0, 1, 2}), ring(10.02, {0, 2, 3})};
    }
  };
  const CurveSample sample = curve_sample_of(Rings(), 2);
  EXPECT_FALSE(sample.merged.empty());
  for (std::size_t i = 0; i < sample.vertices.size(); ++i) {
    EXPECT_GT(sample.vertices[i].radius_mm, 0.05);
    for (std::size_t j = 0; j < i; ++j) {
      const double apart = distance(sample.vertices[i].point, sample.vertices[j].point);
      EXPECT_GT(apart, std::max(sample.vertices[i].radius_mm, sample.vertices[j].radius_mm));
    }
  }
}

/// A curve that goes by the corner where it begins, nearer than the size: it is covered there, too.
TEST(CurveSample, CoversACurveThatComesBackToItsCorner) {
  class Spiral final : public Domain {
   public:
    Spiral() {
      for (double turn = 0; turn <= 3 * M_PI; turn += M_PI / 60) {
        const double radius_mm = 4 + 0.2 * turn;
        course_.push_back({-radius_mm * std::cos(turn), radius_mm * std::sin(turn), 0});
      }
    }
    Box bounds() const override { return {{-8, -8, -8}, {8, 8, 8}}; }
    Region region_at(const Point&) const override { return kOutside; }
    void crossings(const Segment&, Crossings& out) const override { out.clear(); }
    std::vector<std::shared_ptr<const Curve>> curves() const override {
      return {std::make_shared<PolylineCurve>(course_, regions_, std::array<std::size_t, 2>{0, 1})};
    }
    std::vector<Corner> corners() const override {
      return {{course_.front(), regions_, ""}, {course_.back(), regions_, ""}};
    }

   private:
    std::vector<Point> course_;
    std::vector<Region> regions_{0, 1, 2};
  };
  const CurveSample sample = curve_sample_of(Spiral(), 4);
  expect_cover(sample);
  EXPECT_TRUE(sample.merged.empty());
}

/// A rim that turns around in a right angle, 0.3 mm from another, with a narrow place beside it.
class Rims final : public Domain {
 public:
  Box bounds() const override { return {{-20, -20, -20}, {20, 20, 20}}; }
  Region region_at(const Point&) const override { return kOutside; }
  void crossings(const Segment&, Crossings& out) const override { out.clear(); }
  std::vector<std::shared_ptr<const Curve>> curves() const override {
    const auto rim = [](std::vector<Point> course) {
      return std::make_shared<PolylineCurve>(std::move(course), std::vector<Region>{0, 1}, std::nullopt);
    };
    return {rim({{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}, {0, 0, 0}}),
            rim({{-0.3, 3, 0}, {-0.3, 6, 0}, {-3, 6, 0}, {-3, 3, 0}, {-0.3, 3, 0}})};
  }
  void size_hints(const SizeHintSink& sink) const override { sink({narrow, 0.3}); }

  const Point narrow{10, 5, -0.3};
};

TEST(CurveSample, PartsRimsThatAreCloserThanATenthOfTheSize) {
  const CurveSample sample = curve_sample_of(Rims(), 4);
  expect_cover(sample);
  EXPECT_TRUE(sample.merged.empty());
}

TEST(CurveSample, LeavesNarrowPlacesBesideRimsRoom) {
  const Rims rims;
  for (const CurveVertex& vertex : curve_sample_of(rims, 4).vertices) {
    EXPECT_LE(vertex.radius_mm, (0.3 + distance(vertex.point, rims.narrow)) / 3 + 1e-9);
  }
}

}  // namespace
}  // namespace scantet
