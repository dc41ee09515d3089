#include "scantet/domain/noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scantet/domain/analytic.h"

namespace scantet {
namespace {

/// A ring that tells of so many narrow places.
class RingWithHints : public Domain {
 public:
  explicit RingWithHints(std::size_t hints) : hints_(hints) {}
  Box bounds() const override { return ring_->bounds(); }
  Region region_at(const Point& p) const override { return ring_->region_at(p); }
  void crossings(const Segment& segment, Crossings& out) const override { ring_->crossings(segment, out); }
  void size_hints(const SizeHintSink& sink) const override {
    for (std::size_t n = 0; n < hints_; ++n) sink({{0, 0, 0}, 0.1});
  }

 private:
  std::size_t hints_;
  std::unique_ptr<Domain> ring_ = make_torus({}, 10, 3);
};

TEST(Noise, HasMoreNarrowPlacesThanTheBoundsHaveCubesOfTheSize) {
  const RingWithHints domain(60'000);
  const Vec extent = domain.bounds().extent();
  const double fits = std::cbrt(extent.x * extent.y * extent.z / 60'000);
  EXPECT_TRUE(is_noise(domain, UniformSize(1.01 * fits)));
  EXPECT_FALSE(is_noise(domain, UniformSize(0.99 * fits)));
}

TEST(Noise, IsNotWhatHasFewNarrowPlaces) {
  EXPECT_FALSE(is_noise(RingWithHints(40'000), UniformSize(5))) << "they can all be sampled";
  EXPECT_FALSE(is_noise(RingWithHints(0), UniformSize(5)));
}

}  // namespace
}  // namespace scantet
