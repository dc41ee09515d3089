#include "scantet/labels/label_domain.h"

#include <gtest/gtest.h>

#include <set>

#include "label_scan.h"
#include "scantet/base/parallel.h"

namespace scantet {
namespace {

using test::label_cells;
using test::label_noise;
using test::label_scan;

Point random_point(const Box& box, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-0.05, 1.05);
  const Vec e = box.extent();
  return {box.min.x + unit(random) * e.x, box.min.y + unit(random) * e.y, box.min.z + unit(random) * e.z};
}

/// Every change between samples must be among the crossings, and the regions between the crossings those of the
/// samples.
void expect_all_changes(const Domain& domain, const Segment& segment, int samples) {
  Crossings crossings;
  domain.crossings(segment, crossings);
  const double length = distance(segment.source, segment.target);
  std::size_t next = 0;
  Region region = domain.region_at(segment.source);
  for (int n = 0; n <= samples; ++n) {
    const Point p = lerp(segment.source, segment.target, double(n) / samples);
    const double along = distance(segment.source, p);
    while (next < crossings.size() && distance(segment.source, crossings[next].point) < along) {
      ASSERT_EQ(crossings[next].from, region);
      region = crossings[next++].to;
    }
    const double tolerance = 1e-9 * length + 1e-11;
    if (next > 0 && distance(crossings[next - 1].point, p) < tolerance) continue;
    if (next < crossings.size() && distance(crossings[next].point, p) < tolerance) continue;
    ASSERT_EQ(domain.region_at(p), region) << "sample " << n;
  }
}

TEST(LabelDomain, CrossingsAreThoseOfFineSamples) {
  std::mt19937 random(1);
  for (const Frame& frame : {Frame(), test::oblique(), test::flipped_and_sheared()}) {
    for (const Scan& scan : {label_noise({6, 5, 7}, 9, frame), label_cells({24, 21, 30}, 12, frame)}) {
      const auto domain = make_label_domain(make_label_field(scan, {}));
      for (int n = 0; n < 40; ++n) {
        const Segment segment{random_point(domain->bounds(), random), random_point(domain->bounds(), random)};
        expect_all_changes(*domain, segment, 4000);
      }
    }
  }
}

TEST(LabelDomain, InterfacesOfTwoHalvesLieHalfway) {
  const auto domain =
      make_label_domain(make_label_field(label_scan({6, 6, 6}, [](int i, int, int) { return i < 3 ? 4 : 9; }), {}));
  Crossings crossings;
  domain->crossings({{-3, 2.2, 2.7}, {9, 2.2, 2.7}}, crossings);
  ASSERT_EQ(crossings.size(), 3U);
  const std::array<double, 3> x{-0.5, 2.5, 5.5};
  const std::array<Region, 4> regions{0, 4, 9, 0};
  for (std::size_t n = 0; n < 3; ++n) {
    EXPECT_NEAR(crossings[n].point.x, x[n], 1e-12);
    EXPECT_EQ(crossings[n].from, regions[n]);
    EXPECT_EQ(crossings[n].to, regions[n + 1]);
    EXPECT_EQ(domain->patch_at(crossings[n].point), crossings[n].patch());
    EXPECT_LE(*domain->residual_at(crossings[n].point), 1e-12);
  }
}

TEST(LabelDomain, AlongPlanesOfTiesTheSmallerLabelIs) {
  const auto domain = make_label_domain(
      make_label_field(label_scan({4, 4, 4}, [](int i, int j, int) { return (i + j) % 2 == 0 ? 1 : 2; }), {}));
  Crossings crossings;
  domain->crossings({{1.5, 1.1, 1.2}, {1.5, 1.9, 1.7}}, crossings);  // f_1 = f_2 on all of it
  EXPECT_TRUE(crossings.empty());
  EXPECT_EQ(domain->region_at({1.5, 1.3, 1.4}), 1);
}

TEST(LabelDomain, CandidatesAreOnEveryInterfaceAndTheSameForAnyNumberOfThreads) {
  const auto domain = make_label_domain(make_label_field(label_cells({40, 40, 40}, 8, test::oblique()), {}));
  const auto candidates = [&](std::size_t threads) {
    std::vector<Point> points;
    with_threads(threads, [&] { domain->surface_candidates(0.7, [&](const Point& p) { points.push_back(p); }); });
    return points;
  };
  const std::vector<Point> points = candidates(1);
  EXPECT_EQ(points, candidates(4));
  std::set<Patch> patches;
  for (const Point& p : points) {
    EXPECT_LE(*domain->residual_at(p), 1e-9);
    patches.insert(domain->patch_at(p));
  }
  std::mt19937 random(2);
  Crossings crossings;
  std::set<Patch> crossed;
  for (int n = 0; n < 2000; ++n) {
    domain->crossings({random_point(domain->bounds(), random), random_point(domain->bounds(), random)}, crossings);
    for (const Crossing& crossing : crossings) crossed.insert(crossing.patch());
  }
  for (const Patch& patch : crossed) EXPECT_TRUE(patches.count(patch) == 1);
}

TEST(LabelDomain, HandsOnWhatItIsGiven) {
  LabelDomainParts parts;
  parts.names = {{1, "one"}};
  parts.corners = {{{1, 2, 3}, {0, 1, 2}, ""}};
  const auto domain = make_label_domain(make_label_field(label_noise({6, 6, 6}, 2), {}), parts);
  EXPECT_EQ(domain->name_of_region(1), "one");
  EXPECT_EQ(domain->name_of_region(2), "");
  EXPECT_EQ(domain->corners().size(), 1U);
  EXPECT_TRUE(domain->curves().empty());
  EXPECT_TRUE(domain->components().empty());
}

}  // namespace
}  // namespace scantet
