// A sphere whose distance is known: what the grid calls clear must be, and a walk must leave out nothing that is not.
#include "scantet/domain/clearance_grid.h"

#include <gtest/gtest.h>

#include <random>

namespace scantet {
namespace {

const Box kBox{{-1, -2, -3}, {4, 3, 1}};
const Point kCenter{1, 0.5, -1};
constexpr double kRadius = 1.4;

double nearest(const Box& box) {
  Vec gap;
  for (int axis = 0; axis < 3; ++axis) {
    gap[axis] = std::max({box.min[axis] - kCenter[axis], kCenter[axis] - box.max[axis], 0.0});
  }
  return length(gap);
}

double farthest(const Box& box) {
  Vec reach;
  for (int axis = 0; axis < 3; ++axis) {
    reach[axis] = std::max(std::abs(box.min[axis] - kCenter[axis]), std::abs(box.max[axis] - kCenter[axis]));
  }
  return length(reach);
}

CubeState state_of(const Box& box) {
  if (nearest(box) > kRadius) return CubeState::outside;
  return farthest(box) < kRadius ? CubeState::inside : CubeState::near;
}

bool inside(const Point& p) {
  return distance(p, kCenter) < kRadius;
}

class ClearanceGridTest : public ::testing::TestWithParam<int> {
 protected:
  Point random_point(double share_outside) {
    std::uniform_real_distribution<double> unit(-share_outside, 1 + share_outside);
    const Vec e = kBox.extent();
    return kBox.min + Vec{unit(random_) * e.x, unit(random_) * e.y, unit(random_) * e.z};
  }

  const CubeGrid cubes_{kBox, GetParam()};
  const ClearanceGrid grid_{cubes_, find_states(cubes_, state_of)};
  std::mt19937 random_{1};
};

TEST_P(ClearanceGridTest, StatesAreTrue) {
  int clear = 0;
  for (int i = 0; i < 20000; ++i) {
    const Point p = random_point(0.2);
    const CubeState state = grid_.at(p).state;
    if (state == CubeState::near) continue;
    ++clear;
    EXPECT_EQ(state == CubeState::inside, inside(p));
  }
  EXPECT_GT(clear, GetParam() > 4 ? 12000 : 0);
}

// What a walk leaves out has the same side throughout, so the sphere is met in its stretches only.
TEST_P(ClearanceGridTest, AWalkLeavesOutWhatIsClearOnly) {
  for (int i = 0; i < 2000; ++i) {
    Segment segment{random_point(0.5), random_point(0.5)};
    if (i % 4 == 1) segment.target = segment.source + 0.01 * (segment.target - segment.source);
    if (i % 4 == 2) segment.target[i % 3] = segment.source[i % 3];
    if (i % 4 == 3) segment = {cubes_.center({0, 0, 0}), cubes_.center({i % 2, 1, 1})};  // through edges and corners
    std::vector<std::array<double, 2>> stretches;
    grid_.walk(segment, [&](std::size_t cube, double begin, double end) {
      EXPECT_LT(cube, cubes_.size());
      EXPECT_LE(begin, end);
      if (!stretches.empty()) {
        EXPECT_GE(begin, stretches.back()[1]);
      }
      stretches.push_back({begin, end});
    });
    const auto in_a_stretch = [&](double t) {
      return std::any_of(stretches.begin(), stretches.end(),
                         [&](const auto& s) { return s[0] - 1e-9 <= t && t <= s[1] + 1e-9; });
    };
    for (int k = 0; k <= 200; ++k) {
      const double t = k / 200.0;
      const double beyond = distance(lerp(segment.source, segment.target, t), kCenter) - kRadius;
      if (std::abs(beyond) < 1e-6) {
        EXPECT_TRUE(in_a_stretch(t));
      }
      if (k == 0) continue;
      const Point before = lerp(segment.source, segment.target, t - 1 / 200.0);
      if (inside(before) == (beyond < 0)) continue;
      bool met = false;
      for (int fine = 0; fine <= 20; ++fine) met = met || in_a_stretch(t - fine / 4000.0);
      EXPECT_TRUE(met) << "segment " << i << " at " << t;
    }
  }
}

TEST_P(ClearanceGridTest, ASegmentFarFromTheSphereIsClear) {
  int calls = 0;
  grid_.walk({{3.9, 2.9, -2.9}, {3.9, 2.9, 0.9}}, [&](std::size_t, double, double) { ++calls; });
  grid_.walk({{30, 20, 20}, {10, 20, 20}}, [&](std::size_t, double, double) { ++calls; });
  EXPECT_EQ(calls, 0);
}

INSTANTIATE_TEST_SUITE_P(Cubes, ClearanceGridTest, ::testing::Values(4, 17, 64));

}  // namespace
}  // namespace scantet
