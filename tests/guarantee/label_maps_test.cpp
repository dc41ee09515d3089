// The segmentations of sample_volumes/, whose shapes are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "sample_table.h"
#include "scantet/labels/junctions.h"
#include "scantet/reading/scan_reader.h"

namespace scantet {
namespace {

std::shared_ptr<const LabelField> field_of(const std::string& file, LabelSmoothing smoothing = LabelSmoothing::none) {
  Progress progress;
  LabelSettings settings;
  settings.smoothing = smoothing;
  return make_label_field(read_scan(sample_path(file), progress), settings);
}

TEST(LabelMaps, VoxelsAreThoseOfTheTable) {
  std::map<std::string, std::vector<SampleLabel>> maps;
  for (const SampleLabel& row : read_label_table()) maps[row.file].push_back(row);
  EXPECT_EQ(maps.size(), 5U);
  for (const auto& [file, rows] : maps) {
    const auto field = field_of(file);
    ASSERT_EQ(field->regions().size(), rows.size() + 1) << file;
    for (std::size_t n = 0; n < rows.size(); ++n) {
      EXPECT_EQ(field->regions()[n + 1], rows[n].label) << file;
      EXPECT_EQ(field->voxels()[n + 1], rows[n].voxels) << file;
      EXPECT_NEAR(rows[n].volume_mm3, static_cast<double>(rows[n].voxels), 0.01 * rows[n].volume_mm3) << file;
    }
  }
}

/// The lines in which three cells meet, within a ball around the origin, as points `step` apart.
std::vector<Point> true_junctions(const std::vector<Point>& seeds, double radius, double step) {
  std::vector<Point> points;
  for (std::size_t a = 0; a < seeds.size(); ++a) {
    for (std::size_t b = a + 1; b < seeds.size(); ++b) {
      for (std::size_t c = b + 1; c < seeds.size(); ++c) {
        const Vec u = seeds[b] - seeds[a];
        const Vec v = seeds[c] - seeds[a];
        const Vec w = cross(u, v);
        const Vec to_center =
            (0.5 / squared_length(w)) * (squared_length(u) * cross(v, w) + squared_length(v) * cross(w, u));
        const Point on_axis = seeds[a] + to_center;
        const Vec along = (1 / length(w)) * w;
        const Point middle = on_axis - dot(on_axis, along) * along;
        const int steps = static_cast<int>(radius / step);
        for (int n = -steps; n <= steps; ++n) {
          const Point p = middle + n * step * along;
          const double apart = distance(p, seeds[a]);
          const bool nearest = std::none_of(seeds.begin(), seeds.end(),
                                            [&](const Point& seed) { return distance(p, seed) < apart - 1e-9; });
          if (length(p) < radius && nearest) points.push_back(p);
        }
      }
    }
  }
  return points;
}

/// How far curves are from the truth at the most, and the truth from them, mm; what is near the ball's surface, which
/// bends curves, is not looked at.
double farthest(const Junctions& junctions, const std::vector<Point>& truth, double radius) {
  constexpr double kAtRim = 2;  // mm
  const auto looked_at = [&](const Point& p) { return length(p) < radius - kAtRim; };
  double farthest = 0;
  for (const Point& p : truth) {
    if (!looked_at(p)) continue;
    double nearest = radius;
    for (const auto& curve : junctions.curves) nearest = std::min(nearest, curve->nearest(p).distance_mm);
    farthest = std::max(farthest, nearest);
  }
  for (const auto& curve : junctions.curves) {
    const std::vector<Region> regions = curve->regions();
    if (std::find(regions.begin(), regions.end(), kOutside) != regions.end()) continue;
    for (double along = 0; along < curve->length_mm(); along += 0.1) {
      const Point p = curve->at(along);
      if (!looked_at(p)) continue;
      double nearest = radius;
      for (const Point& q : truth) nearest = std::min(nearest, distance(p, q));
      farthest = std::max(farthest, nearest);
    }
  }
  return farthest;
}

TEST(LabelMaps, CurvesOfVoronoiCellsAreNearTheTrueOnes) {
  constexpr double kRadius = 17.3;
  std::vector<Point> seeds;
  for (const SampleLabel& row : read_label_table()) {
    Point seed;
    if (row.file != "labels_voronoi.nrrd") continue;
    ASSERT_EQ(std::sscanf(row.what.c_str(), "cell of (%lf, %lf, %lf)", &seed.x, &seed.y, &seed.z), 3) << row.what;
    seeds.push_back(seed);
  }
  const std::vector<Point> truth = true_junctions(seeds, kRadius, 0.1);
  ASSERT_GT(truth.size(), 500U);
  for (const auto& [smoothing, voxels] : {std::pair{LabelSmoothing::none, 0.8}, std::pair{LabelSmoothing::keep, 0.6}}) {
    Progress progress;
    const auto field = field_of("labels_voronoi.nrrd", smoothing);
    const Junctions junctions = find_junctions(*field, progress);
    EXPECT_EQ(junctions.open_ends, 0U);
    const double apart_mm = farthest(junctions, truth, kRadius);
    RecordProperty(smoothing == LabelSmoothing::none ? "stairs_mm" : "smooth_mm", std::to_string(apart_mm));
    EXPECT_LT(apart_mm, voxels);
  }
}

}  // namespace
}  // namespace scantet
