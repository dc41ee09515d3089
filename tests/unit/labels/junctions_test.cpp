#include "scantet/labels/junctions.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "label_scan.h"
#include "scantet/base/parallel.h"
#include "scantet/labels/junction_curve.h"
#include "scantet/labels/label_domain.h"

namespace scantet {
namespace {

using test::label_cells;
using test::label_noise;
using test::label_scan;

struct Found {
  std::shared_ptr<const LabelField> field;
  Junctions junctions;
};

Found find(const Scan& scan) {
  Found found{make_label_field(scan, {}), {}};
  Progress progress;
  found.junctions = find_junctions(*found.field, progress);
  return found;
}

std::vector<Region> sorted(std::vector<Region> regions) {
  std::sort(regions.begin(), regions.end());
  return regions;
}

std::vector<std::shared_ptr<const Curve>> curves_of(const Junctions& junctions, const std::set<Region>& regions) {
  std::vector<std::shared_ptr<const Curve>> curves;
  for (const auto& curve : junctions.curves) {
    const std::vector<Region> around = curve->regions();
    if (std::set<Region>(around.begin(), around.end()) == regions) curves.push_back(curve);
  }
  return curves;
}

const std::vector<Point>& points_of(const Curve& curve) {
  return dynamic_cast<const JunctionCurve&>(curve).course().points();
}

/// Curves end at their corners, corners have the regions of their curves, and every closed curve is closed.
void expect_joined(const Junctions& junctions) {
  std::vector<int> ends(junctions.corners.size(), 0);
  for (const auto& curve : junctions.curves) {
    const std::vector<Point>& points = points_of(*curve);
    const auto corners = curve->corners();
    if (!corners) {
      EXPECT_EQ(points.front(), points.back());
      EXPECT_GE(points.size(), 4U);
      continue;
    }
    const std::array<Point, 2> at{points.front(), points.back()};
    for (std::size_t end = 0; end < 2; ++end) {
      const Corner& corner = junctions.corners.at((*corners)[end]);
      ++ends[(*corners)[end]];
      EXPECT_EQ(corner.point, at[end]);
      const std::vector<Region> around = sorted(curve->regions());
      EXPECT_TRUE(std::includes(corner.regions.begin(), corner.regions.end(), around.begin(), around.end()));
    }
  }
  EXPECT_EQ(std::count(ends.begin(), ends.end(), 0), 0);
  EXPECT_EQ(static_cast<std::size_t>(std::count(ends.begin(), ends.end(), 1)), junctions.open_ends);
}

/// The regions on a circle around a point of a curve, right-handed, from the least one on.
std::vector<Region> on_circle(const LabelField& field, const Point& p, const Vec& along, double radius_mm) {
  const Vec e = (1 / length(along)) * along;
  const Vec across = cross(e, std::abs(e.x) > 0.5 ? Vec{0, 1, 0} : Vec{1, 0, 0});
  const Vec e1 = (1 / length(across)) * across;
  const Vec e2 = cross(e, e1);
  std::vector<Region> order;
  for (int n = 0; n < 360; ++n) {
    const double angle = 2 * std::numbers::pi * n / 360;
    const Point q = p + radius_mm * (std::cos(angle) * e1 + std::sin(angle) * e2);
    const Region region = field.region_at(field.frame().to_index(q));
    if (order.empty() || order.back() != region) order.push_back(region);
  }
  if (order.size() > 1 && order.back() == order.front()) order.pop_back();
  std::rotate(order.begin(), std::min_element(order.begin(), order.end()), order.end());
  return order;
}

TEST(Junctions, ThreeBlocksMeetInALine) {
  const auto [field, junctions] = find(label_scan({8, 8, 8}, [](int i, int j, int) {
    return j < 4 ? 1 : i < 4 ? 2 : 3;
  }));
  expect_joined(junctions);
  EXPECT_EQ(junctions.open_ends, 0U);
  EXPECT_EQ(junctions.unsettled, 0U);
  const auto curves = curves_of(junctions, {1, 2, 3});
  ASSERT_EQ(curves.size(), 1U);
  for (const double z : {0.0, 1.3, 3.0, 6.9}) {
    const Point p{3.5, 3 + 2.0 / 3, z};
    EXPECT_LT(curves[0]->nearest(p).distance_mm, 1e-6);
  }
  EXPECT_LE(points_of(*curves[0]).size(), 6U) << "what is straight needs no more points";
  // Seen from above, 3 follows 1 and 2 follows 3.
  const bool upward = points_of(*curves[0]).front().z < points_of(*curves[0]).back().z;
  EXPECT_EQ(curves[0]->regions(), upward ? (std::vector<Region>{1, 3, 2}) : (std::vector<Region>{1, 2, 3}));
}

TEST(Junctions, FourBlocksMeetInOneCurve) {
  const auto [field, junctions] =
      find(label_scan({8, 8, 8}, [](int i, int j, int) { return 1 + (i < 4 ? 0 : 1) + (j < 4 ? 0 : 2); }));
  expect_joined(junctions);
  const auto curves = curves_of(junctions, {1, 2, 3, 4});
  ASSERT_EQ(curves.size(), 1U);
  for (const double z : {0.0, 2.2, 6.9}) EXPECT_LT(curves[0]->nearest({3.5, 3.5, z}).distance_mm, 1e-6);
  const bool upward = points_of(*curves[0]).front().z < points_of(*curves[0]).back().z;
  EXPECT_EQ(curves[0]->regions(), upward ? (std::vector<Region>{1, 2, 4, 3}) : (std::vector<Region>{1, 3, 4, 2}));
  EXPECT_TRUE(curves_of(junctions, {1, 2, 3}).empty());
  EXPECT_TRUE(curves_of(junctions, {2, 3, 4}).empty());
}

TEST(Junctions, EightBlocksMeetInACorner) {
  const auto [field, junctions] = find(label_scan(
      {8, 8, 8}, [](int i, int j, int k) { return 1 + (i < 4 ? 0 : 1) + (j < 4 ? 0 : 2) + (k < 4 ? 0 : 4); }));
  expect_joined(junctions);
  std::size_t at_middle = 0;
  for (std::size_t n = 0; n < junctions.corners.size(); ++n) {
    if (junctions.corners[n].regions.size() != 8) continue;
    EXPECT_LT(distance(junctions.corners[n].point, {3.5, 3.5, 3.5}), 1e-6);
    for (const auto& curve : junctions.curves) {
      const auto corners = curve->corners();
      if (!corners || ((*corners)[0] != n && (*corners)[1] != n)) continue;
      ++at_middle;
      EXPECT_EQ(curve->regions().size(), 4U);
    }
  }
  EXPECT_EQ(at_middle, 6U);
}

TEST(Junctions, RimOfADividedBallIsOneClosedCurve) {
  const Point middle{11.6, 11.3, 11.8};
  constexpr double kRadius = 8;
  const auto [field, junctions] = find(label_scan({24, 24, 24}, [&](int i, int j, int k) {
    const Point p{double(i), double(j), double(k)};
    return distance(p, middle) > kRadius ? 0 : p.z > middle.z ? 2 : 1;
  }));
  expect_joined(junctions);
  ASSERT_EQ(junctions.curves.size(), 1U);
  EXPECT_TRUE(junctions.corners.empty());
  EXPECT_FALSE(junctions.curves[0]->corners());
  EXPECT_EQ(sorted(junctions.curves[0]->regions()), (std::vector<Region>{0, 1, 2}));
  for (const Point& p : points_of(*junctions.curves[0])) {
    EXPECT_LT(std::abs(std::hypot(p.x - middle.x, p.y - middle.y) - kRadius), 0.8);
    EXPECT_LT(std::abs(p.z - middle.z), 0.8);
  }
  EXPECT_NEAR(junctions.curves[0]->length_mm(), 2 * std::numbers::pi * kRadius, 8);
}

TEST(Junctions, OneLabelHasNone) {
  const auto [field, junctions] = find(label_scan({9, 9, 9}, [](int i, int j, int k) {
    return distance({double(i), double(j), double(k)}, {4, 4, 4}) < 3 ? 1 : 0;
  }));
  EXPECT_TRUE(junctions.curves.empty());
  EXPECT_TRUE(junctions.corners.empty());
}

TEST(Junctions, LabelsAtTheBorderOfTheImageMeetTheOutside) {
  const auto [field, junctions] = find(label_scan({6, 7, 8}, [](int i, int, int) { return i < 3 ? 1 : 2; }));
  expect_joined(junctions);
  const auto curves = curves_of(junctions, {0, 1, 2});
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_FALSE(curves[0]->corners());
  for (const Point& p : points_of(*curves[0])) {
    EXPECT_NEAR(p.x, 2.5, 1e-6);
    EXPECT_TRUE(p.y < 0 || p.y > 6 || p.z < 0 || p.z > 7);
  }
}

TEST(Junctions, CurvesOfVoronoiCellsAreNearTheTrueOnes) {
  const std::vector<Point> seeds{{6.3, 7.1, 9.2}, {16.8, 8.4, 11.9}, {10.2, 17.7, 13.1}, {12.9, 12.2, 22.4}};
  for (const std::size_t count : {3U, 4U}) {
    const auto nearest = [&](int i, int j, int k) {
      std::size_t best = 0;
      for (std::size_t n = 1; n < count; ++n) {
        const Point p{double(i), double(j), double(k)};
        if (distance(p, seeds[n]) < distance(p, seeds[best])) best = n;
      }
      return best + 1;
    };
    const auto [field, junctions] = find(label_scan({24, 24, 24}, nearest));
    expect_joined(junctions);
    EXPECT_EQ(junctions.open_ends, 0U);
    for (const auto& curve : junctions.curves) {
      const std::vector<Region> regions = sorted(curve->regions());
      if (regions[0] == kOutside) continue;
      for (const Point& p : points_of(*curve)) {
        if (std::min({p.x, p.y, p.z}) < 0 || std::max({p.x, p.y, p.z}) > 23) continue;
        // How far p is from the plane halfway between two seeds.
        for (const Region other : regions) {
          const Vec apart =
              seeds[static_cast<std::size_t>(other - 1)] - seeds[static_cast<std::size_t>(regions[0] - 1)];
          if (other == regions[0]) continue;
          const Point halfway = seeds[static_cast<std::size_t>(regions[0] - 1)] + 0.5 * apart;
          EXPECT_LT(std::abs(dot(p - halfway, apart)) / length(apart), 0.95);
        }
      }
    }
  }
}

TEST(Junctions, PointsAreWhereFieldsAreEqualAndRegionsInOrder) {
  for (const Frame& frame : {Frame(), test::oblique(), test::flipped_and_sheared()}) {
    for (const Scan& scan : {label_noise({7, 6, 8}, 9, frame), label_cells({30, 27, 31}, 14, frame)}) {
      const auto [field, junctions] = find(scan);
      expect_joined(junctions);
      EXPECT_EQ(junctions.broken, 0U);
      const auto domain = make_label_domain(field);
      for (const auto& curve : junctions.curves) {
        for (const Point& p : points_of(*curve)) EXPECT_LT(domain->residual_at(p).value(), 1e-6);
      }
      std::size_t points = 0;
      std::size_t off = 0;
      std::size_t wrong = 0;
      std::size_t looked_at = 0;
      for (const auto& curve : junctions.curves) {
        const std::vector<Point>& polyline = points_of(*curve);
        for (std::size_t n = 1; n + 1 < polyline.size(); ++n) {
          ++points;
          const Vec along = polyline[n + 1] - polyline[n - 1];
          const std::vector<Region> around =
              on_circle(*field, polyline[n], along, 0.01 * field->frame().min_spacing_mm());
          const std::vector<Region> regions = sorted(curve->regions());
          const std::vector<Region> found = sorted(around);
          if (!std::includes(found.begin(), found.end(), regions.begin(), regions.end())) ++off;
          if (around.size() != 3) continue;
          ++looked_at;
          if (around != curve->regions()) ++wrong;
        }
      }
      EXPECT_GT(points, 50U);
      EXPECT_LE(off, points / 50);
      EXPECT_LE(wrong, looked_at / 50);
    }
  }
}

// Curves that pass each other closely would leap from one to the other if they were joined crosswise. In noise they
// pass so closely now and then that no tracing parts them.
TEST(Junctions, CurvesDoNotLeap) {
  constexpr double kStepMm = 0.02;
  std::size_t steps = 0;
  std::size_t leaps = 0;
  for (const unsigned seed : {3U, 4U}) {
    LabelSettings settings;
    settings.smoothing = LabelSmoothing::keep;
    const auto field = make_label_field(label_noise({14, 14, 14}, 3, {}, seed), settings);
    Progress progress;
    const Junctions junctions = find_junctions(*field, progress);
    for (const auto& curve : junctions.curves) {
      const double length_mm = curve->length_mm();
      Point last = curve->at(0);
      for (double along_mm = kStepMm; along_mm < length_mm - kStepMm; along_mm += kStepMm) {
        const Point p = curve->at(along_mm);
        ++steps;
        leaps += distance(p, last) > 5 * kStepMm ? 1 : 0;
        last = p;
      }
    }
  }
  EXPECT_GT(steps, 1000U);
  EXPECT_LE(leaps, steps / 5000);
}

TEST(Junctions, EveryPlaceWhereThreeRegionsMeetIsNearACurve) {
  const auto [field, junctions] = find(label_cells({20, 22, 21}, 12));
  constexpr int kSteps = 6;
  std::size_t places = 0;
  std::size_t far = 0;
  for (int k = 0; k < 20 * kSteps; ++k) {
    for (int j = 0; j < 21 * kSteps; ++j) {
      for (int i = 0; i < 19 * kSteps; ++i) {
        std::set<Region> regions;
        for (int corner = 0; corner < 8; ++corner) {
          const Vec at{double(i + (corner & 1)), double(j + (corner >> 1 & 1)), double(k + (corner >> 2))};
          regions.insert(field->region_at((1.0 / kSteps) * at));
        }
        if (regions.size() < 3) continue;
        ++places;
        const Point p = (1.0 / kSteps) * Vec{i + 0.5, j + 0.5, k + 0.5};
        const bool near = std::any_of(junctions.curves.begin(), junctions.curves.end(),
                                      [&](const auto& curve) { return curve->nearest(p).distance_mm < 0.25; });
        if (!near) ++far;
      }
    }
  }
  EXPECT_GT(places, 500U);
  EXPECT_LE(far, places / 100);
}

TEST(Junctions, DoNotDependOnTheNumberOfThreads) {
  const Scan scan = label_cells({40, 37, 41}, 25, test::oblique());
  std::vector<Junctions> all;
  for (const std::size_t threads : {1U, 2U, 5U}) {
    with_threads(threads, [&] { all.push_back(find(scan).junctions); });
  }
  for (const Junctions& one : all) {
    ASSERT_EQ(one.curves.size(), all[0].curves.size());
    ASSERT_EQ(one.corners.size(), all[0].corners.size());
    for (std::size_t n = 0; n < one.curves.size(); ++n) {
      EXPECT_EQ(points_of(*one.curves[n]), points_of(*all[0].curves[n]));
      EXPECT_EQ(one.curves[n]->regions(), all[0].curves[n]->regions());
      EXPECT_EQ(one.curves[n]->corners(), all[0].curves[n]->corners());
    }
    for (std::size_t n = 0; n < one.corners.size(); ++n) EXPECT_EQ(one.corners[n].point, all[0].corners[n].point);
  }
}

}  // namespace
}  // namespace scantet
