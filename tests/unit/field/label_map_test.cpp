// Which images are label maps: by their values alone, and with what the header says.
#include "scantet/field/label_map.h"

#include <gtest/gtest.h>

#include "unit/image/test_scan.h"

namespace scantet {
namespace {

using namespace test;

/// Places around 12 points of a box of 24³, with these values.
template <class Voxel>
Scan places(const std::vector<double>& values) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(0, 23);
  std::vector<Point> seeds;
  for (std::size_t n = 0; n < values.size(); ++n) seeds.push_back({at(random), at(random), at(random)});
  return scan_of_function<Voxel>({24, 24, 24}, [&](int i, int j, int k) {
    const Point p{double(i), double(j), double(k)};
    if (distance(p, {12, 12, 12}) > 11) return 0.0;
    const auto nearest = std::min_element(
        seeds.begin(), seeds.end(), [&](const Point& a, const Point& b) { return distance(a, p) < distance(b, p); });
    return values[static_cast<std::size_t>(nearest - seeds.begin())];
  });
}

const std::vector<double> kValues{3, 17, 41, 5, 230, 99, 12, 7, 150, 64, 33, 81};

TEST(LabelMap, ValuesThatFillPlacesInNoOrderAreLabels) {
  const auto map = find_labels(places<std::uint8_t>(kValues));
  ASSERT_TRUE(map);
  EXPECT_NE(map->reason.find("its 13 values are whole numbers"), std::string::npos) << map->reason;
  ASSERT_EQ(map->labels.size(), 13U);
  EXPECT_EQ(map->labels[1].value, 3);
  std::uint64_t voxels = 0;
  for (const Label& label : map->labels) voxels += label.voxels;
  EXPECT_EQ(voxels, 24U * 24 * 24);
  EXPECT_TRUE(find_labels(places<float>(kValues))) << "whatever their type";
  std::vector<double> negative;
  for (const double value : kValues) negative.push_back(100 - value);
  EXPECT_TRUE(find_labels(places<std::int16_t>(negative)));
}

TEST(LabelMap, GreyImagesAreNone) {
  const auto ball = [](double step) {
    return [=](int i, int j, int k) {
      const double r = distance({12, 12, 12}, {double(i), double(j), double(k)});
      return step * std::floor(std::clamp(20 * (11 - r), 0.0, 100.0) / step);
    };
  };
  EXPECT_FALSE(find_labels(scan_of_function<std::uint8_t>({25, 25, 25}, ball(1)))) << "smooth";
  EXPECT_FALSE(find_labels(scan_of_function<std::uint8_t>({25, 25, 25}, ball(10)))) << "in few steps";
  EXPECT_FALSE(find_labels(scan_of_function<std::uint8_t>({25, 25, 25}, ball(50)))) << "a mask with a soft edge";
  EXPECT_FALSE(find_labels(noisy_ball<std::uint8_t>({25, 25, 25}, {})));
  EXPECT_FALSE(find_labels(plateaus<std::uint8_t>({25, 25, 25}, {}))) << "noise of four values";
  EXPECT_FALSE(find_labels(scan_of_function<float>({25, 25, 25}, [&](int i, int j, int k) {
    return ball(50)(i, j, k) / 3;
  }))) << "no whole numbers";
}

TEST(LabelMap, ShellsInOrderHaveLevels) {
  const Scan shells = scan_of_function<std::uint8_t>({25, 25, 25}, [](int i, int j, int k) {
    const double r = distance({12, 12, 12}, {double(i), double(j), double(k)});
    return r < 4 ? 3 : r < 8 ? 2 : r < 11 ? 1 : 0;
  });
  EXPECT_FALSE(find_labels(shells)) << "a level between two of them is the surface between";
  Scan named = shells;
  named.header_of_labels = "its header says so";
  const auto map = find_labels(named);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->reason, "its header says so");
}

TEST(LabelMap, AMaskIsNone) {
  Scan mask = scan_of_function<std::uint8_t>({9, 9, 9}, [](int i, int, int) { return i < 4 ? 0 : 1; });
  EXPECT_FALSE(find_labels(mask));
  mask.header_of_labels = "its header says so";
  EXPECT_FALSE(find_labels(mask)) << "its level set is what people mesh";
}

TEST(LabelMap, FewWholeValuesAreThreeTo64) {
  const auto counted = [](int values, double step) {
    return few_whole_values(scan_of_function<float>(
        {9, 9, 9}, [=](int i, int j, int k) { return step * ((i + 9 * j + 81 * k) % values); }));
  };
  EXPECT_FALSE(counted(2, 1)) << "a mask";
  EXPECT_EQ(counted(3, -7), 3);
  EXPECT_EQ(counted(64, 1), 64);
  EXPECT_FALSE(counted(65, 1));
  EXPECT_FALSE(counted(3, 0.25)) << "not whole";
}

}  // namespace
}  // namespace scantet
