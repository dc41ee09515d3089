// Cubes of a grid in which interval arithmetic shows the formula to keep its sign are found once; what a segment has in
// them has no crossing. The rest of it is halved until each piece is settled: the formula's interval excludes 0 (no
// crossing), or that of its derivative does (monotone: a crossing if the signs at the ends differ, and none if not), or
// the mean value theorem rules 0 out, or the piece is as short as asked for. Whatever settles a piece, a crossing is
// put out if and only if the signs at its ends differ, as the formula on doubles gives them: that is what region_at
// sees, so that rounding cannot make the two disagree. A crossing itself is found by Chandrupatla's method (1997),
// which brackets it to the last digit.
#include "crossing_search.h"

#include <utility>

namespace implicit {
namespace {

using scantet::Point;

constexpr int kMostPieces = 20'000;
constexpr double kTightened = 4.5;  // cubes along blocks whose values are looked at twice
constexpr int kCubes = 64;          // along the longest edge of the box: 256 KiB at most

class Search {
 public:
  Search(const Formula& formula, const scantet::ClearanceGrid& clear, const scantet::Segment& segment,
         scantet::Crossings& out)
      : formula_(formula), clear_(clear), segment_(segment), along_(segment.target - segment.source), out_(out) {}

  /// False if that takes more than kMostPieces.
  bool run(double shortest) {
    shortest_ = shortest;
    pieces_ = 0;
    out_.clear();
    bool settled = true;
    double begin = 0;  // of a stretch of cubes that are not clear; empty at first
    double end = 0;
    const auto settle_stretch = [&] {
      if (begin < end) settled = settled && settle({begin, value_at(begin)}, {end, value_at(end)});
    };
    clear_.walk(segment_, [&](std::size_t, double enter, double leave) {
      if (enter > end) {
        settle_stretch();
        begin = enter;
      }
      end = leave;
    });
    settle_stretch();
    return settled;
  }

 private:
  struct Place {
    double t;
    double value;
    bool inside() const { return value < 0; }
  };

  Point point_at(double t) const {
    return t == 1 ? segment_.target : scantet::lerp(segment_.source, segment_.target, t);
  }
  double value_at(double t) const {
    const Point p = point_at(t);
    return formula_(p.x, p.y, p.z);
  }
  /// Holds the coordinate of point_at(t) for each t from `begin` to `end`.
  Interval coordinate(int axis, double begin, double end) const {
    const double source = segment_.source[axis];
    const Interval sweep = Interval{source, source} + Interval{along_[axis], along_[axis]} * Interval{begin, end};
    const double target = segment_.target[axis];
    return end == 1 ? hull(sweep, {target, target}) : sweep;
  }
  Interval values(double begin, double end) const {
    return formula_(coordinate(0, begin, end), coordinate(1, begin, end), coordinate(2, begin, end));
  }
  Slope slopes(double begin, double end) const {
    const auto moving = [&](int axis) {
      return Slope{coordinate(axis, begin, end), outward(along_[axis], along_[axis])};
    };
    return formula_(moving(0), moving(1), moving(2));
  }

  bool settle(const Place& begin, const Place& end) {
    if (++pieces_ > kMostPieces) return false;
    const bool crosses = begin.inside() != end.inside();
    if (!crosses && values(begin.t, end.t).excludes_zero()) return true;
    const Slope slope = slopes(begin.t, end.t);
    const double t = 0.5 * (begin.t + end.t);
    if (slope.rate.excludes_zero() || end.t - begin.t <= shortest_) return finish(begin, end);
    const Interval half{begin.t - t, end.t - t};
    if ((values(t, t) + slope.rate * half).excludes_zero()) return finish(begin, end);
    const Place middle{t, value_at(t)};
    return settle(begin, middle) && settle(middle, end);
  }

  bool finish(const Place& begin, const Place& end) {
    if (begin.inside() != end.inside()) {
      const scantet::Region from = begin.inside() ? 1 : scantet::kOutside;
      out_.push_back({point_at(root(begin, end)), from, 1 - from});
    }
    return true;
  }

  double root(const Place& begin, const Place& end) const;

  const Formula& formula_;
  const scantet::ClearanceGrid& clear_;
  const scantet::Segment& segment_;
  const scantet::Vec along_;
  scantet::Crossings& out_;
  double shortest_ = 0;
  int pieces_ = 0;
};

double Search::root(const Place& begin, const Place& end) const {
  constexpr double kUlp = std::numeric_limits<double>::epsilon();
  constexpr int kMostSteps = 200;
  Place a = begin;
  Place b = end;
  double share = 0.5;  // of the way from a to b
  for (int step = 0; step < kMostSteps; ++step) {
    Place next{a.t + share * (b.t - a.t), 0};
    next.value = value_at(next.t);
    Place left = a;  // what leaves the bracket
    if (next.inside() != a.inside()) left = std::exchange(b, a);
    a = next;
    const double closest = 0.5 * kUlp / std::abs(b.t - a.t);
    if (closest > 0.5 || a.value == 0) break;
    // Inverse quadratic interpolation where it is safe, bisection elsewhere.
    const double xi = (a.t - b.t) / (left.t - b.t);
    const double phi = (a.value - b.value) / (left.value - b.value);
    share = 0.5;
    if (phi > 1 - std::sqrt(1 - xi) && phi < std::sqrt(xi)) {
      share = a.value / (b.value - a.value) * left.value / (b.value - left.value) +
              (left.t - a.t) / (b.t - a.t) * a.value / (left.value - a.value) * b.value / (left.value - b.value);
    }
    share = std::clamp(share, closest, 1 - closest);
  }
  return std::abs(a.value) <= std::abs(b.value) ? a.t : b.t;
}

/// The formula's values in a box by the mean value theorem: tighter than its interval where terms cancel. It speaks of
/// exact values, so it is widened by far more than rounding comes to: that is seen in the interval at the centre, and
/// changes within the box no faster than the values do.
Interval values_by_slopes(const Formula& formula, const scantet::Box& box) {
  const scantet::Point center = box.center();
  const auto range = [&](int axis) { return Interval{box.min[axis], box.max[axis]}; };
  const auto point = [&](int axis) { return Interval{center[axis], center[axis]}; };
  Interval values = formula(point(0), point(1), point(2));
  constexpr double kSlack = 1e-6;
  constexpr double kManyRoundings = 0x1p20;
  const double rounding = values.hi - values.lo;
  for (int moving = 0; moving < 3; ++moving) {
    const auto variable = [&](int axis) {
      const double rate = axis == moving ? 1 : 0;
      return Slope{range(axis), {rate, rate}};
    };
    const Slope slope = formula(variable(0), variable(1), variable(2));
    values = values + slope.rate * (range(moving) - point(moving));
  }
  const double doubt = kSlack * (values.hi - values.lo) + rounding * kManyRoundings;
  return values + Interval{-doubt, doubt};
}

}  // namespace

scantet::ClearanceGrid clearance_of(const Formula& formula, const scantet::Box& box) {
  const scantet::CubeGrid cubes(box, kCubes);
  return {cubes, scantet::find_states(cubes, [&](const scantet::Box& part) {
            const auto range = [&](int axis) { return Interval{part.min[axis], part.max[axis]}; };
            Interval values = formula(range(0), range(1), range(2));
            const scantet::Vec extent = part.extent();
            const double longest = std::max({extent.x, extent.y, extent.z});
            const bool is_cube = longest < 1.1 * std::min({extent.x, extent.y, extent.z});
            const bool is_small = longest < kTightened * cubes.edge_mm;
            if (is_cube && is_small && !values.excludes_zero()) values = values_by_slopes(formula, part);
            if (values.lo >= 0) return scantet::CubeState::outside;
            return values.hi < 0 ? scantet::CubeState::inside : scantet::CubeState::near;
          })};
}

void find_crossings(const Formula& formula, const scantet::ClearanceGrid& clear, const scantet::Segment& segment,
                    scantet::Crossings& out) {
  Search search(formula, clear, segment, out);
  for (const double shortest : {1e-12, 1e-9, 1e-6}) {
    if (search.run(shortest)) return;
  }
  search.run(1e-3);  // no more than 2,048 pieces
}

}  // namespace implicit
