#include <gtest/gtest.h>

#include "scantet/domain/analytic.h"
#include "scantet/refine/refinement_impl.h"

namespace scantet::engine {
namespace {

TEST(Refinement, PassesOverExtraPointsThatAreNotClear) {
  const auto sphere = make_sphere({}, 10);
  std::vector<SamplePoint> sample;
  sphere->surface_candidates(4, [&](const Point& p) { sample.push_back({p, 2}); });
  RestrictedTriangulation t(*sphere);
  Progress progress;
  ASSERT_TRUE(t.build(sample, progress));
  const UniformSize size(8);
  Refinement refinement(t, size, {}, progress);
  const std::uint64_t before = t.vertex_count();

  const Point vertex = sample.front().point;
  const auto beside = [](const Point& p, double mm) {  // on the sphere, about so far from p
    const Vec q = p + mm * Vec{p.y, p.z, p.x} - (mm * dot(p, Vec{p.y, p.z, p.x}) / dot(p, p)) * p;
    return (10 / length(q)) * q;
  };
  const Point other = beside(vertex, 0.05);
  const double gap = distance(vertex, other);
  EXPECT_EQ(refinement.add({{other, 1.01 * gap}}), 0U);
  EXPECT_EQ(refinement.add({{other, 0.99 * gap}}), 1U);
  EXPECT_EQ(refinement.add({{other, 0}}), 0U);  // a vertex by now
  const Point near = beside(other, 0.01);
  const std::vector<ExtraPoint> two{{near, 0}, {beside(near, 0.001), 0.5 * distance(near, other)}};
  EXPECT_EQ(refinement.add(two), 1U);  // the second is too near to the first
  EXPECT_EQ(t.vertex_count(), before + 2);
}

}  // namespace
}  // namespace scantet::engine
