// Statistics against brute force, orientation against frames whose answer is known.
#include "scantet/field/scan_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace scantet {
namespace {

template <class T>
Scan scan_of(std::vector<T> values, std::array<int, 3> size) {
  auto owner = std::make_shared<const std::vector<T>>(std::move(values));
  Scan scan;
  scan.size = size;
  scan.voxels = owner->data();
  scan.min_value = static_cast<double>(*std::min_element(owner->begin(), owner->end()));
  scan.max_value = static_cast<double>(*std::max_element(owner->begin(), owner->end()));
  scan.owner = owner;
  return scan;
}

template <class T>
double exact_percentile(std::vector<T> values, int percent) {
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(static_cast<double>(values.size()) * percent / 100));
  return static_cast<double>(values[std::max<std::size_t>(rank, 1) - 1]);
}

template <class T>
std::vector<T> random_values(std::size_t count) {
  std::mt19937 random(7);
  std::vector<T> values(count);
  for (T& value : values) {
    if constexpr (std::is_floating_point_v<T>) {
      value = static_cast<T>(std::normal_distribution<double>(1000, 3)(random));
    } else {
      value = static_cast<T>(random());
    }
  }
  return values;
}

template <class T>
class Statistics : public testing::Test {};
using PixelTypes = testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t,
                                  std::int64_t, std::uint64_t, float, double>;
TYPED_TEST_SUITE(Statistics, PixelTypes);

TYPED_TEST(Statistics, AgreeWithBruteForce) {
  const auto values = random_values<TypeParam>(30 * 20 * 10);
  const ScanStatistics all = statistics_of(scan_of(values, {30, 20, 10}));
  const ValueHistogram& histogram = all.histogram;
  EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::uint64_t{0}), values.size());
  EXPECT_EQ(histogram.exact, sizeof(TypeParam) <= 2);
  const double range = all.max - all.min;
  double mean = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    mean += (static_cast<double>(values[i]) - mean) / static_cast<double>(i + 1);
  }
  EXPECT_NEAR(all.mean, mean, 1e-9 * range);
  double variance = 0;
  for (const TypeParam v : values) variance += std::pow(static_cast<double>(v) - mean, 2) / double(values.size());
  EXPECT_NEAR(all.standard_deviation, std::sqrt(variance), 1e-9 * range);
  for (std::size_t k = 0; k < kPercents.size(); ++k) {
    const double exact = exact_percentile(values, kPercents[k]);
    EXPECT_NEAR(all.percentiles[k], exact, histogram.exact ? 0 : range / 131072 * (1 + 1e-6)) << kPercents[k];
  }
}

TEST(ScanStatistics, WideIntegersOfSmallRangeAreExact) {
  const ScanStatistics all =
      statistics_of(scan_of<std::int32_t>({-5, 70, 70, 1000, 1000, 1000, 1000, 65530}, {2, 2, 2}));
  EXPECT_TRUE(all.histogram.exact);
  EXPECT_EQ(all.percentiles[3], 1000);
  EXPECT_EQ(all.percentiles[0], -5);
  EXPECT_EQ(all.percentiles[6], 65530);
}

TEST(ScanStatistics, OneLargeOffsetLosesNoDigits) {
  const ScanStatistics all =
      statistics_of(scan_of<double>({1e9, 1e9 + 1, 1e9, 1e9 + 1, 1e9, 1e9 + 1, 1e9, 1e9 + 1}, {2, 2, 2}));
  EXPECT_DOUBLE_EQ(all.mean, 1e9 + 0.5);
  EXPECT_DOUBLE_EQ(all.standard_deviation, 0.5);
}

TEST(BorderTouch, CountsEachFaceOnBothSidesOfTheLevel) {
  const std::array<int, 3> size{4, 3, 5};
  std::vector<std::int16_t> values(60, 0);
  const auto at = [&](int i, int j, int k) -> std::int16_t& { return values[i + 4 * (j + 3 * k)]; };
  for (int j = 0; j < 3; ++j) {
    for (int k = 0; k < 5; ++k) at(3, j, k) = 10;  // the whole +i face
  }
  const Scan scan = scan_of(values, size);
  const auto above = border_touch(scan, 5, InsideSide::above);
  const std::array<std::string, 6> faces{"-i", "+i", "-j", "+j", "-k", "+k"};
  const std::array<double, 6> shares{0, 1, 0.25, 0.25, 0.25, 0.25};
  const std::string letters = "RLAPIS";
  const auto below = border_touch(scan, 5, InsideSide::below);
  for (std::size_t face = 0; face < 6; ++face) {
    EXPECT_EQ(above[face].face, faces[face]);
    EXPECT_EQ(above[face].anatomical, letters[face]);
    EXPECT_DOUBLE_EQ(above[face].share, shares[face]);
    EXPECT_DOUBLE_EQ(below[face].share, 1 - shares[face]);
  }
  for (const FaceTouch& face : border_touch(scan, 10, InsideSide::above))
    EXPECT_EQ(face.share, 0) << "on the level is outside";
}

TEST(Orientation, NamesWhereEachAxisGrows) {
  const Orientation identity = orientation_of(Frame{});
  EXPECT_EQ(identity.code, "LPS");
  EXPECT_FALSE(identity.oblique || identity.sheared || identity.left_handed);

  const Orientation ras = orientation_of(Frame({Vec{-1, 0, 0}, Vec{0, -2, 0}, Vec{0, 0, 3}}, {}));
  EXPECT_EQ(ras.code, "RAS");
  EXPECT_FALSE(ras.oblique || ras.sheared || ras.left_handed);

  const Orientation sagittal = orientation_of(Frame({Vec{0, 1, 0}, Vec{0, 0, -1}, Vec{1, 0, 0}}, {}));
  EXPECT_EQ(sagittal.code, "PIL");
  EXPECT_TRUE(sagittal.left_handed);
}

TEST(Orientation, NamesEachWorldAxisOnceHoweverOblique) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    const auto vector = [&] { return Vec{normal(random), normal(random), normal(random)}; };
    const Orientation orientation = orientation_of(Frame({vector(), vector(), vector()}, {}));
    std::string axes;
    for (const char c : orientation.code)
      axes += std::string("LR").find(c) < 2 ? 'x' : std::string("AP").find(c) < 2 ? 'y' : 'z';
    std::sort(axes.begin(), axes.end());
    EXPECT_EQ(axes, "xyz") << orientation.code;
    EXPECT_TRUE(orientation.oblique && orientation.sheared);
  }
}

TEST(Orientation, TellsObliqueFromSheared) {
  const double c = std::cos(0.1);
  const double s = std::sin(0.1);
  const Orientation turned = orientation_of(Frame({Vec{c, s, 0}, Vec{-s, c, 0}, Vec{0, 0, 1}}, {}));
  EXPECT_TRUE(turned.oblique);
  EXPECT_FALSE(turned.sheared);
  EXPECT_TRUE(orientation_of(Frame({Vec{1, 0, 0}, Vec{0.01, 1, 0}, Vec{0, 0, 1}}, {})).sheared);
  EXPECT_FALSE(orientation_of(Frame({Vec{1, 1e-6, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}}, {})).oblique) << "header rounding";
}

}  // namespace
}  // namespace scantet
