// Cubes in which the formula's interval excludes 0 are clear. For each of the others the formula is expanded around the
// centre, with the intervals of its derivatives in the cube: what that bounds, it bounds to second order in the cube's
// edge, so that most questions about points and segments of the cube need the formula no more.
//
// The mean value theorem speaks of exact values, and the answers are about values on doubles. So the value at the
// centre is widened by far more than rounding comes to: that is seen in the interval at the centre, and changes within
// the cube no faster than the values do.
#include "formula_grid.h"

#include "scantet/base/parallel.h"

namespace implicit {
namespace {

using scantet::Box;
using scantet::CubeState;

constexpr int kCubes = 64;       // along the longest edge of the box
constexpr double kSlack = 1e-6;  // of the values in the cube
constexpr double kManyRoundings = 0x1p20;
constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// A float below x, by enough for sums of products with it to hold what they should, rounding included.
float below(double x) {
  if (x == 0) return 0;
  const auto nearest = static_cast<float>(x);
  constexpr float kLeast = std::numeric_limits<float>::min();
  if (std::abs(nearest) < kLeast) return x > 0 ? 0 : -kLeast;
  return std::nextafter(nearest, -kInfinite);
}
float above(double x) {
  return -below(-x);
}

CubeState state_by(const Interval& values) {
  if (values.lo >= 0) return CubeState::outside;
  return values.hi < 0 ? CubeState::inside : CubeState::near;
}

struct Expansion {
  CubeModel model;
  Interval values;  // in the whole cube
};

Expansion expand(const Formula& formula, const Box& cube) {
  const scantet::Point middle = cube.center();
  CubeModel model;
  std::array<Interval, 3> around;
  std::array<Interval, 3> at;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    model.center[i] = static_cast<float>(middle[axis]);
    at[i] = {model.center[i], model.center[i]};
    around[i] = hull(at[i], {cube.min[axis], cube.max[axis]});
  }
  const Interval one{1, 1};
  const Slopes slopes =
      formula(Slopes{around[0], {one, {}, {}}}, Slopes{around[1], {{}, one, {}}}, Slopes{around[2], {{}, {}, one}});
  const Interval value = formula(at[0], at[1], at[2]);
  const Gradient& rate = slopes.rate;
  const Interval range =
      value + rate.x * (around[0] - at[0]) + rate.y * (around[1] - at[1]) + rate.z * (around[2] - at[2]);
  const double doubt = kSlack * (range.hi - range.lo) + kManyRoundings * (value.hi - value.lo);
  if (!std::isfinite(doubt) || !std::isfinite(slopes.value.hi - slopes.value.lo)) {
    model.low = -kInfinite, model.high = kInfinite;
    model.least.fill(-kInfinite), model.most.fill(kInfinite);
    return {model, slopes.value};
  }
  model.low = below(value.lo - doubt);
  model.high = above(value.hi + doubt);
  model.least = {below(rate.x.lo), below(rate.y.lo), below(rate.z.lo)};
  model.most = {above(rate.x.hi), above(rate.y.hi), above(rate.z.hi)};
  return {model, range + Interval{-doubt, doubt}};
}

}  // namespace

FormulaGrid::FormulaGrid(const Formula& formula, const Box& box, const scantet::Progress& progress) {
  const scantet::CubeGrid cubes(box, kCubes);
  std::vector<CubeState> states = scantet::find_states(cubes, [&](const Box& part) {
    if (progress.cancelled()) return CubeState::outside;
    const auto range = [&](int axis) { return Interval{part.min[axis], part.max[axis]}; };
    return state_by(formula(range(0), range(1), range(2)));
  });
  std::vector<std::array<int, 3>> near;
  for (int z = 0; z < cubes.counts[2]; ++z) {
    for (int y = 0; y < cubes.counts[1]; ++y) {
      for (int x = 0; x < cubes.counts[0]; ++x) {
        if (states[cubes.index({x, y, z})] == CubeState::near) near.push_back({x, y, z});
      }
    }
  }
  std::vector<CubeModel> models(near.size());
  constexpr std::size_t kGrain = 256;
  scantet::parallel_for(near.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !progress.cancelled(); ++i) {
      const Expansion expansion = expand(formula, cubes.enlarged(near[i], near[i]));
      models[i] = expansion.model;
      states[cubes.index(near[i])] = state_by(expansion.values);
    }
  });
  stretches_.resize(states.size() / kStretch + 1);
  for (std::size_t i = 0; i < near.size(); ++i) {
    const std::size_t cube = cubes.index(near[i]);
    if (states[cube] != CubeState::near) continue;
    Stretch& stretch = stretches_[cube / kStretch];
    if (stretch.near == 0) stretch.first = static_cast<std::uint32_t>(models_.size());
    stretch.near |= std::uint64_t{1} << cube % kStretch;
    models_.push_back(models[i]);
  }
  clear_ = scantet::ClearanceGrid(cubes, states);
}

}  // namespace implicit
