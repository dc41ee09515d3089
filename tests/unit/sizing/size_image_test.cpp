#include "scantet/sizing/size_image.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scantet {
namespace {

/// Sizes 1 + 0.5·i + 0.25·j + 0.125·k in a frame that is turned by 30° about z, stretched and moved.
Scan turned_scan() {
  constexpr int kSize = 5;
  auto voxels = std::make_shared<std::vector<float>>();
  for (int n = 0; n < kSize * kSize * kSize; ++n) {
    voxels->push_back(static_cast<float>(1 + 0.5 * (n % 5) + 0.25 * (n / 5 % 5) + 0.125 * (n / 25)));
  }
  const double c = std::sqrt(3.0);
  const Frame frame({Vec{c, 1, 0}, Vec{-0.5, 0.5 * c, 0}, Vec{0, 0, 3}}, {10, -20, 30});
  return {{kSize, kSize, kSize}, frame, voxels->data(), voxels, 1, 4.5, "float", "test"};
}

double size_at(const SizeImage& image, const Point& p) {
  const SizePlace place{p, 0, 1};
  double size = 0;
  image.sizes_at({&place, 1}, {&size, 1});
  return size;
}

TEST(SizeImage, HonoursTheFrame) {
  const Scan scan = turned_scan();
  const SizeImage image(scan);
  for (const Vec& index : {Vec{0, 0, 0}, Vec{1.5, 2.25, 3.5}, Vec{4, 4, 4}, Vec{0.3, 3.9, 1.1}}) {
    EXPECT_NEAR(size_at(image, scan.frame.to_world(index)), 1 + 0.5 * index.x + 0.25 * index.y + 0.125 * index.z, 1e-6);
  }
  EXPECT_NEAR(image.finest_mm(), 1, 1e-12);
}

TEST(SizeImage, GoesOnBeyondItsBorder) {
  const Scan scan = turned_scan();
  EXPECT_NEAR(size_at(SizeImage(scan), scan.frame.to_world({-7, 2, 9})), 1 + 0.5 + 0.5, 1e-6);
}

TEST(SizeImage, GivesTheValueOfAVoxelThatIsNoSize) {
  Scan scan = turned_scan();
  auto voxels = std::make_shared<std::vector<float>>(125, 2.0F);
  (*voxels)[0] = 0;
  scan.voxels = voxels->data();
  scan.owner = voxels;
  const SizeImage image(scan);
  EXPECT_EQ(size_at(image, scan.frame.to_world({0.9, 0.9, 0.9})), 0);
  EXPECT_EQ(size_at(image, scan.frame.to_world({1.5, 1.5, 1.5})), 2);
}

}  // namespace
}  // namespace scantet
