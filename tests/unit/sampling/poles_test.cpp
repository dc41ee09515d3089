#include "scantet/sampling/poles.h"

#include <gtest/gtest.h>

#include <set>

#include "scantet/base/parallel.h"
#include "scantet/domain/analytic.h"
#include "scantet/domain/sizing_field.h"
#include "scantet/sampling/initial_sample.h"

namespace scantet {
namespace {

class Poles : public testing::Test {
 protected:
  Poles() {
    Progress progress;
    sample_ = initial_sample(*torus_, UniformSize(0.7), {}, progress);
    poles_ = poles_of(sample_, torus_->bounds(), progress);
  }

  std::unique_ptr<Domain> torus_ = make_torus({}, 8, 3);
  std::vector<Point> sample_;
  std::vector<Pole> poles_;
};

TEST_F(Poles, AreCentresOfEmptyBallsThatTouchTheSample) {
  ASSERT_GT(poles_.size(), sample_.size() / 2);
  for (const Pole& pole : poles_) {
    double nearest = 1e300;
    double spread = 0;
    std::vector<Vec> touched;
    for (const Point& p : sample_) {
      const double away = distance(p, pole.center);
      nearest = std::min(nearest, away);
      if (away < pole.radius_mm * (1 + 1e-7)) touched.push_back(p - pole.center);
    }
    EXPECT_NEAR(nearest, pole.radius_mm, 1e-7 * pole.radius_mm);
    ASSERT_GE(touched.size(), 4U);
    for (const Vec& a : touched) {
      for (const Vec& b : touched) {
        spread = std::max(spread, std::acos(std::clamp(dot(a, b) / (length(a) * length(b)), -1.0, 1.0)));
      }
    }
    EXPECT_NEAR(spread, pole.spread_rad, touched.size() == 4 ? 1e-5 : 0.5);
  }
}

TEST_F(Poles, AreNearTheMedialAxis) {
  // Inside it is the circle in the middle of the tube; outside, the axis of the torus.
  std::size_t inside = 0;
  std::size_t outside = 0;
  std::size_t near_axis = 0;
  for (const Pole& pole : poles_) {
    const Point& c = pole.center;
    if (torus_->region_at(c) != kOutside) {
      EXPECT_LT(std::hypot(std::hypot(c.x, c.y) - 8, c.z), 0.3);
      EXPECT_NEAR(pole.radius_mm, 3, 0.3);
      ++inside;
    } else if (pole.radius_mm < 20) {
      ++outside;
      near_axis += std::hypot(c.x, c.y) < 1 ? 1 : 0;
    }
  }
  EXPECT_GT(inside, sample_.size() / 4);
  EXPECT_GT(outside, 100U);
  EXPECT_GT(near_axis, outside * 9 / 10);
}

TEST_F(Poles, AreListedOnceAndTheSameForAnyNumberOfThreads) {
  std::set<std::array<double, 4>> places;
  for (const Pole& pole : poles_) places.insert({pole.center.x, pole.center.y, pole.center.z, pole.radius_mm});
  EXPECT_EQ(places.size(), poles_.size());
  for (const std::size_t threads : {1, 3}) {
    with_threads(threads, [&] {
      Progress progress;
      const std::vector<Pole> again = poles_of(sample_, torus_->bounds(), progress);
      ASSERT_EQ(again.size(), poles_.size());
      for (std::size_t i = 0; i < again.size(); ++i) EXPECT_EQ(again[i].center, poles_[i].center);
    });
  }
}

TEST_F(Poles, AreNoneIfCancelled) {
  class Cancelled final : public Progress {
   public:
    bool cancelled() const override { return true; }
  } cancelled;
  EXPECT_TRUE(poles_of(sample_, torus_->bounds(), cancelled).empty());
}

}  // namespace
}  // namespace scantet
