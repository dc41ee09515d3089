#include "scantet/domain/analytic.h"

#include <gtest/gtest.h>

namespace scantet {
namespace {

/// Share of the bounds that is inside, by a regular grid of points.
double volume_mm3(const Domain& domain, int steps) {
  const Box box = domain.bounds();
  long inside = 0;
  for (int i = 0; i < steps * steps * steps; ++i) {
    const Vec u{(i % steps + 0.5) / steps, (i / steps % steps + 0.5) / steps, (i / steps / steps + 0.5) / steps};
    const Vec e = box.extent();
    inside += domain.region_at(box.min + Vec{u.x * e.x, u.y * e.y, u.z * e.z}) != kOutside ? 1 : 0;
  }
  const Vec e = box.extent();
  return e.x * e.y * e.z * static_cast<double>(inside) / steps / steps / steps;
}

TEST(Analytic, VolumesAreTheTextbooks) {
  EXPECT_NEAR(volume_mm3(*make_sphere({1, 2, 3}, 5), 100), 4.0 / 3 * M_PI * 125, 2);
  EXPECT_NEAR(volume_mm3(*make_shell({}, 3, 5), 100), 4.0 / 3 * M_PI * (125 - 27), 2);
  EXPECT_NEAR(volume_mm3(*make_torus({}, 5, 2), 100), 2 * M_PI * M_PI * 5 * 4, 2);
  EXPECT_NEAR(volume_mm3(*make_two_spheres(5, 1), 100), 2 * 4.0 / 3 * M_PI * 125, 6);
}

TEST(Analytic, ALineThroughATorusCrossesFourTimes) {
  Crossings crossings;
  make_torus({}, 5, 2)->crossings({{-10, 0, 0}, {10, 0, 0}}, crossings);
  ASSERT_EQ(crossings.size(), 4U);
  const double expected[] = {-7, -3, 3, 7};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(crossings[static_cast<std::size_t>(i)].point.x, expected[i], 1e-9);
}

TEST(Analytic, ALineThatHardlyEntersCrossesTwice) {
  Crossings crossings;
  const double off = 5 - 1e-6;
  make_sphere({}, 5)->crossings({{-10, off, 0}, {7, off, 0}}, crossings);
  ASSERT_EQ(crossings.size(), 2U);
  const double half = std::sqrt(25 - off * off);
  EXPECT_NEAR(crossings[0].point.x, -half, 1e-9);
  EXPECT_NEAR(crossings[1].point.x, half, 1e-9);
}

TEST(Analytic, ComponentsAreListed) {
  EXPECT_EQ(make_two_spheres(5, 1)->components().size(), 2U);
  const auto shell = make_shell({}, 3, 5)->components();
  ASSERT_EQ(shell.size(), 2U);
  EXPECT_EQ(shell[0].region, 1);
  EXPECT_EQ(shell[1].region, kOutside);
}

TEST(Domain, DefaultCandidatesNeedOnlyTheTwoQueries) {
  int count = 0;
  make_sphere({}, 10)->surface_candidates(1, [&](const Point& p) {
    EXPECT_NEAR(length(p), 10, 1e-9);
    ++count;
  });
  // Three families of lines, 1 mm apart, each crossing the disk of area πr² twice.
  EXPECT_NEAR(count, 3 * 2 * M_PI * 100, 0.1 * 6 * M_PI * 100);
}

}  // namespace
}  // namespace scantet
