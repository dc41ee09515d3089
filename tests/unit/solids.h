// A domain made of balls and rods, for tests that need necks.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "scantet/domain/domain.h"

namespace scantet::test {

struct Ball {
  Point center;
  double radius_mm;
};

/// A cylinder along x, from one end to the other.
struct Rod {
  Point from;
  double length_mm;
  double radius_mm;
};

/// The union of balls and rods, as region 1.
class Solids final : public Domain {
 public:
  Solids(std::vector<Ball> balls, std::vector<Rod> rods) : balls_(std::move(balls)), rods_(std::move(rods)) {}

  Box bounds() const override {
    Box box;
    const auto extend = [&](const Point& p, double r) {
      box.extend(p - Vec{r, r, r});
      box.extend(p + Vec{r, r, r});
    };
    for (const Ball& ball : balls_) extend(ball.center, ball.radius_mm);
    for (const Rod& rod : rods_) {
      extend(rod.from, rod.radius_mm);
      extend(rod.from + Vec{rod.length_mm, 0, 0}, rod.radius_mm);
    }
    return box;
  }
  Region region_at(const Point& p) const override {
    for (const Ball& ball : balls_) {
      if (distance(p, ball.center) < ball.radius_mm) return 1;
    }
    for (const Rod& rod : rods_) {
      const Vec q = p - rod.from;
      if (q.x > 0 && q.x < rod.length_mm && std::hypot(q.y, q.z) < rod.radius_mm) return 1;
    }
    return kOutside;
  }
  void crossings(const Segment& segment, Crossings& out) const override {
    out.clear();
    std::vector<Span> spans;
    const Vec along = segment.target - segment.source;
    for (const Ball& ball : balls_) add(spans, inside(segment.source - ball.center, along, ball.radius_mm));
    for (const Rod& rod : rods_) {
      const Vec from = segment.source - rod.from;
      add(spans, common(inside({0, from.y, from.z}, {0, along.y, along.z}, rod.radius_mm),
                        between(from.x, along.x, rod.length_mm)));
    }
    std::sort(spans.begin(), spans.end());
    for (std::size_t i = 0; i < spans.size();) {
      auto [begin, end] = spans[i];
      for (++i; i < spans.size() && spans[i].first <= end; ++i) end = std::max(end, spans[i].second);
      if (begin > 0) out.push_back({segment.source + begin * along, 0, 1});
      if (end < 1) out.push_back({segment.source + end * along, 1, 0});
    }
  }

 private:
  using Span = std::pair<double, double>;  // parameters between which a line is in a shape

  static void add(std::vector<Span>& spans, const std::optional<Span>& span) {
    if (span && span->first < 1 && span->second > 0) spans.push_back(*span);
  }
  static std::optional<Span> common(const std::optional<Span>& a, const std::optional<Span>& b) {
    if (!a || !b || a->first >= b->second || b->first >= a->second) return std::nullopt;
    return Span{std::max(a->first, b->first), std::min(a->second, b->second)};
  }
  /// Where |from + t · along| < radius.
  static std::optional<Span> inside(const Vec& from, const Vec& along, double radius) {
    const double a = squared_length(along);
    const double c = squared_length(from) - radius * radius;
    if (a == 0) return c < 0 ? std::optional<Span>({-1e9, 1e9}) : std::nullopt;
    const double half_b = dot(from, along);
    const double under_root = half_b * half_b - a * c;
    if (under_root <= 0) return std::nullopt;
    const double root = std::sqrt(under_root);
    return Span{(-half_b - root) / a, (-half_b + root) / a};
  }
  /// Where 0 < from + t · along < length.
  static std::optional<Span> between(double from, double along, double length) {
    if (along == 0) return from > 0 && from < length ? std::optional<Span>({-1e9, 1e9}) : std::nullopt;
    const double t = -from / along;
    const double u = (length - from) / along;
    return Span{std::min(t, u), std::max(t, u)};
  }

  std::vector<Ball> balls_;
  std::vector<Rod> rods_;
};

/// Two balls around (±5, 0, 0), joined by a neck along x.
inline Solids dumbbell(double neck_radius_mm) {
  return {{{{-5, 0, 0}, 3.1}, {{5, 0.3, 0.2}, 2.9}}, {{{-5, 0.8, 0.6}, 10, neck_radius_mm}}};
}

}  // namespace scantet::test
