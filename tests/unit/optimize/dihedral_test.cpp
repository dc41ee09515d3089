#include <gtest/gtest.h>

#include "scantet/optimize/dihedral_impl.h"
#include "scantet/quality/measures.h"

namespace scantet::optimize {
namespace {

TEST(Dihedral, SharpnessFallsWithTheSmallestAngle) {
  double last = kInverted;
  for (const double height : {0.01, 0.1, 0.3, 0.5, 0.7}) {
    const std::array<Point, 4> p{Point{1, 0, height}, {0, 1, -height}, {-1, 0, height}, {0, -1, -height}};
    const double sharpness = tet_sharpness(p[0], p[1], p[2], p[3]);
    const double inverted = tet_sharpness(p[1], p[0], p[2], p[3]);
    EXPECT_EQ(std::max(sharpness, inverted), kInverted);
    const TetMeasures m = measure_tet(p[0], p[1], p[2], p[3]);
    const double angle = *std::min_element(m.dihedral_deg.begin(), m.dihedral_deg.end());
    EXPECT_NEAR(std::min(sharpness, inverted), sharpness_of_angle(angle), 1e-12);
    EXPECT_LT(std::min(sharpness, inverted), last);
    last = std::min(sharpness, inverted);
  }
  EXPECT_EQ(tet_sharpness({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}), kInverted);
}

TEST(Dihedral, SharpnessAndAngleAreEachOthersInverse) {
  double last = kInverted;
  for (const double degrees : {1.0, 10.0, 45.0, 89.0, 90.0, 91.0, 135.0, 179.0}) {
    const double sharpness = sharpness_of_angle(degrees);
    EXPECT_NEAR(angle_of_sharpness(sharpness), degrees, 1e-6);
    EXPECT_LT(sharpness, last);
    last = sharpness;
  }
  EXPECT_EQ(angle_of_sharpness(kInverted), 0);
}

}  // namespace
}  // namespace scantet::optimize
