#include <cmath>

#include "contract/domain_contract.h"
#include "scantet/image/kept_components.h"
#include "scantet/image/nested_level_sets.h"
#include "unit/frames.h"

namespace scantet {
namespace {

using test::flipped_and_sheared;
using test::oblique;
using test::plain;

/// A scan of random blobs (smooth) or of noise (every cell a mess), in some frame.
template <class Voxel>
Scan random_scan(const Frame& frame, bool noise, unsigned seed) {
  const std::array<int, 3> size{17, 13, 11};
  auto voxels = std::make_shared<std::vector<Voxel>>();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        const double wave = 0.5 + 0.25 * (std::sin(0.9 * i) * std::cos(0.8 * j) + std::sin(1.1 * k + 0.5 * i));
        voxels->push_back(static_cast<Voxel>(100 * (noise ? unit(random) : wave)));
      }
    }
  }
  const auto [min, max] = std::minmax_element(voxels->begin(), voxels->end());
  Scan scan{size, frame, voxels->data(), voxels, static_cast<double>(*min), static_cast<double>(*max), "", ""};
  return scan;
}

template <class Voxel>
DomainCase level_set_case(const char* name, Frame (*frame)(), bool noise, InsideSide side) {
  return {name, [=]() { return make_level_set(random_scan<Voxel>(frame(), noise, 7), {50, side, std::nullopt}); }};
}

template <class Voxel>
DomainCase nested_case(const char* name, Frame (*frame)(), bool noise, InsideSide side, std::vector<double> levels) {
  return {name, [=]() {
            return make_nested_level_sets(random_scan<Voxel>(frame(), noise, 7), {levels, side, std::nullopt});
          }};
}

/// The largest components of each level alone.
template <class Voxel>
DomainCase kept_case(const char* name, Frame (*frame)(), InsideSide side, std::vector<double> levels,
                     std::uint64_t count) {
  return {name, [=]() {
            const Scan scan = random_scan<Voxel>(frame(), true, 7);
            const NestedLevelSettings settings{levels, side, std::nullopt};
            return make_kept_level_sets(scan, settings, keep_components(scan, settings, {count, 0}), 0).domain;
          }};
}

INSTANTIATE_TEST_SUITE_P(
    Kept, DomainContract,
    ::testing::Values(kept_case<float>("OneNoisy", plain, InsideSide::above, {62}, 1),
                      kept_case<std::uint8_t>("TwoNoisyOblique", oblique, InsideSide::above, {70}, 2),
                      kept_case<std::int16_t>("BelowSheared", flipped_and_sheared, InsideSide::below, {35}, 3),
                      kept_case<double>("OfTwoLevels", oblique, InsideSide::above, {55, 80}, 2)));

INSTANTIATE_TEST_SUITE_P(
    Nested, DomainContract,
    ::testing::Values(
        nested_case<float>("TwoSmooth", plain, false, InsideSide::above, {40, 60}),
        nested_case<float>("TwoNoisyOblique", oblique, true, InsideSide::above, {80, 50}),
        nested_case<double>("ThreeNoisySheared", flipped_and_sheared, true, InsideSide::above, {20, 50, 51}),
        nested_case<std::uint8_t>("ThreePlateaus", oblique, true, InsideSide::above, {40, 50, 60.5}),
        nested_case<std::int16_t>("ThreeSmoothBelow", flipped_and_sheared, false, InsideSide::below, {50, 30, 70}),
        nested_case<double>("TwoThatNearlyTouch", plain, true, InsideSide::above, {50, 50.001})),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    LevelSet, DomainContract,
    ::testing::Values(level_set_case<float>("SmoothFloat", plain, false, InsideSide::above),
                      level_set_case<float>("NoisyFloatOblique", oblique, true, InsideSide::above),
                      level_set_case<double>("NoisyDoubleFlippedSheared", flipped_and_sheared, true, InsideSide::above),
                      level_set_case<std::uint8_t>("PlateausUint8", oblique, true, InsideSide::above),
                      level_set_case<std::int16_t>("SmoothInt16Below", flipped_and_sheared, false, InsideSide::below),
                      level_set_case<std::uint64_t>("NoisyUint64Below", plain, true, InsideSide::below)),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace scantet
