#include "scantet/cuts/continued_scan.h"

#include <gtest/gtest.h>

#include "scantet/field/scan_from_memory.h"
#include "unit/frames.h"

namespace scantet {
namespace {

constexpr std::array<int, 3> kSize{4, 5, 6};

std::size_t place_of(int i, int j, int k) {
  return static_cast<std::size_t>((k * kSize[1] + j) * kSize[0] + i);
}

/// Each voxel has a value of its own.
Scan numbered(const Frame& frame) {
  std::vector<std::uint8_t> values(static_cast<std::size_t>(kSize[0] * kSize[1] * kSize[2]));
  for (std::size_t n = 0; n < values.size(); ++n) values[n] = static_cast<std::uint8_t>(n + 1);
  return make_scan(std::move(values), kSize, frame);
}

std::uint8_t voxel(const Scan& scan, int i, int j, int k) {
  return std::get<const std::uint8_t*>(scan.voxels)[place_of(i, j, k)];
}

/// The plane across an axis of the grid at a layer that need not be whole; `side`: -1 cuts off lower layers, 1 higher.
CutPlane across(const Frame& frame, int axis, double layer, double side) {
  const Vec normal = cross(frame.column((axis + 1) % 3), frame.column((axis + 2) % 3));
  const double sign = dot(normal, frame.column(axis)) > 0 ? side : -side;
  const Vec unit = (sign / length(normal)) * normal;
  Vec index{1, 2, 3};
  index[axis] = layer;
  return {unit, dot(unit, frame.to_world(index)), "cut_1"};
}

/// Turned around the middle of the image's voxels.
CutPlane tilted(CutPlane plane, double sine, const Frame& frame) {
  const Point middle = frame.to_world({1.5, 2, 2.5});
  const double beyond_mm = plane.beyond_mm(middle);
  const Vec side = cross(plane.normal, std::abs(plane.normal.x) < 0.9 ? Vec{1, 0, 0} : Vec{0, 1, 0});
  plane.normal = plane.normal + (sine / length(side)) * side;
  plane.normal = (1 / length(plane.normal)) * plane.normal;
  plane.offset_mm = dot(plane.normal, middle) - beyond_mm;
  return plane;
}

/// Whether layers are as `source` says: which layer each has come from.
void expect_layers(const Scan& scan, const Scan& before, int axis, const std::vector<int>& source) {
  for (int k = 0; k < kSize[2]; ++k) {
    for (int j = 0; j < kSize[1]; ++j) {
      for (int i = 0; i < kSize[0]; ++i) {
        std::array<int, 3> from{i, j, k};
        const auto n = static_cast<std::size_t>(axis);
        from[n] = source[static_cast<std::size_t>(from[n])];
        EXPECT_EQ(voxel(scan, i, j, k), voxel(before, from[0], from[1], from[2])) << i << " " << j << " " << k;
      }
    }
  }
}

class Continued : public testing::TestWithParam<Frame> {
 protected:
  Scan scan_ = numbered(GetParam());
  Scan beyond(int axis, double layer, double side) const {
    return continued_beyond(scan_, {across(GetParam(), axis, layer, side)});
  }
};

TEST_P(Continued, GoesOnAsTheLastLayerBeforeThePlane) {
  expect_layers(beyond(0, 1.4, 1), scan_, 0, {0, 1, 1, 1});
  expect_layers(beyond(0, 1.4, -1), scan_, 0, {2, 2, 2, 3});
  expect_layers(beyond(1, 3.7, 1), scan_, 1, {0, 1, 2, 3, 3});
  expect_layers(beyond(2, 0.5, 1), scan_, 2, {0, 0, 0, 0, 0, 0});
  expect_layers(beyond(2, 4.5, -1), scan_, 2, {5, 5, 5, 5, 5, 5});
}

// Interfaces with the next layer could come as near to the plane as to the voxels' centres.
TEST_P(Continued, LayersInThePlaneAreBeyondIt) {
  for (const double layer : {2.9999999, 3.0, 3.0000001}) {
    expect_layers(beyond(2, layer, 1), scan_, 2, {0, 1, 2, 2, 2, 2});
    expect_layers(beyond(2, layer, -1), scan_, 2, {4, 4, 4, 4, 4, 5});
  }
  expect_layers(beyond(2, 3.01, 1), scan_, 2, {0, 1, 2, 3, 3, 3});
  expect_layers(beyond(2, 2.99, -1), scan_, 2, {3, 3, 3, 3, 4, 5});
}

TEST_P(Continued, SeveralPlanesEachCount) {
  const Frame& frame = GetParam();
  const Scan slab = continued_beyond(scan_, {across(frame, 1, 1.5, -1), across(frame, 1, 3.5, 1)});
  expect_layers(slab, scan_, 1, {2, 2, 2, 3, 3});
}

TEST_P(Continued, TellsTheRangeOfWhatIsLeft) {
  const Scan low = beyond(2, 0.5, 1);
  EXPECT_EQ(low.min_value, 1);
  EXPECT_EQ(low.max_value, kSize[0] * kSize[1]);
  EXPECT_EQ(low.pixel_type, scan_.pixel_type);
}

TEST_P(Continued, PlanesBesideTheImageChangeNothing) {
  for (const double layer : {-1.5, 0.0, 5.5, 6.5}) {
    EXPECT_EQ(beyond(2, layer, 1).voxels, scan_.voxels) << layer;
  }
  for (const double layer : {-1.5, -0.5, 5.0, 6.5}) {
    EXPECT_EQ(beyond(2, layer, -1).voxels, scan_.voxels) << layer;
  }
}

TEST_P(Continued, ObliquePlanesChangeNothing) {
  EXPECT_EQ(continued_beyond(scan_, {tilted(across(GetParam(), 2, 2.5, 1), 0.3, GetParam())}).voxels, scan_.voxels);
}

TEST_P(Continued, RotationsByRoundingAreNone) {
  expect_layers(continued_beyond(scan_, {tilted(across(GetParam(), 2, 2.5, 1), 1e-5, GetParam())}), scan_, 2,
                {0, 1, 2, 2, 2, 2});
  const Scan touched = continued_beyond(scan_, {tilted(across(GetParam(), 2, 3, 1), 1e-5, GetParam())});
  expect_layers(touched, scan_, 2, {0, 1, 2, 3, 3, 3});
}

INSTANTIATE_TEST_SUITE_P(Frames, Continued,
                         testing::Values(test::plain(), test::oblique(), test::flipped_and_sheared()));

TEST(ContinuedScan, MayHaveOneValue) {
  std::vector<std::uint8_t> values(static_cast<std::size_t>(kSize[0] * kSize[1] * kSize[2]));
  values.back() = 7;
  const Scan scan = make_scan(std::move(values), kSize, test::plain());
  const Scan continued = continued_beyond(scan, {across(test::plain(), 2, 2.5, 1)});
  EXPECT_EQ(continued.max_value, 0);
  EXPECT_EQ(voxel(continued, kSize[0] - 1, kSize[1] - 1, kSize[2] - 1), 0);
}

}  // namespace
}  // namespace scantet
