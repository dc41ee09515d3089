#include "scantet/reading/crop.h"

#include <gtest/gtest.h>

#include "error_code.h"
#include "scantet/base/error.h"
#include "scantet/field/scan_from_memory.h"

namespace scantet {
namespace {

using Unit = CropBox::Unit;

constexpr std::array<int, 3> kWholeSize{10, 8, 6};

/// A scan of i + 100 j + 10000 k.
Scan scan_in(const Frame& frame) {
  std::vector<std::int32_t> values;
  for (int k = 0; k < kWholeSize[2]; ++k) {
    for (int j = 0; j < kWholeSize[1]; ++j) {
      for (int i = 0; i < kWholeSize[0]; ++i) values.push_back(i + 100 * j + 10000 * k);
    }
  }
  return make_scan(std::move(values), kWholeSize, frame);
}

/// Each voxel that is left is where it was, and there are so many.
void expect_left(const Scan& scan, const Scan& left, const std::array<int, 3>& first, const std::array<int, 3>& size) {
  ASSERT_EQ(left.size, size);
  const auto* values = std::get<const std::int32_t*>(left.voxels);
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        EXPECT_EQ(*values++, i + first[0] + 100 * (j + first[1]) + 10000 * (k + first[2]));
      }
    }
  }
  const Point p = left.frame.to_world({1, 1, 1});
  EXPECT_NEAR(distance(p, scan.frame.to_world({first[0] + 1.0, first[1] + 1.0, first[2] + 1.0})), 0, 1e-12);
  EXPECT_EQ(left.min_value, first[0] + 100 * first[1] + 10000 * first[2]);
}

std::string code_of(const std::function<void()>& call) {
  return test::error_code(call);
}

const Frame kPlain({Vec{-2, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 0.5}}, {10, 20, 30});  // i grows to the right

TEST(Crop, InMillimetresTakesTheVoxelsWhoseCentresAreInTheBox) {
  const Scan scan = scan_in(kPlain);
  expect_left(scan, cropped(scan, read_crop("--crop", "-2:6,22.5:25,30:31", Unit::mm)), {2, 3, 0}, {5, 3, 3});
  expect_left(scan, cropped(scan, read_crop("--crop", ":,21:,:31.4", Unit::mm)), {0, 1, 0}, {10, 7, 3});
}

TEST(Crop, InVoxelsCountsFromZeroAndTakesBothBounds) {
  const Scan scan = scan_in(kPlain);
  expect_left(scan, cropped(scan, read_crop("--crop-voxels", "2:6,0:1,3:99", Unit::voxels)), {2, 0, 3}, {5, 2, 3});
}

TEST(Crop, OfAnObliqueImageTakesTheBlockAroundTheBox) {
  const Scan scan = scan_in(Frame({Vec{0.8, 0.6, 0}, Vec{-0.6, 0.8, 0}, Vec{0, 0, 1}}, {0, 0, 0}));
  const CropBox box = read_crop("--crop", "1:3,3:5,1:2", Unit::mm);
  const Scan left = cropped(scan, box);
  EXPECT_LT(left.voxel_count(), scan.voxel_count());
  int in_box = 0;
  const auto count = [&](const Scan& of) {
    int found = 0;
    for (int k = 0; k < of.size[2]; ++k) {
      for (int j = 0; j < of.size[1]; ++j) {
        for (int i = 0; i < of.size[0]; ++i) {
          const Point p = of.frame.to_world({double(i), double(j), double(k)});
          bool in = true;
          for (int axis = 0; axis < 3; ++axis) {
            const auto n = static_cast<std::size_t>(axis);
            in = in && p[axis] >= box.low[n] && p[axis] <= box.high[n];
          }
          found += in ? 1 : 0;
        }
      }
    }
    return found;
  };
  in_box = count(scan);
  EXPECT_GT(in_box, 4);
  EXPECT_EQ(count(left), in_box);
}

TEST(Crop, ThatLeavesAllCopiesNothing) {
  const Scan scan = scan_in(kPlain);
  EXPECT_EQ(cropped(scan, CropBox{}).owner, scan.owner);
  EXPECT_EQ(cropped(scan, read_crop("--crop", "-1e9:1e9,:,:", Unit::mm)).owner, scan.owner);
}

TEST(Crop, RefusesWhatIsNoBox) {
  for (const char* text : {"", "1", "1:2", "1:2,3:4", "1:2,3:4,5:6,7:8",
                           "1:2:3,:,:", "a:2,:,:", "1:nan,:,:", "1-2,:,:", ":inf,:,:", "1: 2,:,:"}) {
    EXPECT_EQ(code_of([&] { read_crop("--crop", text, Unit::mm); }), "usage.crop") << text;
  }
  EXPECT_EQ(code_of([] { read_crop("--crop", "5:2,:,:", Unit::mm); }), "usage.crop") << "backwards";
  const Scan scan = scan_in(kPlain);
  for (const char* text : {"500:600,:,:", ":,:,31:31", ":,:,31.1:31.4", "-99:-9,:,:"}) {
    EXPECT_EQ(code_of([&] { cropped(scan, read_crop("--crop", text, Unit::mm)); }), "usage.crop") << text;
  }
  for (const char* text : {"10:12,:,:", "4:4,:,:", "-5:-1,:,:", "-5:0,:,:", "1e9:2e9,:,:"}) {
    EXPECT_EQ(code_of([&] { cropped(scan, read_crop("--crop-voxels", text, Unit::voxels)); }), "usage.crop") << text;
  }
  CropBox backwards;
  backwards.low[1] = 3;
  backwards.high[1] = 2;
  EXPECT_EQ(code_of([&] { cropped(scan, backwards); }), "usage.crop");
}

}  // namespace
}  // namespace scantet
