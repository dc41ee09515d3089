#include "scantet/cuts/cut_plane.h"

#include <gtest/gtest.h>

#include <map>

namespace scantet {
namespace {

std::map<std::string, Vec> normals_of(const Frame& frame) {
  std::map<std::string, Vec> normals;
  for (const CutPlane& plane : border_planes(frame, {10, 20, 30})) {
    EXPECT_TRUE(plane.is_border());
    EXPECT_NEAR(length(plane.normal), 1, 1e-12);
    EXPECT_LT(plane.beyond_mm(frame.to_world({4.5, 9.5, 14.5})), 0);
    EXPECT_GT(dot(plane.closing_mm, plane.normal), 0);
    normals[plane.name] = plane.normal;
  }
  return normals;
}

TEST(CutPlane, BorderIsNamedByAnatomy) {
  const auto normals = normals_of(Frame({Vec{1, 0, 0}, Vec{0, 2, 0}, Vec{0, 0, 3}}, {5, 6, 7}));
  ASSERT_EQ(normals.size(), 6U);
  EXPECT_EQ(normals.at("border_left"), (Vec{1, 0, 0}));
  EXPECT_EQ(normals.at("border_right"), (Vec{-1, 0, 0}));
  EXPECT_EQ(normals.at("border_posterior"), (Vec{0, 1, 0}));
  EXPECT_EQ(normals.at("border_anterior"), (Vec{0, -1, 0}));
  EXPECT_EQ(normals.at("border_superior"), (Vec{0, 0, 1}));
  EXPECT_EQ(normals.at("border_inferior"), (Vec{0, 0, -1}));
}

TEST(CutPlane, BorderOfTurnedGridsHasEachNameOnce) {
  const double c = std::sqrt(0.5);
  EXPECT_EQ(normals_of(Frame({Vec{c, c, 0}, Vec{-c, c, 0}, Vec{0, 0, 1}}, {})).size(), 6U);
  const auto sagittal = normals_of(Frame({Vec{0, 1, 0}, Vec{0, 0, -1}, Vec{1, 0, 0}}, {}));
  EXPECT_EQ(sagittal.at("border_superior"), (Vec{0, 0, 1}));
  EXPECT_EQ(sagittal.at("border_left"), (Vec{1, 0, 0}));
}

TEST(CutPlane, BorderPassesThroughTheOutermostVoxelCentres) {
  const Frame frame({Vec{0.5, 0.1, 0}, Vec{-0.2, 0.7, 0.1}, Vec{0, 0, 2}}, {-3, 4, 5});
  for (const CutPlane& plane : border_planes(frame, {10, 20, 30})) {
    int on = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Point p = frame.to_world({(corner & 1) * 9.0, (corner >> 1 & 1) * 19.0, (corner >> 2) * 29.0});
      EXPECT_LT(plane.beyond_mm(p), 1e-9);
      on += std::abs(plane.beyond_mm(p)) < 1e-9 ? 1 : 0;
    }
    EXPECT_EQ(on, 4);
  }
}

TEST(CutPlane, NearestPointIsOnThePlane) {
  const CutPlane along{{0, -1, 0}, 7.3, "a"};
  EXPECT_EQ(along.nearest({1, 2, 3}), (Point{1, -7.3, 3}));
  const double norm = std::sqrt(14.0);
  const CutPlane tilted{{1 / norm, 2 / norm, 3 / norm}, 50, "b"};
  EXPECT_LT(std::abs(tilted.beyond_mm(tilted.nearest({100, -200, 30}))), 1e-13);
}

}  // namespace
}  // namespace scantet
