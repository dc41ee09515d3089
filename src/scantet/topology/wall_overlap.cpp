// On a line x = const both functions are linear in y, so what is wanted is a stretch of it, or nothing. Between the x
// where the kind of its ends changes, stretches make up a strip, whose Euler number is minus that of the open stretch
// with those of its ends that are no end of the line; at these x the stretches from both sides are looked at.
#include "scantet/topology/wall_overlap.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "scantet/base/trilinear.h"

namespace scantet {
namespace {

constexpr double kTolerance = 1e-9;

/// A function on the lines x = const: its value at their lower and upper ends, linear in x.
struct Bilinear {
  std::array<double, 2> low;  // at x = 0 and 1
  std::array<double, 2> high;

  explicit Bilinear(const std::array<double, 4>& corners) : low{corners[0], corners[1]}, high{corners[3], corners[2]} {}
  static double at(const std::array<double, 2>& ends, double x) { return (1 - x) * ends[0] + x * ends[1]; }
  static double slope(const std::array<double, 2>& ends) { return ends[1] - ends[0]; }
};

/// A closed stretch of a line; low == high: a point.
struct Stretch {
  double low;
  double high;
};

int euler_of(const Stretch& s) {
  const bool low_is_in = s.low > kTolerance && s.low < 1 - kTolerance;
  const bool high_is_in = s.high > kTolerance && s.high < 1 - kTolerance;
  if (s.high - s.low < kTolerance) return low_is_in ? 1 : 0;
  return (low_is_in ? 1 : 0) + (high_is_in ? 1 : 0) - 1;
}

class Overlap {
 public:
  Overlap(const std::array<double, 4>& a, const std::array<double, 4>& b) : functions_{Bilinear(a), Bilinear(b)} {
    for (const std::array<double, 4>* corners : {&a, &b}) {
      for (const double value : *corners) scale_ = std::max(scale_, std::abs(value));
    }
    for (const Bilinear& f : functions_) {
      add_root(f.low);
      add_root(f.high);
    }
    add_common_roots();
    std::sort(breaks_.begin(), breaks_.end());
    breaks_.erase(std::unique(breaks_.begin(), breaks_.end(), [](double p, double q) { return q - p < kTolerance; }),
                  breaks_.end());
  }

  int euler() const {
    int sum = 0;
    for (std::size_t n = 0; n <= breaks_.size(); ++n) {
      if (const auto strip = stretch_at(middle_of(n), middle_of(n))) sum -= euler_of(*strip);
      if (n < breaks_.size()) sum += euler_at(breaks_[n], middle_of(n), middle_of(n + 1));
    }
    return sum;
  }

  bool is_any() const {
    for (std::size_t n = 0; n <= breaks_.size(); ++n) {
      if (stretch_at(middle_of(n), middle_of(n))) return true;
    }
    return false;
  }

 private:
  /// Of a strip.
  double middle_of(std::size_t n) const {
    return 0.5 * ((n == 0 ? 0 : breaks_[n - 1]) + (n < breaks_.size() ? breaks_[n] : 1));
  }

  void add_break(double x) {
    if (x > kTolerance && x < 1 - kTolerance) breaks_.push_back(x);
  }
  void add_root(const std::array<double, 2>& ends) {
    if (ends[0] * ends[1] < 0) add_break(ends[0] / (ends[0] - ends[1]));
  }
  /// Where both are zero: low_a·high_b = high_a·low_b, a quadratic equation.
  void add_common_roots() {
    const auto& [a, b] = functions_;
    const auto product = [](const std::array<double, 2>& p, const std::array<double, 2>& q) {
      const double dp = Bilinear::slope(p);
      const double dq = Bilinear::slope(q);
      return std::array{p[0] * q[0], p[0] * dq + q[0] * dp, dp * dq};
    };
    const auto first = product(a.low, b.high);
    const auto second = product(a.high, b.low);
    const double c = first[0] - second[0];
    const double half = 0.5 * (first[1] - second[1]);
    const double square = first[2] - second[2];
    const double discriminant = half * half - square * c;
    if (discriminant < 0) return;
    const double w = -(half + std::copysign(std::sqrt(discriminant), half));
    if (square != 0) add_break(w / square);
    if (w != 0) add_break(c / w);
  }

  /// The stretch at x, with ends of the kinds that they have at x = kind, nearby or the same; none if it is empty
  /// there.
  std::optional<Stretch> stretch_at(double x, double kind) const {
    Stretch found{0, 1};
    for (const Bilinear& f : functions_) {
      const auto sign = [&](double value) { return std::abs(value) < kTolerance * scale_ ? 0 : value > 0 ? 1 : -1; };
      const int low = sign(Bilinear::at(f.low, kind));
      const int high = sign(Bilinear::at(f.high, kind));
      if (low <= 0 && high <= 0) return std::nullopt;
      if (low >= 0 && high >= 0) continue;
      double below = Bilinear::at(f.low, x);
      double above = Bilinear::at(f.high, x);
      if (sign(below) == 0 && sign(above) == 0) {
        below = Bilinear::slope(f.low);
        above = Bilinear::slope(f.high);
      }
      const double y = below / (below - above);
      (low > 0 ? found.high : found.low) = low > 0 ? std::min(found.high, y) : std::max(found.low, y);
    }
    if (x == kind && found.high - found.low < kTolerance) return std::nullopt;
    return found.high < found.low - kTolerance ? std::nullopt : std::optional(found);
  }

  /// left, right: within the strips beside.
  int euler_at(double x, double left, double right) const {
    const auto limit = [&](double kind) { return stretch_at(kind, kind) ? stretch_at(x, kind) : std::nullopt; };
    const std::optional<Stretch> from_left = limit(left);
    const std::optional<Stretch> from_right = limit(right);
    if (stretch_at(x, x) && from_left && from_right) {
      return euler_of({std::min(from_left->low, from_right->low), std::max(from_left->high, from_right->high)});
    }
    return (from_left ? euler_of(*from_left) : 0) + (from_right ? euler_of(*from_right) : 0);
  }

  std::array<Bilinear, 2> functions_;
  double scale_ = 0;
  std::vector<double> breaks_;  // ascending
};

/// A part of the square. Where two corners across it are in a function's part, but apart, each is in one quarter of the
/// square around the saddle.
class Window {
 public:
  void shrink_to(const WallPart& part) {
    const WallHeights& h = part.beside;
    const double across = h[(part.corner + 2) % 4];
    const double others = h[(part.corner + 1) % 4] * h[(part.corner + 3) % 4];
    if (across <= 0 || h[part.corner] * across > others) return;
    const double twist = h[0] - h[1] + h[2] - h[3];
    cut(u_, (h[0] - h[3]) / twist, part.corner == 1 || part.corner == 2);
    cut(v_, (h[0] - h[1]) / twist, part.corner >= 2);
  }
  bool is_any() const { return u_[0] < u_[1] && v_[0] < v_[1]; }
  WallHeights of(const WallHeights& h) const {
    const auto at = [&](double u, double v) { return mix(mix(h[0], h[1], u), mix(h[3], h[2], u), v); };
    return {at(u_[0], v_[0]), at(u_[1], v_[0]), at(u_[1], v_[1]), at(u_[0], v_[1])};
  }

 private:
  static void cut(std::array<double, 2>& range, double at, bool is_high) {
    if (is_high) {
      range[0] = std::max(range[0], at);
    } else {
      range[1] = std::min(range[1], at);
    }
  }
  std::array<double, 2> u_{0, 1};
  std::array<double, 2> v_{0, 1};
};

}  // namespace

int euler_of_overlap(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  return Overlap(a, b).euler();
}

bool do_overlap(const WallPart& a, const WallPart& b) {
  Window window;
  window.shrink_to(a);
  window.shrink_to(b);
  return window.is_any() && Overlap(window.of(a.beside), window.of(b.beside)).is_any();
}

}  // namespace scantet
