// Labels under a Gaussian: what is large stays, what is thin goes and is told.
#include "scantet/labels/label_gaussian.h"

#include <gtest/gtest.h>

#include "error_code.h"
#include "scantet/labels/label_object.h"
#include "scantet/labels/probability_field.h"
#include "unit/labels/label_scan.h"

namespace scantet {
namespace {

using test::label_scan;

LabelSettings gaussian(double mm) {
  LabelSettings settings;
  settings.smoothing = LabelSmoothing::gaussian;
  settings.gaussian_mm = mm;
  return settings;
}

/// A block of 1, a block of 2 beside it, and a sheet and a voxel of 3 and 4.
int blocks(int i, int j, int k) {
  if (i == 20 && j == 4 && k == 4) return 4;
  if (i == 17) return 3;
  if (std::min({i, j, k}) < 2 || std::max(j, k) > 11 || i > 13) return 0;
  return i < 8 ? 1 : 2;
}

TEST(LabelGaussian, LargePartsStayAndThinOnesAreTold) {
  Progress progress;
  LabelAccount account;
  const auto field = make_label_field(label_scan({24, 14, 14}, blocks), gaussian(1.2), progress, &account);
  EXPECT_EQ(account.lost, (std::vector<Region>{3, 4}));
  EXPECT_GT(account.changed, 14U * 14);
  ASSERT_EQ(account.phases.size(), 1U);
  EXPECT_EQ(account.phases[0].part, "label smoothing");
  EXPECT_EQ(field->region_at({5, 6, 6}), 1);
  EXPECT_EQ(field->region_at({10, 6, 6}), 2);
  EXPECT_EQ(field->region_at({7.49, 6, 6}), 1) << "a plane stays where it is";
  EXPECT_EQ(field->region_at({7.51, 6, 6}), 2);
  EXPECT_EQ(field->region_of_node(17, 6, 6), kOutside);
  std::uint64_t voxels = 0;
  for (const std::uint64_t count : field->voxels()) voxels += count;
  EXPECT_EQ(voxels, 24U * 14 * 14);
  EXPECT_EQ(field->region_of_node(2, 2, 2), kOutside) << "corners are rounded off";
}

TEST(LabelGaussian, SharesAreThoseOfTheWeights) {
  const Scan scan = label_scan({12, 8, 8}, [](int i, int, int) { return i < 6 ? 1 : 2; });
  const auto field = make_label_field(scan, gaussian(1));
  LabelCell cell;
  field->cell(5, 3, 3, cell);
  ASSERT_EQ(cell.count, 2U);
  double sum = 0;
  double below = 0;
  for (int n = -4; n <= 4; ++n) {
    const double weight = std::exp(-0.5 * n * n);
    sum += weight;
    if (n <= 0) below += weight;
  }
  EXPECT_NEAR(cell.values[0][0], below / sum, 2e-3) << "half of the space, and one voxel";
  EXPECT_NEAR(cell.values[0][0] + cell.values[1][0], 1, 2e-3);
}

TEST(LabelGaussian, WidthsAreInMmAndTheOutcomeIsTheSameInPieces) {
  const Scan fine = test::label_cells({30, 30, 30}, 6, Frame({Vec{0.5, 0, 0}, Vec{0, 0.5, 0}, Vec{0, 0, 0.5}}, {}));
  const Scan coarse = test::label_cells({30, 30, 30}, 6);
  const auto a = make_label_field(fine, gaussian(0.5));
  const auto b = make_label_field(coarse, gaussian(1));
  EXPECT_EQ(a->voxels(), b->voxels());
}

TEST(LabelGaussian, NothingLeftIsAnError) {
  const Scan scan = label_scan({9, 9, 9}, [](int i, int j, int k) { return i == 4 && j == 4 && k == 4 ? 1 : 0; });
  EXPECT_EQ(test::error_code([&] { make_label_field(scan, gaussian(2)); }), "input.labels");
}

TEST(LabelGaussian, WiderThanTheImageIsRefused) {
  const Scan scan = label_scan({30, 14, 14}, blocks);
  for (const double mm : {30.0, 1e6, 1e10, 1e300}) {
    EXPECT_EQ(test::error_code([&] { make_label_field(scan, gaussian(mm)); }), "usage.smooth") << mm;
  }
}

TEST(LabelObject, IsADomainWithItsVoxels) {
  Progress progress;
  LabelSettings settings;
  settings.names = {{2, "right"}};
  LabelObject object = make_label_object(label_scan({24, 14, 14}, blocks), settings, progress);
  EXPECT_EQ(object.domain->region_at({5, 6, 6}), 1);
  EXPECT_EQ(object.domain->name_of_region(2), "right");
  EXPECT_FALSE(object.domain->curves().empty());
  EXPECT_TRUE(object.lost.empty());
  object.domain.reset();
  EXPECT_EQ(object.grid().regions.size(), 4U);
}

/// Two tissues that fade into each other and into nothing along x, a voxel of 1 mm each.
std::vector<Scan> tissues(const Frame& second = {}) {
  std::vector<float> left;
  std::vector<float> right;
  for (int n = 0; n < 24 * 8 * 8; ++n) {
    const double x = n % 24;
    const double inside =
        std::min(n / 24 % 8, 7 - n / 24 % 8) > 0 ? std::clamp((12 - std::abs(x - 11.5)) / 4, 0.0, 1.0) : 0;
    const double share = std::clamp((x - 8) / 6, 0.0, 1.0);
    left.push_back(static_cast<float>(inside * (1 - share)));
    right.push_back(static_cast<float>(inside * share));
  }
  return {make_scan(std::move(left), {24, 8, 8}, {}), make_scan(std::move(right), {24, 8, 8}, second)};
}

TEST(TissueObject, TheLargestProbabilityWins) {
  Progress progress;
  const LabelObject object = make_tissue_object(tissues(), {{2, "right"}}, progress);
  const auto region = [&](double x) { return object.domain->region_at({x, 3.5, 3.5}); };
  EXPECT_EQ(region(8), 1);
  EXPECT_EQ(region(10.9), 1);
  EXPECT_EQ(region(11.1), 2) << "both are 0.5 at 11";
  EXPECT_EQ(region(21.4), 2);
  EXPECT_EQ(region(21.6), kOutside) << "the background has more than a half there";
  EXPECT_EQ(object.domain->name_of_region(2), "right");
  EXPECT_EQ(object.grid().regions.size(), 2U);
}

TEST(TissueObject, MapsThatAreNoneAreRefused) {
  const auto code = [](std::vector<Scan> maps) {
    Progress progress;
    return test::error_code([&] { make_tissue_object(maps, {}, progress); });
  };
  EXPECT_EQ(code(tissues(Frame({Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}}, {0.5, 0, 0}))), "input.grid");
  std::vector<Scan> maps = tissues();
  maps[1] = test::label_scan<std::uint16_t>({24, 8, 8}, [](int i, int, int) { return i; });
  EXPECT_EQ(code(maps), "input.probabilities");
  maps[1] = test::label_scan<std::uint8_t>({24, 8, 9}, [](int i, int, int) { return i; });
  EXPECT_EQ(code(maps), "input.grid");
  maps[1] = test::label_scan<std::uint8_t>({24, 8, 8}, [](int i, int, int) { return 10 * i; });
  EXPECT_EQ(code(maps), "") << "255ths";
  maps[0] = test::label_scan<std::uint8_t>({24, 8, 8}, [](int i, int, int) { return i < 12 ? 100 : 20; });
  maps[1] = test::label_scan<std::uint8_t>({24, 8, 8}, [](int i, int, int) { return i < 12 ? 0 : 5; });
  EXPECT_EQ(code(maps), "") << "percents, as 255ths leave nothing to a tissue";
  maps.resize(1);
  maps[0] = test::label_scan<std::uint8_t>({24, 8, 8}, [](int i, int, int) { return i; });
  EXPECT_EQ(code(maps), "input.probabilities") << "nowhere likely";
  EXPECT_EQ(code({}), "input.probabilities") << "no maps";
  EXPECT_EQ(test::error_code([&] { make_probability_field({}, MapUnits(), {}, Progress()); }), "input.probabilities");
}

TEST(ProbabilityField, ATissueThatIsNowhereTheMostLikelyIsKnown) {
  std::vector<Scan> maps = tissues();
  EXPECT_TRUE(regions_without_voxels(*make_probability_field(maps, Progress())).empty());
  std::vector<float> sheet;
  for (int n = 0; n < 24 * 8 * 8; ++n) sheet.push_back(n / 24 % 8 == 0 ? 0.45F : 0);
  maps.insert(maps.begin() + 1, make_scan(std::move(sheet), {24, 8, 8}, {}));
  const auto field = make_probability_field(maps, Progress());
  EXPECT_EQ(regions_without_voxels(*field), std::vector<Region>{2});
  EXPECT_EQ(field->regions().size(), 4U);
}

/// Bytes that grow along x from `low` to `high`.
Scan slope(int low, int high) {
  return test::label_scan<std::uint8_t>({24, 8, 8}, [&](int i, int, int) { return low + (high - low) * i / 23; });
}

TEST(ProbabilityField, UnitsAreThoseOfTheMapsAsTheyWereRead) {
  EXPECT_EQ(find_map_units(std::vector{slope(0, 250)}).divisors, std::vector<double>{255});
  const MapUnits percents = find_map_units(std::vector{slope(0, 100), slope(27, 0)});
  EXPECT_TRUE(percents.percents);
  EXPECT_EQ(percents.divisors, (std::vector<double>{100, 100}));
  const MapUnits mixed = find_map_units(std::vector{slope(0, 100), tissues()[1]});
  EXPECT_FALSE(mixed.percents);
  EXPECT_EQ(mixed.divisors, (std::vector<double>{255, 1}));
  const MapUnits masks = find_map_units(std::vector{slope(0, 1), slope(1, 0)});
  EXPECT_TRUE(masks.masks);
  EXPECT_FALSE(masks.percents);
  EXPECT_EQ(masks.divisors, (std::vector<double>{1, 1}));
  const std::vector<Region> one{1};
  const std::vector<Scan> low{slope(0, 120)};  // what a cut leaves of 255ths: by itself percents
  EXPECT_EQ(regions_without_voxels(*make_probability_field(low, {{100}, true}, one, Progress())),
            std::vector<Region>());
  EXPECT_EQ(test::error_code([&] { make_probability_field(low, {{255}}, one, Progress()); }), "input.probabilities");
}

TEST(ProbabilityField, MapsOfARegionAreAddedUp) {
  std::vector<Scan> maps;
  for (const float share : {0.25F, 0.45F, 0.25F}) {
    std::vector<float> values(512, share);
    values.front() = 0;
    maps.push_back(make_scan(std::move(values), {8, 8, 8}, {}));
  }
  const MapUnits units{{1, 1, 1}};
  const auto apart = make_probability_field(maps, units, std::vector<Region>{3, 5, 9}, Progress());
  EXPECT_EQ(apart->regions(), (std::vector<Region>{kOutside, 3, 5, 9}));
  EXPECT_EQ(apart->region_of_node(4, 4, 4), 5);
  const auto joined = make_probability_field(maps, units, std::vector<Region>{3, 5, 3}, Progress());
  EXPECT_EQ(joined->regions(), (std::vector<Region>{kOutside, 3, 5}));
  EXPECT_EQ(joined->region_of_node(4, 4, 4), 3) << "0.5 together";
}

TEST(ProbabilityField, SmoothedBytesKeepTheirUnit) {
  std::vector<float> smoothed;  // curvature flow passes the largest value by a little
  for (int n = 0; n < 24 * 8 * 8; ++n) smoothed.push_back(static_cast<float>(n % 24) * 11.5F - 4);
  const std::vector<Scan> maps{make_scan(std::move(smoothed), {24, 8, 8}, {})};
  const auto field = make_probability_field(maps, {{255}}, std::vector<Region>{1}, Progress());
  EXPECT_EQ(field->region_of_node(11, 4, 4), kOutside) << 122.5;
  EXPECT_EQ(field->region_of_node(12, 4, 4), 1) << 134;
  EXPECT_EQ(test::error_code([&] { make_probability_field(maps, Progress()); }), "input.probabilities") << "as read";
}

}  // namespace
}  // namespace scantet
