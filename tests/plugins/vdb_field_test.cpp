// A scan as a grid answers as the scan does, to the last bit; and grids are what they say.
#include <gtest/gtest.h>

#include "cancelled_after.h"
#include "scantet/base/parallel.h"
#include "scantet/image/level_set.h"
#include "unit/image/test_scan.h"
#include "vdb_domain.h"
#include "vdb_files.h"
#include "vdb_writer.h"

namespace scantet {
namespace {

std::unique_ptr<Domain> through_a_file(const Scan& scan, const LevelSetSettings& settings) {
  const test::TemporaryFile file("through.vdb");
  Progress progress;
  EXPECT_TRUE(vdb::write_scan(scan, settings.outside, file.path(), progress));
  return vdb::make_domain(vdb::read_grid(file.path(), std::nullopt), settings);
}

TEST(VdbField, MakingADomainCanBeCancelled) {
  const test::TemporaryFile file("cancelled.vdb");
  test::write_grids(file.path(), {test::fog_grid()});
  const vdb::Grid grid = vdb::read_grid(file.path(), std::nullopt);
  test::expect_cancellable(3 * 128, [&](const Progress& progress) {
    return vdb::make_domain(grid, {0.5, InsideSide::above, {}}, progress) != nullptr;
  });
}

/// range_ratio: of the values' ranges, to which residuals are relative: that of a over that of b.
void expect_same_queries(const Domain& a, const Domain& b, double range_ratio) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-0.05, 1.05);
  const Box box = a.bounds();
  const auto point = [&] {
    Point p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = box.min[axis] + unit(random) * box.extent()[axis];
    return p;
  };
  Crossings from_a;
  Crossings from_b;
  std::size_t found = 0;
  for (int n = 0; n < 3000; ++n) {
    const Point p = point();
    ASSERT_EQ(a.region_at(p), b.region_at(p));
    ASSERT_NEAR(*a.residual_at(p) * range_ratio, *b.residual_at(p), 1e-12);
    const Segment segment{p, n % 2 == 0 ? point() : lerp(p, point(), 0.05)};
    a.crossings(segment, from_a);
    b.crossings(segment, from_b);
    ASSERT_EQ(from_a.size(), from_b.size());
    for (std::size_t c = 0; c < from_a.size(); ++c) {
      ASSERT_EQ(from_a[c].point, from_b[c].point);
      ASSERT_EQ(a.patch_at(from_a[c].point), b.patch_at(from_b[c].point));
    }
    found += from_a.size();
  }
  EXPECT_GT(found, 300U);
}

void expect_same_topology(const Domain& a, const Domain& b, const std::vector<double>& spacings_mm) {
  const auto components_a = a.components();
  const auto components_b = b.components();
  ASSERT_EQ(components_a.size(), components_b.size());
  for (std::size_t n = 0; n < components_a.size(); ++n) {
    EXPECT_EQ(components_a[n].region, components_b[n].region);
    EXPECT_EQ(components_a[n].witness, components_b[n].witness);
    EXPECT_EQ(components_a[n].volume_mm3, components_b[n].volume_mm3);
    EXPECT_EQ(components_a[n].touches_border, components_b[n].touches_border);
  }
  const auto features = [](const Domain& domain) {
    std::vector<std::pair<Point, double>> all;
    domain.size_hints([&](const SizeHint& feature) { all.emplace_back(feature.point, feature.radius_mm); });
    return all;
  };
  EXPECT_TRUE(features(a) == features(b));
  const auto candidates = [](const Domain& domain, double spacing_mm) {
    std::vector<Point> all;
    domain.surface_candidates(spacing_mm, [&](const Point& p) { all.push_back(p); });
    return all;
  };
  for (const double spacing_mm : spacings_mm) EXPECT_TRUE(candidates(a, spacing_mm) == candidates(b, spacing_mm));
}

void expect_same(const Scan& scan, const LevelSetSettings& settings, const std::vector<double>& spacings_mm) {
  const auto image = make_level_set(scan, settings);
  const auto grid = through_a_file(scan, settings);
  EXPECT_EQ(image->bounds().min, grid->bounds().min);
  EXPECT_EQ(image->bounds().max, grid->bounds().max);
  const double background = settings.outside.value_or(scan.min_value);
  const double with_background = std::max(scan.max_value, background) - std::min(scan.min_value, background);
  expect_same_queries(*image, *grid, (scan.max_value - scan.min_value) / with_background);
  expect_same_topology(*image, *grid, spacings_mm);
}

TEST(VdbField, AScanAsAGridAnswersAsTheScan) {
  for (const auto& [name, frame] : test::frames()) {
    SCOPED_TRACE(name);
    const std::vector<double> spacings_mm{10, 0.4};
    expect_same(test::noisy_ball<float>({37, 26, 19}, frame), {50, InsideSide::above, std::nullopt}, spacings_mm);
    expect_same(test::noisy_ball<double>({41, 50, 33}, frame, 4), {50, InsideSide::below, 100.0}, spacings_mm);
    expect_same(test::plateaus<std::uint8_t>({33, 17, 40}, frame), {1, InsideSide::above, -2.0}, spacings_mm);
    expect_same(test::noisy_ball<std::int16_t>({9, 8, 17}, frame), {50.5, InsideSide::above, 0.25}, spacings_mm);
    expect_same(test::noisy_ball<std::uint64_t>({16, 24, 64}, frame), {49.5, InsideSide::above, std::nullopt},
                spacings_mm);
  }
}

/// A shell and a beam, wide enough for tiles of 8³ and of 128³ and for coarse blocks of one value, in and out.
Scan mask() {
  return test::scan_of_function<std::uint8_t>({400, 150, 160}, [](int i, int j, int k) {
    const bool box = i >= 3 && i < 300 && j >= 1 && j < 149 && k < 141;
    const bool cavity = i >= 260 && i < 270 && j > 60 && j < 110 && k > 20 && k < 90;
    const bool beam = i > 330 && i < 334 && j == 32;
    return (box && !cavity) || beam ? 200 : 7;
  });
}

TEST(VdbField, TilesAreAsTheirVoxels) {
  const Scan scan = mask();
  for (const double level : {100.0, 190.0}) expect_same(scan, {level, InsideSide::above, std::nullopt}, {10});
  expect_same(scan, {100, InsideSide::below, 201.0}, {10});
}

TEST(VdbField, AnswersDoNotDependOnThreads) {
  const Scan scan = mask();
  const auto image = make_level_set(scan, {100, InsideSide::above, std::nullopt});
  for (const std::size_t threads : {1, 2, 8}) {
    with_threads(threads, [&] {
      const auto grid = through_a_file(scan, {100, InsideSide::above, std::nullopt});
      expect_same_topology(*image, *grid, {10});
    });
  }
}

TEST(VdbField, ALevelSetIsWhereItIsNegative) {
  const test::TemporaryFile file("sphere.vdb");
  test::write_grids(file.path(), {test::sphere_grid()});
  const vdb::Grid grid = vdb::read_grid(file.path(), "sphere");
  EXPECT_TRUE(grid.head.level_set);
  const auto domain = vdb::make_domain(grid, {0, InsideSide::below, std::nullopt});
  const Point centre{2.0, -24.2, 5.6};
  std::mt19937 random(1);
  for (int n = 0; n < 2000; ++n) {
    const Vec direction = test::random_direction(random);
    EXPECT_EQ(domain->region_at(centre + 8.95 * direction), 1);
    EXPECT_EQ(domain->region_at(centre + 9.13 * direction), kOutside);
    EXPECT_EQ(domain->region_at(centre + (n % 89) * 0.1 * direction), 1) << "inactive within";
    EXPECT_EQ(domain->region_at(centre + (9.2 + n) * direction), kOutside);
  }
  ASSERT_EQ(domain->components().size(), 1U);
  EXPECT_NEAR(domain->components()[0].volume_mm3, 4.0 / 3 * std::numbers::pi * std::pow(9.04, 3), 20);
}

TEST(VdbField, FarApartIsNotDense) {
  openvdb::initialize();
  auto grid = openvdb::FloatGrid::create(0);
  for (const int at : {0, 2000}) grid->fill(openvdb::CoordBBox::createCube(openvdb::Coord(at), 20), 1.0F);
  const test::TemporaryFile file("far_apart.vdb");
  test::write_grids(file.path(), {grid});
  const auto domain = vdb::make_domain(vdb::read_grid(file.path(), std::nullopt), {0.5, InsideSide::above, {}});
  EXPECT_EQ(domain->components().size(), 2U);
  Crossings crossings;
  domain->crossings({{-5, -5, -5}, {2030, 2030, 2030}}, crossings);
  EXPECT_EQ(crossings.size(), 4U);
  domain->crossings({{2010, -5, 10}, {2010, 2030, 10}}, crossings);
  EXPECT_TRUE(crossings.empty());
}

}  // namespace
}  // namespace scantet
