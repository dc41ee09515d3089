#include "scantet/field/cell_walk.h"

#include <gtest/gtest.h>

#include <random>

#include "scantet/field/sign_pyramid.h"
#include "unit/image/test_scan.h"

namespace scantet {
namespace {

const std::array<int, 3> kSize{19, 41, 9};

/// Walks in blocks of 2^shift cells and checks that the pieces join up and lie in their blocks.
void expect_sound_walk(const Vec& from, const Vec& to, int shift) {
  SCOPED_TRACE(testing::Message() << from.x << ' ' << from.y << ' ' << from.z << " to " << to.x << ' ' << to.y << ' '
                                  << to.z << " shift " << shift);
  constexpr double kRounding = 1e-11;
  int steps = 0;
  Vec reached = from;
  for (CellWalk walk(from, to, kSize);; walk.advance()) {
    if (shift == 0) {
      walk.find_exit();
    } else {
      walk.find_exit_of_block(shift);
    }
    ASSERT_EQ(walk.entry(), reached);
    reached = walk.exit();
    for (int axis = 0; axis < 3; ++axis) {
      const int low = ((walk.cell()[axis] + 1) >> shift << shift) - 1;
      ASSERT_GE(walk.cell()[axis], -1);
      ASSERT_LT(walk.cell()[axis], kSize[axis]);
      for (const Vec& p : {walk.entry(), walk.exit()}) {
        ASSERT_GE(p[axis], low - kRounding);
        ASSERT_LE(p[axis], low + (1 << shift) + kRounding);
      }
    }
    ASSERT_LE(++steps, kSize[0] + kSize[1] + kSize[2] + 4);
    if (walk.last()) break;
  }
  EXPECT_EQ(reached, to);
}

TEST(CellWalk, RandomSegments) {
  std::mt19937 random(5);
  for (int i = 0; i < 3000; ++i) {
    const Vec from = test::random_index(kSize, random);
    const Vec to = test::random_index(kSize, random);
    for (const int shift : {0, 3, 5}) expect_sound_walk(from, to, shift);
  }
}

TEST(CellWalk, SegmentsBetweenNodesAndHalfNodes) {
  std::mt19937 random(6);
  const auto snapped = [&] {
    const Vec p = test::random_index(kSize, random);
    return Vec{std::round(p.x), std::round(2 * p.y) / 2, std::round(p.z)};
  };
  for (int i = 0; i < 3000; ++i) {
    const Vec from = snapped();
    Vec to = snapped();
    if (i % 3 == 0) to.x = from.x;
    if (i % 4 == 0) to.y = from.y;
    if (i % 5 == 0) to = from;
    for (const int shift : {0, 3, 5}) expect_sound_walk(from, to, shift);
  }
}

TEST(CellWalk, DiagonalGoesThroughNodesInOneStep) {
  int cells = 0;
  for (CellWalk walk({0, 0, 0}, {5, 5, 5}, kSize);; walk.advance()) {
    EXPECT_EQ(walk.cell(), (CellIndex{cells, cells, cells}));
    ++cells;
    walk.find_exit();
    if (walk.last()) break;
  }
  EXPECT_EQ(cells, 5);
}

TEST(ClipToPaddedBox, CutsEndsExactlyOntoTheBox) {
  Vec a{-2e4, 3.25, 4};
  Vec b{3e4, 3.25, 4};
  ASSERT_TRUE(clip_to_padded_box(a, b, kSize));
  EXPECT_EQ(a, (Vec{-1, 3.25, 4}));
  EXPECT_EQ(b, (Vec{19, 3.25, 4}));
  a = {5, 6, 7};
  b = {5, 6, 7.5};
  ASSERT_TRUE(clip_to_padded_box(a, b, kSize));
  EXPECT_EQ(a, (Vec{5, 6, 7}));
  EXPECT_EQ(b, (Vec{5, 6, 7.5}));
}

TEST(ClipToPaddedBox, NothingLeft) {
  const auto clips = [](Vec a, Vec b) { return clip_to_padded_box(a, b, kSize); };
  EXPECT_FALSE(clips({-5, 0, 0}, {-2, 0, 0}));
  EXPECT_FALSE(clips({-5, -1.5, 0}, {50, -1.5, 0}));
  EXPECT_FALSE(clips({-3, 39, 0}, {20, 130, 0}));
  EXPECT_FALSE(clips({-3, -3, -3}, {-3, -3, -3}));
  EXPECT_FALSE(clips({0, 0, 0}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}));
  EXPECT_FALSE(clips({0, 0, 0}, {0, std::numeric_limits<double>::infinity(), 0}));
}

TEST(SignPyramid, AgreesWithTheNodesOfEachBlock) {
  const Scan scan = test::noisy_ball<float>({70, 45, 38}, Frame());
  const auto* voxels = std::get<const float*>(scan.voxels);
  for (const InsideSide side : {InsideSide::above, InsideSide::below}) {
    const PaddedGrid<float> grid = padded_grid(scan, voxels, {50, side, side == InsideSide::above ? 0.0 : 100.0});
    const SignPyramid pyramid(grid);
    const auto sign_by_nodes = [&](const CellIndex& cell, int shift) {
      int inside = 0;
      int outside = 0;
      CellIndex first;
      CellIndex last;
      for (int axis = 0; axis < 3; ++axis) {
        first[axis] = ((cell[axis] + 1) >> shift << shift) - 1;
        last[axis] = std::min(first[axis] + (1 << shift), grid.size[axis]);
      }
      for (int k = first[2]; k <= last[2]; ++k) {
        for (int j = first[1]; j <= last[1]; ++j) {
          for (int i = first[0]; i <= last[0]; ++i) ++(grid.height(i, j, k) > 0 ? inside : outside);
        }
      }
      return inside > 0 && outside > 0 ? BlockSign::mixed : inside > 0 ? BlockSign::inside : BlockSign::outside;
    };
    int uniform = 0;
    for (int k = -1; k < grid.size[2]; k += 3) {
      for (int j = -1; j < grid.size[1]; j += 3) {
        for (int i = -1; i < grid.size[0]; i += 3) {
          ASSERT_EQ(pyramid.small({i, j, k}), sign_by_nodes({i, j, k}, kSmallShift));
          ASSERT_EQ(pyramid.fine({i, j, k}), sign_by_nodes({i, j, k}, kFineShift));
          ASSERT_EQ(pyramid.coarse({i, j, k}), sign_by_nodes({i, j, k}, kCoarseShift));
          uniform += pyramid.fine({i, j, k}) != BlockSign::mixed;
        }
      }
    }
    EXPECT_GT(uniform, 0);
  }
}

TEST(SignPyramid, BetweenIsWhatTheSmallBlocksOfTheBoxSay) {
  const Scan scan = test::noisy_ball<float>({70, 45, 38}, Frame());
  const PaddedGrid<float> grid = padded_grid(scan, std::get<const float*>(scan.voxels), {50, {}, 0.0});
  const SignPyramid pyramid(grid);
  const auto by_small_blocks = [&](const CellIndex& a, const CellIndex& b) {
    bool all_inside = true;
    bool all_outside = true;
    const auto low = [&](int axis) { return std::min(a[axis], b[axis]); };
    const auto high = [&](int axis) { return std::max(a[axis], b[axis]); };
    for (int axis = 0; axis < 3; ++axis) {
      if (((high(axis) + 1) >> 3) - ((low(axis) + 1) >> 3) > 1) return BlockSign::mixed;
    }
    for (int k = low(2); k <= high(2); ++k) {
      for (int j = low(1); j <= high(1); ++j) {
        for (int i = low(0); i <= high(0); ++i) {
          all_inside = all_inside && pyramid.small({i, j, k}) == BlockSign::inside;
          all_outside = all_outside && pyramid.small({i, j, k}) == BlockSign::outside;
        }
      }
    }
    return all_inside ? BlockSign::inside : all_outside ? BlockSign::outside : BlockSign::mixed;
  };
  std::mt19937 random(7);
  std::array<int, 3> met{};
  for (int n = 0; n < 20000; ++n) {
    const Vec from = test::random_index(grid.size, random);
    Vec to = from + std::uniform_real_distribution<double>(0, 14)(random) * test::random_direction(random);
    for (int axis = 0; axis < 3; ++axis) to[axis] = std::clamp(to[axis], -1.0, double(grid.size[axis]));
    const CellIndex a = cell_of(from, grid.size);
    const CellIndex b = cell_of(to, grid.size);
    ASSERT_EQ(pyramid.between(a, b), by_small_blocks(a, b));
    ++met[static_cast<std::size_t>(pyramid.between(a, b))];
  }
  for (const int count : met) EXPECT_GT(count, 500);
}

template <class Voxel>
void expect_row_signs_of_heights() {
  const Scan scan = test::noisy_ball<Voxel>({131, 9, 3}, Frame());
  for (const double level : {-1e12, 7.0, 49.5, 50.0, 3e9}) {
    for (const InsideSide side : {InsideSide::above, InsideSide::below}) {
      const double outside = side == InsideSide::above ? level - 1 : level + 1;
      const PaddedGrid<Voxel> grid = padded_grid(scan, std::get<const Voxel*>(scan.voxels), {level, side, outside});
      std::vector<std::uint64_t> words(grid.row_words());
      for (int k = -1; k <= grid.size[2]; ++k) {
        for (int j = -1; j <= grid.size[1]; ++j) {
          grid.row_signs(j, k, words.data());
          for (int i = -1; i < static_cast<int>(64 * words.size()) - 1; ++i) {
            ASSERT_EQ(words[(i + 1) / 64] >> (i + 1) % 64 & 1, grid.height(i, j, k) > 0 ? 1U : 0U)
                << level << ": " << i << ' ' << j << ' ' << k;
          }
        }
      }
    }
  }
}

TEST(PaddedGrid, RowSignsAreThoseOfTheHeights) {
  expect_row_signs_of_heights<std::int8_t>();
  expect_row_signs_of_heights<std::uint8_t>();
  expect_row_signs_of_heights<std::int16_t>();
  expect_row_signs_of_heights<std::uint64_t>();
  expect_row_signs_of_heights<float>();
}

}  // namespace
}  // namespace scantet
