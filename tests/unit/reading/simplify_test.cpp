#include "scantet/reading/simplify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "error_code.h"
#include "scantet/base/error.h"
#include "scantet/field/scan_from_memory.h"

namespace scantet {
namespace {

constexpr std::array<int, 3> kSize{24, 20, 16};
const Frame kFrame({Vec{0.5, 0, 0}, Vec{0.2, 1, 0}, Vec{0, 0, -2}}, {10, -5, 3});  // sheared, and left-handed

std::size_t at(int i, int j, int k) {
  return (static_cast<std::size_t>(k) * kSize[1] + static_cast<std::size_t>(j)) * kSize[0] +
         static_cast<std::size_t>(i);
}

template <class Voxel>
Scan scan_of(const std::function<double(int, int, int)>& value) {
  std::vector<Voxel> values;
  for (int k = 0; k < kSize[2]; ++k) {
    for (int j = 0; j < kSize[1]; ++j) {
      for (int i = 0; i < kSize[0]; ++i) values.push_back(static_cast<Voxel>(value(i, j, k)));
    }
  }
  return make_scan(std::move(values), kSize, kFrame);
}

const float* floats(const Scan& scan) {
  return std::get<const float*>(scan.voxels);
}

std::string code_of(const Scan& scan, const Simplification& how) {
  return test::error_code([&] { simplified(scan, how); });
}

Scan spike() {
  return scan_of<float>([](int i, int j, int k) { return i == 12 && j == 10 && k == 8 ? 1000 : 0; });
}

TEST(Simplify, DoesNothingUnasked) {
  const Scan scan = spike();
  EXPECT_EQ(simplified(scan, {}).owner, scan.owner);
}

TEST(Simplify, AGaussianHasTheWidthAskedForInMillimetres) {
  Simplification how;
  how.smooth_mm = 1.5;
  const Scan scan = simplified(spike(), how);
  EXPECT_EQ(scan.size, kSize);
  const double sum = std::accumulate(floats(scan), floats(scan) + scan.voxel_count(), 0.0);
  EXPECT_NEAR(sum, 1000, 2);
  for (int axis = 0; axis < 3; ++axis) {
    double variance_mm2 = 0;
    for (int k = 0; k < kSize[2]; ++k) {
      for (int j = 0; j < kSize[1]; ++j) {
        for (int i = 0; i < kSize[0]; ++i) {
          const std::array<int, 3> steps{i - 12, j - 10, k - 8};
          const double mm = steps[static_cast<std::size_t>(axis)] * kFrame.spacing_mm(axis);
          variance_mm2 += mm * mm * static_cast<double>(floats(scan)[at(i, j, k)]) / sum;
        }
      }
    }
    EXPECT_NEAR(std::sqrt(variance_mm2), 1.5, 0.05) << "along axis " << axis;
  }
  EXPECT_EQ(scan.frame.to_world({1, 2, 3}), kFrame.to_world({1, 2, 3}));
}

/// Heights over a ball of radius_mm about the middle of a scan of 0.5 mm voxels.
Scan ball(double radius_mm) {
  constexpr int kSide = 33;
  std::vector<float> values;
  for (int k = 0; k < kSide; ++k) {
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        const double r = 0.5 * distance({double(i), double(j), double(k)}, {16, 16, 16});
        values.push_back(static_cast<float>(radius_mm - r));
      }
    }
  }
  return make_scan(std::move(values), {kSide, kSide, kSide},
                   Frame({Vec{0.5, 0, 0}, Vec{0, 0.5, 0}, Vec{0, 0, 0.5}}, {}));
}

TEST(Simplify, CurvatureFlowShrinksABallByItsCurvature) {
  Simplification how;
  how.smooth_mm = 1.5;
  how.smoothing = Smoothing::curvature;
  const double radius_mm = 5;
  const Scan scan = simplified(ball(radius_mm), how);
  const float* row = floats(scan) + (16 * 33 + 16) * 33;
  int first_below = 16;
  while (row[first_below] > 0) ++first_below;
  const double step = row[first_below - 1] / (row[first_below - 1] - row[first_below]);
  const double radius = 0.5 * (first_below - 1 + step - 16);
  EXPECT_NEAR(radius, std::sqrt(radius_mm * radius_mm - 2 * 1.5 * 1.5), 0.1) << "dr/dt = -2/r for half of 1.5^2";
}

TEST(Simplify, CutsFirst) {
  Simplification how;
  how.crop = read_crop("--crop-voxels", "0:11,:,:", CropBox::Unit::voxels);
  how.median_voxels = 1;
  const Scan steps = scan_of<std::uint8_t>([](int i, int, int) { return i < 6 ? 1 : i < 12 ? 5 : 200; });
  const Scan scan = simplified(steps, how);
  EXPECT_EQ(scan.size, (std::array<int, 3>{12, 20, 16}));
  EXPECT_EQ(scan.max_value, 5) << "what is cut away is not seen by the median";
  EXPECT_EQ(scan.frame.to_world({}), kFrame.to_world({}));
}

TEST(Simplify, AMedianTakesOutSingleVoxelsAndKeepsEdgesAndTheType) {
  Simplification how;
  how.median_voxels = 1;
  const Scan noisy = scan_of<std::int16_t>([](int i, int j, int k) {
    return i == 5 && j == 7 && k == 9 ? 900 : i < 12 ? -100 : 300;
  });
  const Scan scan = simplified(noisy, how);
  const auto* values = std::get<const std::int16_t*>(scan.voxels);
  for (int k = 0; k < kSize[2]; ++k) {
    for (int j = 0; j < kSize[1]; ++j) {
      for (int i = 0; i < kSize[0]; ++i) EXPECT_EQ(values[at(i, j, k)], i < 12 ? -100 : 300);
    }
  }
}

TEST(Simplify, ResamplingKeepsALinearFieldAndTheOutermostVoxels) {
  Simplification how;
  how.resample_mm = 0.9;
  const auto linear = [](const Vec& index) { return 3 * index.x - 2 * index.y + 5 * index.z; };
  const Scan scan = simplified(scan_of<float>([&](int i, int j, int k) {
                                 return linear({double(i), double(j), double(k)});
                               }),
                               how);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(scan.frame.spacing_mm(axis), 0.9, 0.05);
  std::size_t n = 0;
  for (int k = 0; k < scan.size[2]; ++k) {
    for (int j = 0; j < scan.size[1]; ++j) {
      for (int i = 0; i < scan.size[0]; ++i, ++n) {
        const Vec index = kFrame.to_index(scan.frame.to_world({double(i), double(j), double(k)}));
        EXPECT_NEAR(floats(scan)[n], linear(index), 1e-3);
      }
    }
  }
  const Point last =
      scan.frame.to_world({double(scan.size[0] - 1), double(scan.size[1] - 1), double(scan.size[2] - 1)});
  EXPECT_NEAR(distance(last, kFrame.to_world({kSize[0] - 1.0, kSize[1] - 1.0, kSize[2] - 1.0})), 0, 1e-9);
}

TEST(Simplify, RefusesWhatMakesNoSense) {
  const auto code = [](const auto& set) {
    Simplification how;
    set(how);
    return code_of(spike(), how);
  };
  EXPECT_EQ(code([](Simplification& how) { how.smooth_mm = 1e6; }), "usage.smooth");
  EXPECT_EQ(code([](Simplification& how) {
              how.smooth_mm = 20;
              how.smoothing = Smoothing::curvature;
            }),
            "usage.smooth")
      << "it would take too long";
  EXPECT_EQ(code([](Simplification& how) { how.median_voxels = 24; }), "usage.median");
  EXPECT_EQ(code([](Simplification& how) { how.resample_mm = 1e-6; }), "usage.resample");
  EXPECT_EQ(code([](Simplification& how) { how.resample_mm = 100; }), "usage.resample");
  EXPECT_EQ(code([](Simplification& how) { how.crop = read_crop("", "3:4,:,:", CropBox::Unit::mm); }), "usage.crop");
  EXPECT_EQ(code([](Simplification& how) { how.median_voxels = 1; }), "input.constant")
      << "the median of a single voxel of noise";
}

}  // namespace
}  // namespace scantet
