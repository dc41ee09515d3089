#include "scantet/labels/label_volumes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cancelled_after.h"
#include "field_measures.h"
#include "label_scan.h"
#include "scantet/domain/sizing_field.h"
#include "scantet/labels/label_object.h"

namespace scantet {
namespace {

using test::label_scan;
using test::least_margin;
using test::smooth_field;
using test::volume_error;

/// A ball of label 1, as large as one of that many voxels of 1 mm, on a grid with steps of these lengths.
Scan ball(double radius_mm, const Vec& steps_mm) {
  const Frame frame({Vec{steps_mm.x, 0, 0}, Vec{0, steps_mm.y, 0}, Vec{0, 0, steps_mm.z}}, {});
  std::array<int, 3> size;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    size[axis] = static_cast<int>(2 * radius_mm / steps_mm[static_cast<int>(axis)]) + 8;
  }
  const Point centre = frame.to_world({size[0] / 2.0 - 0.37, size[1] / 2.0 - 0.71, size[2] / 2.0 - 0.13});
  return label_scan(
      size,
      [&](int i, int j, int k) {
        return distance(frame.to_world({double(i), double(j), double(k)}), centre) < radius_mm ? 1 : 0;
      },
      frame);
}

TEST(LabelVolumes, ABallGetsWhatFacetsCutOff) {
  const UniformSize size(2);
  for (const Vec steps_mm : {Vec{1, 1, 1}, Vec{1, 0.7, 1.4}}) {
    for (const double radius_mm : {9.0, 12.4, 18.0}) {
      const auto field = smooth_field(ball(radius_mm, steps_mm));
      const auto fitted = field->fitted_to({size});
      ASSERT_NE(fitted, nullptr);
      // Of facets with a circumradius of 1.72 mm on a sphere: a shell of the mean depth of what they cut off.
      const double turn = 1.72 * 2 / radius_mm;
      const double depth_mm = 3.0 / 16 * 1.72 * turn / (1 + turn * turn);
      const double before = volume_error(*field, 1, 8);
      const double more = volume_error(*fitted, 1, 8) - before;
      EXPECT_NEAR(before, 0, 0.003);
      EXPECT_NEAR(more / (std::pow(1 + depth_mm / radius_mm, 3) - 1), 1, 0.2) << radius_mm << " " << steps_mm.y;
    }
  }
}

TEST(LabelVolumes, CloserFacetsCutOffLess) {
  const UniformSize size(2);
  const auto field = smooth_field(ball(9, {1, 1, 1}));
  const double before = volume_error(*field, 1, 8);
  const double far = volume_error(*field->fitted_to({size}), 1, 8) - before;
  const double near = volume_error(*field->fitted_to({size, 1, 0.05}), 1, 8) - before;
  const double small = volume_error(*field->fitted_to({size, 0.5}), 1, 8) - before;
  EXPECT_GT(near, 0);
  EXPECT_LT(near, 0.5 * far);
  EXPECT_NEAR(small / far, 0.25, 0.1);
}

TEST(LabelVolumes, FlatInterfacesStay) {
  const Scan halves = label_scan({24, 24, 24}, [](int i, int j, int) { return 3 * i + j < 49 ? 1 : 2; });
  const UniformSize size(3);
  const auto field = smooth_field(halves);
  const auto fitted = field->fitted_to({size});
  for (int n = 0; n < 100; ++n) {  // in the middle, away from where the background rounds the rims off
    const Point p{7 + 0.05 * n, 12, 12};
    for (const auto& of : {field, fitted}) EXPECT_EQ(of->region_at(p), 3 * p.x + p.y < 48.5 ? 1 : 2) << p.x;
  }
}

TEST(LabelVolumes, NodesKeepTheirLabels) {
  const UniformSize size(6);
  for (const Scan& scan : {test::label_noise({15, 14, 13}, 6), test::label_cells({40, 35, 30}, 25)}) {
    EXPECT_GT(least_margin(*smooth_field(scan)->fitted_to({size})), 0.1);
  }
}

TEST(LabelVolumes, OnlySmoothFieldsAreFittedAndOnce) {
  const UniformSize size(2);
  const Scan scan = ball(6, {1, 1, 1});
  EXPECT_EQ(make_label_field(scan, LabelSettings())->fitted_to({size}), nullptr);
  EXPECT_EQ(smooth_field(scan)->fitted_to({size})->fitted_to({size}), nullptr);
}

TEST(LabelVolumes, RegionsGiveUpWhatAMeshHasTooMuchOf) {
  constexpr double kTooMuch = 20;  // voxels
  const UniformSize size(2);
  const auto fitted = smooth_field(ball(9, {1, 1, 1}))->fitted_to({size});
  const auto voxels = static_cast<double>(fitted->voxels()[1]);
  const double before = volume_error(*fitted, 1, 8) * voxels;
  const std::vector<double> excess{0, kTooMuch};
  const auto settled = fitted->settled(excess, {});
  EXPECT_NEAR(volume_error(*settled, 1, 8) * voxels - before, -kTooMuch, 0.2 * kTooMuch);
  EXPECT_NEAR(volume_error(*settled->settled(excess, {}), 1, 8) * voxels - before, -2 * kTooMuch, 0.4 * kTooMuch);
  std::vector<Point> everywhere;
  for (int n = 0; n < 26 * 26 * 26; ++n) everywhere.push_back({1.0 * (n % 26), 1.0 * (n / 26 % 26), n / 676.0});
  EXPECT_EQ(volume_error(*fitted->settled(excess, everywhere), 1, 8) * voxels, before);
}

TEST(LabelVolumes, JunctionsStayWhereVolumesMove) {
  const UniformSize size(2);
  const auto fitted = smooth_field(test::label_cells({40, 35, 30}, 25))->fitted_to({size});
  std::vector<double> excess(fitted->regions().size());
  for (std::size_t n = 1; n < excess.size(); ++n) excess[n] = n % 2 == 0 ? 10 : -10;
  const auto settled = fitted->settled(excess, {});
  EXPECT_GT(least_margin(*settled), 0.099);
  std::size_t at_junctions = 0;
  std::size_t changed = 0;
  LabelCell was;
  LabelCell is;
  for (int n = 0; n < 39 * 34 * 29; ++n) {
    const std::array<int, 3> cell{n % 39, n / 39 % 34, n / (39 * 34)};
    if (!fitted->is_mixed(cell[0], cell[1], cell[2])) continue;
    fitted->cell(cell[0], cell[1], cell[2], was);
    settled->cell(cell[0], cell[1], cell[2], is);
    if (was.count > 2) {
      ++at_junctions;
      EXPECT_EQ(was.values, is.values) << n;
    } else if (was.values != is.values) {
      ++changed;
    }
  }
  EXPECT_GT(at_junctions, 500U);
  EXPECT_GT(changed, 500U);
}

TEST(LabelVolumes, OnlyFittedFieldsSettle) {
  const std::vector<double> excess{0, 1};
  EXPECT_EQ(smooth_field(ball(6, {1, 1, 1}))->settled(excess, {}), nullptr);
}

TEST(LabelVolumes, FittingIsCancelledWhileItCounts) {
  const UniformSize size(2);
  LabelSettings settings;
  settings.smoothing = LabelSmoothing::keep;
  Progress progress;
  const LabelObject object = make_label_object(test::label_cells({40, 35, 30}, 25), settings, progress);
  test::expect_cancellable(50, [&](Progress& of_fit) { return object.fit({size}, of_fit).domain != nullptr; });
}

}  // namespace
}  // namespace scantet
