// The segment is halved until each piece is settled: the formula's interval excludes 0 (no crossing), or that of its
// derivative does (monotone: a crossing if the signs at the ends differ, and none if not), or the mean value theorem
// rules 0 out, or the piece is as short as asked for. Whatever settles a piece, a crossing is put out if and only if
// the signs at its ends differ, as the formula on doubles gives them: that is what region_at sees, so that rounding
// cannot make the two disagree. A crossing itself is found by Chandrupatla's method (1997), which brackets it to the
// last digit.
#include "crossing_search.h"

#include <utility>

namespace implicit {
namespace {

using scantet::Point;

constexpr int kMostPieces = 20'000;

class Search {
 public:
  Search(const Formula& formula, const scantet::Segment& segment, scantet::Crossings& out)
      : formula_(formula), segment_(segment), along_(segment.target - segment.source), out_(out) {}

  /// False if that takes more than kMostPieces.
  bool run(double shortest) {
    shortest_ = shortest;
    pieces_ = 0;
    out_.clear();
    return settle({0, value_at(0)}, {1, value_at(1)});
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
    if (values(begin.t, end.t).excludes_zero()) return finish(begin, end);
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

}  // namespace

void find_crossings(const Formula& formula, const scantet::Segment& segment, scantet::Crossings& out) {
  Search search(formula, segment, out);
  for (const double shortest : {1e-12, 1e-9, 1e-6}) {
    if (search.run(shortest)) return;
  }
  search.run(1e-3);  // no more than 2,048 pieces
}

}  // namespace implicit
