// Which sizes are tried where something is wrong with a mesh.
#include "scantet/app/trouble_spots.h"

#include <gtest/gtest.h>

namespace scantet {
namespace {

constexpr double kSize = 2;

TroubleSpots spots() {
  return TroubleSpots(std::make_shared<UniformSize>(kSize));
}

double size_at(const TroubleSpots& spots, const Point& p) {
  return FinerSize(std::make_shared<UniformSize>(kSize), spots.places()).size_at(p);
}

/// An element as large as the size allows.
FinerPlace element(const Point& p) {
  return {p, kSize};
}

std::vector<FinerPlace> crowd(std::size_t count, const Point& around) {
  std::vector<FinerPlace> elements;
  for (std::size_t i = 0; i < count; ++i)
    elements.push_back(element(around + Vec{0.01 * static_cast<double>(i), 0, 0}));
  return elements;
}

TEST(TroubleSpots, FaultsSideBySideAreOne) {
  TroubleSpots none = spots();
  EXPECT_EQ(none.judge({}), 0U);
  EXPECT_FALSE(none.choose(false));
  EXPECT_TRUE(none.places().empty());
  TroubleSpots some = spots();
  EXPECT_EQ(some.judge({{{0, 0, 0}, {50, 0, 0}}, {element({3.9, 0, 0}), element({7.8, 0, 0}), element({11.9, 0, 0})}}),
            3U);
}

TEST(TroubleSpots, WhereAHandleMayBeWrongTheSizeIsFinerButNoSpotIsCounted) {
  TroubleSpots some = spots();
  EXPECT_EQ(some.judge({{{0, 0, 0}}, {}, {{1, 0, 0}, {50, 0, 0}, {90, 0, 0}}}), 1U);
  EXPECT_TRUE(some.choose(false));
  EXPECT_LT(size_at(some, {50, 0, 0}), kSize);
}

TEST(TroubleSpots, TheSizeIsHalvedUntilASpotIsMended) {
  TroubleSpots spot = spots();
  for (const double size : {1.0, 0.5, 0.25}) {
    spot.judge({{}, {element({1, 2, 3})}});
    EXPECT_TRUE(spot.choose(false));
    EXPECT_EQ(size_at(spot, {1, 2, 3}), size);
  }
  EXPECT_EQ(spot.judge({}), 0U);
  EXPECT_FALSE(spot.choose(false));
  EXPECT_EQ(size_at(spot, {1, 2, 3}), 0.25) << "it stays so";
  EXPECT_EQ(spot.outlook(), (TroubleSpots::Outlook{0, 0}));
}

TEST(TroubleSpots, PlacesWhereSomethingWasMendedAreToldFromOthers) {
  TroubleSpots two = spots();
  two.judge({{{0, 0, 0}, {50, 0, 0}}, {}});
  EXPECT_TRUE(two.choose(false));
  two.judge({{{50, 0, 0}}, {}});
  const std::vector<FinerPlace> mended = two.places_without_faults();
  ASSERT_EQ(mended.size(), 1U);
  EXPECT_EQ(mended[0].point.x, 0);
  EXPECT_EQ(two.places().size(), 2U);
}

TEST(TroubleSpots, FaultsCloseTogetherShareAPlace) {
  TroubleSpots spot = spots();
  const Point first{5, 5, 5};
  for (const double size : {1.0, 0.5}) {
    spot.judge({{}, crowd(100, first)});
    EXPECT_TRUE(spot.choose(false));
    EXPECT_LT(spot.places().size(), 15U);
    for (const FinerPlace& fault : crowd(100, first)) EXPECT_LT(size_at(spot, fault.point), 1.6 * size);
  }
}

TEST(TroubleSpots, WhereHalvingOnlyMakesMoreOtherSizesAreTriedAndTheBestIsTaken) {
  TroubleSpots spot = spots();
  const Point place{5, 5, 5};
  spot.judge({{}, {element(place)}});
  EXPECT_TRUE(spot.choose(false));
  spot.judge({{}, crowd(5, place)});
  EXPECT_TRUE(spot.choose(false));
  EXPECT_LT(size_at(spot, place), 1) << "once may be chance";
  spot.judge({{}, crowd(10, place)});
  EXPECT_TRUE(spot.choose(false));
  EXPECT_EQ(size_at(spot, place), 0.7 * kSize);
  spot.judge({{}, crowd(3, place)});
  EXPECT_TRUE(spot.choose(false));
  EXPECT_EQ(size_at(spot, place), 0.35 * kSize);
  EXPECT_EQ(spot.outlook(), (TroubleSpots::Outlook{1, 1}));
  spot.judge({{}, crowd(4, place)});
  EXPECT_TRUE(spot.choose(false));
  EXPECT_EQ(size_at(spot, place), kSize) << "one fault was left there";
  spot.judge({{}, {element(place)}});
  EXPECT_FALSE(spot.choose(false));
  spot.judge({{}, crowd(2, place)});
  EXPECT_TRUE(spot.choose(false));
  EXPECT_EQ(size_at(spot, place), kSize / 2) << "more is left of it now, so it is taken on anew";
}

TEST(TroubleSpots, ElementsSmallerThanTheSizeBecomeHalfAsLarge) {
  TroubleSpots spot = spots();
  spot.judge({{}, {{{0, 0, 0}, 0.75 * kSize}, {{50, 0, 0}, 0.01 * kSize}}});
  EXPECT_TRUE(spot.choose(false));
  EXPECT_EQ(size_at(spot, {0, 0, 0}), 0.75 * kSize / 2);
  EXPECT_EQ(size_at(spot, {50, 0, 0}), kSize / 4) << "tiny ones are taken to be half of the size";
  TroubleSpots close = spots();
  close.judge({{}, {{{0, 0, 0}, 0.1 * kSize}}, {}, 0.05});
  EXPECT_TRUE(close.choose(false));
  EXPECT_EQ(size_at(close, {0, 0, 0}), 0.1 * kSize / 2) << "if they may be so small";
}

TEST(TroubleSpots, FarMoreFaultsEndTheHalvingAtOnce) {
  TroubleSpots spot = spots();
  spot.judge({{}, {element({0, 0, 0})}});
  spot.choose(false);
  spot.judge({{}, crowd(21, {0, 0, 0})});
  spot.choose(false);
  EXPECT_EQ(size_at(spot, {0, 0, 0}), 0.7 * kSize);
}

TEST(TroubleSpots, ALossCountsMoreThanAnyElements) {
  TroubleSpots spot = spots();
  spot.judge({{{0, 0, 0}}, {}});
  spot.choose(false);
  spot.judge({{}, crowd(2, {0, 0, 0})});
  spot.choose(true);
  EXPECT_EQ(size_at(spot, {0, 0, 0}), 1) << "nothing was lost at half the size";
}

TEST(TroubleSpots, InTheEndEachHasWhatWasBest) {
  TroubleSpots two = spots();
  const Point good{0, 0, 0};
  const Point bad{100, 0, 0};
  two.judge({{}, {element(good), element(bad)}});
  two.choose(false);
  two.judge({{}, crowd(9, bad)});
  EXPECT_TRUE(two.choose(true));
  EXPECT_EQ(size_at(two, good), 1);
  EXPECT_EQ(size_at(two, bad), kSize);
}

TEST(TroubleSpots, WhatComesLaterIsASpotOfItsOwnOrOfOneThatWas) {
  TroubleSpots some = spots();
  some.judge({{}, {element({0, 0, 0})}});
  some.choose(false);
  EXPECT_EQ(some.judge({{}, {element({1, 0, 0}), element({-3.9, 0, 0}), element({20, 0, 0})}}), 2U);
  some.choose(false);
  EXPECT_EQ(size_at(some, {20, 0, 0}), 1);
  EXPECT_EQ(size_at(some, {1, 0, 0}), 1) << "half of what it was there";
}

}  // namespace
}  // namespace scantet
