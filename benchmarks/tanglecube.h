// The graded case: the tanglecube of the paper's Figure 7, with a size that follows its local feature size.
#pragma once

#include <algorithm>
#include <cmath>

#include "scantet/domain/sizing_field.h"

namespace scantet::bench {

/// f of make_tanglecube(): negative inside.
inline double tanglecube(const Point& p) {
  const auto g = [](double t) { return t * t * (t * t - 5); };
  return g(p.x) + g(p.y) + g(p.z) + 11.8;
}

/// σ = 0.09·m + 0.9·δ, a stand-in for `--size auto`, which asks for 0.09·d_M on the boundary and, as the largest
/// 1-Lipschitz function with these values there, grows inwards with the distance.
///
/// m stands for d_M: the distance to the centre of the nearest of the twelve necks, at least their radius (0.265 mm),
/// at most 0.6 mm, about the radius of the eight lobes. δ is a lower bound of the distance to the boundary, 0 outside.
/// A step of length d changes f by |∇f|·d + H·d²/2 at most, where H = 51.7 bounds the second derivatives 12t² - 10 in
/// the domain (|t| ≤ 2.267); δ is the d at which that reaches |f|. Differentiating |f| = |∇f|·δ + H·δ²/2 gives |∇δ| ≤
/// (|∇f| + H·δ) / (|∇f| + H·δ) = 1. So σ is 0.99-Lipschitz in the domain.
class GradedSize final : public SizingField {
 public:
  double size_at(const Point& p) const override { return 0.09 * feature_size(p) + 0.9 * depth(p); }
  double min_size() const override { return 0.09 * kNeckRadius; }

 private:
  static constexpr double kNeckRadius = 0.265;  // 10 r² = 0.7: f across a neck, about its centre
  static constexpr double kLobeRadius = 0.6;
  static constexpr double kMostBent = 51.7;  // H

  static double feature_size(const Point& p) {
    const double axis = std::sqrt(2.5);  // a neck's centre has two coordinates ±√2.5, the minima of g, and one 0
    const Point q{std::abs(p.x), std::abs(p.y), std::abs(p.z)};
    const double nearest =
        std::min({distance(q, {0, axis, axis}), distance(q, {axis, 0, axis}), distance(q, {axis, axis, 0})});
    return std::clamp(nearest, kNeckRadius, kLobeRadius);
  }

  static double depth(const Point& p) {
    const double f = tanglecube(p);
    if (f >= 0) return 0;
    const auto slope = [](double t) { return t * (4 * t * t - 10); };
    const double gradient = length(Vec{slope(p.x), slope(p.y), slope(p.z)});
    return -2 * f / (gradient + std::sqrt(gradient * gradient - 2 * kMostBent * f));
  }
};

}  // namespace scantet::bench
