// Where a cube of the grid is clear, or its model excludes 0 on all of the segment's piece in it, there is no crossing.
// Else the model tells what part of the piece is left, and whether the formula is monotone there. What is left open,
// where the segment nearly touches the surface, is halved until each part is settled: the formula's interval excludes 0
// (no crossing), or that of its derivative does (monotone), or the mean value theorem rules 0 out, or the part is as
// short as asked for. Whatever settles a part, a crossing is put out if and only if the signs at its ends differ, as
// the formula on doubles gives them: that is what region_at sees, so that rounding cannot make the two disagree.
//
// A crossing itself is found by Chandrupatla's method (1997), begun with a secant. It ends when the value, over the
// least slope, says that the root is as near as coordinates can tell, or else when the bracket does.
#include "crossing_search.h"

#include <utility>

namespace implicit {
namespace {

using scantet::Point;

constexpr int kMostPieces = 20'000;
constexpr double kUlp = std::numeric_limits<double>::epsilon();

class Search {
 public:
  Search(const Formula& formula, const FormulaGrid& grid, const scantet::Segment& segment, scantet::Crossings& out)
      : formula_(formula), grid_(grid), segment_(segment), along_(segment.target - segment.source), out_(out) {
    double farthest = 0;  // of the coordinates: their rounding is all the accuracy that there is
    double extent = 0;
    for (int axis = 0; axis < 3; ++axis) {
      farthest = std::max({farthest, std::abs(segment.source[axis]), std::abs(segment.target[axis])});
      extent = std::max(extent, std::abs(along_[axis]));
    }
    finest_ = kUlp * std::max(1.0, 2 * farthest / extent);
  }

  /// False if that takes more than kMostPieces.
  bool run(double shortest) {
    shortest_ = shortest;
    pieces_ = 0;
    out_.clear();
    bool settled = true;
    grid_.clear().walk(segment_, [&](std::size_t cube, double enter, double leave) {
      settled = settled && pass(grid_.model(cube), enter, leave);
    });
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

  Place place_at(double t) {
    if (t != last_.t) last_ = {t, value_at(t)};
    return last_;
  }

  /// False, as from settle, if there were too many pieces.
  bool pass(const CubeModel& model, double enter, double leave);

  bool settle(const Place& begin, const Place& end) {
    if (++pieces_ > kMostPieces) return false;
    const bool crosses = begin.inside() != end.inside();
    if (!crosses && values(begin.t, end.t).excludes_zero()) return true;
    const Slope slope = slopes(begin.t, end.t);
    const double t = 0.5 * (begin.t + end.t);
    if (slope.rate.excludes_zero()) return finish(begin, end, slope.rate);
    const Interval half{begin.t - t, end.t - t};
    if (end.t - begin.t <= shortest_ || (values(t, t) + slope.rate * half).excludes_zero()) return finish(begin, end);
    const Place middle{t, value_at(t)};
    return settle(begin, middle) && settle(middle, end);
  }

  bool finish(const Place& begin, const Place& end, const Interval& rate = kAllNumbers) {
    if (begin.inside() != end.inside()) {
      const scantet::Region from = begin.inside() ? 1 : scantet::kOutside;
      const double least = std::max({rate.lo, -rate.hi, 0.0});
      out_.push_back({point_at(root(begin, end, least * finest_)), from, 1 - from});
    }
    return true;
  }

  double root(const Place& begin, const Place& end, double small) const;

  const Formula& formula_;
  const FormulaGrid& grid_;
  const scantet::Segment& segment_;
  const scantet::Vec along_;
  scantet::Crossings& out_;
  double finest_ = 0;  // share of the segment that its points tell apart
  double shortest_ = 0;
  int pieces_ = 0;
  Place last_{-1, 0};
};

/// What is left is between zeros of chords: of the model's values, the lower end is concave, and so nowhere below its
/// chord, the upper end convex, and so nowhere above.
bool Search::pass(const CubeModel& model, double enter, double leave) {
  const Interval first = model.values_at(point_at(enter));
  const Interval last = model.values_at(point_at(leave));
  if ((first.lo > 0 && last.lo > 0) || (first.hi < 0 && last.hi < 0)) return true;
  const auto zero = [&](double from, double to) { return enter + from / (from - to) * (leave - enter); };
  double begin = enter;
  double end = leave;
  if (first.lo > 0) begin = zero(first.lo, last.lo);
  if (first.hi < 0) begin = zero(first.hi, last.hi);
  if (last.lo > 0) end = zero(first.lo, last.lo);
  if (last.hi < 0) end = zero(first.hi, last.hi);
  const Place from = place_at(begin);
  const Place to = place_at(std::max(begin, end));
  const Interval rate = model.change_along(along_);
  if (rate.excludes_zero()) return finish(from, to, rate);
  if (from.inside() == to.inside()) {
    // Away from 0 at one end and at the other; in between nearest to 0 where the steepest lines from both meet.
    const double falls = from.inside() ? rate.hi : -rate.lo;
    const double rises = from.inside() ? -rate.lo : rate.hi;
    const double a = std::abs(from.value);
    const double b = std::abs(to.value);
    const double length = to.t - from.t;
    const double nearest = (rises * a + falls * (b - rises * length)) / (falls + rises);
    if (nearest > model.high - model.low) return true;
  }
  return settle(from, to);
}

/// small: a value that can only be had within finest_ of the root.
double Search::root(const Place& begin, const Place& end, double small) const {
  constexpr int kMostSteps = 200;
  Place a = begin;
  Place b = end;
  double share = a.value / (a.value - b.value);  // of the way from a to b
  for (int step = 0; step < kMostSteps; ++step) {
    const double closest = 0.5 * finest_ / std::abs(b.t - a.t);
    if (closest > 0.5 || std::abs(a.value) <= small) break;
    share = share > closest ? std::min(share, 1 - closest) : closest;  // not a number: closest
    Place next{a.t + share * (b.t - a.t), 0};
    next.value = value_at(next.t);
    Place left = a;  // what leaves the bracket
    if (next.inside() != a.inside()) left = std::exchange(b, a);
    a = next;
    // Inverse quadratic interpolation where it is safe, bisection elsewhere.
    const double xi = (a.t - b.t) / (left.t - b.t);
    const double phi = (a.value - b.value) / (left.value - b.value);
    share = 0.5;
    if (phi > 1 - std::sqrt(1 - xi) && phi < std::sqrt(xi)) {
      share = a.value / (b.value - a.value) * left.value / (b.value - left.value) +
              (left.t - a.t) / (b.t - a.t) * a.value / (left.value - a.value) * b.value / (left.value - b.value);
    }
  }
  return std::abs(a.value) <= std::abs(b.value) ? a.t : b.t;
}

}  // namespace

void find_crossings(const Formula& formula, const FormulaGrid& grid, const scantet::Segment& segment,
                    scantet::Crossings& out) {
  Search search(formula, grid, segment, out);
  for (const double shortest : {1e-12, 1e-9, 1e-6}) {
    if (search.run(shortest)) return;
  }
  search.run(1e-3);  // no more than 2,048 pieces and one for each cube
}

}  // namespace implicit
