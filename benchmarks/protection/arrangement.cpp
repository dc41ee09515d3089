// Crossings are roots of the primitives along a segment; between two roots the region is that of the middle. What meets
// at a curve is what a small circle around the middle of the curve crosses.
#include "arrangement.h"

#include <algorithm>
#include <bit>
#include <numbers>
#include <stdexcept>

namespace scantet::bench {
namespace {

/// The parameters in (0, 1) at which a + t * d meets the primitive.
void add_roots(const Primitive& primitive, const Point& a, const Vec& d, int id,
               std::vector<std::pair<double, int>>& to) {
  const auto add = [&](double t) {
    if (t > 0 && t < 1) to.emplace_back(t, id);
  };
  if (!primitive.is_sphere) {
    const double slope = dot(primitive.normal_or_center, d);
    if (slope != 0) add((primitive.offset_or_radius - dot(primitive.normal_or_center, a)) / slope);
    return;
  }
  const Vec from = a - primitive.normal_or_center;
  const double dd = squared_length(d), half = dot(from, d);
  const double root = half * half - dd * (squared_length(from) - std::pow(primitive.offset_or_radius, 2));
  if (dd == 0 || root <= 0) return;
  const double q = -(half + std::copysign(std::sqrt(root), half));
  add(q / dd);
  if (q != 0) add((squared_length(from) - std::pow(primitive.offset_or_radius, 2)) / q);
}

/// The part of a segment within a ball; false if there is none. The dual of a flat tet can be far away.
bool clip(Point& a, Point& b, const Point& center, double radius) {
  if (!is_finite(a) || !is_finite(b)) return false;
  std::vector<std::pair<double, int>> roots;
  const Point source = a;
  const Vec d = b - a;
  add_roots({true, center, radius}, source, d, 0, roots);
  std::sort(roots.begin(), roots.end());
  const bool a_inside = distance(source, center) < radius, b_inside = distance(b, center) < radius;
  if (roots.empty()) return a_inside && b_inside;
  if (!a_inside) a = source + roots.front().first * d;
  if (!b_inside) b = source + roots.back().first * d;
  return true;
}

}  // namespace

Point Curve::at(double s) const {
  if (radius == 0) return origin + s * u;
  const double angle = s / radius;
  return origin + (radius * std::cos(angle)) * u + (radius * std::sin(angle)) * v;
}

Arrangement::Arrangement(std::vector<Primitive> primitives, std::function<int(const Point&)> region,
                         std::vector<Curve> curves, std::vector<Corner> corners, Point center, double radius_mm)
    : primitives_(std::move(primitives)),
      region_(std::move(region)),
      curves_(std::move(curves)),
      corners_(std::move(corners)),
      center_(center),
      radius_(radius_mm) {
  for (Curve& curve : curves_) {
    find_patches_around(curve);
    for (const int corner : curve.corner)
      if (corner >= 0) corners_[corner].patches |= curve.patches;
  }
}

std::vector<Crossing> Arrangement::crossings(Point a, Point b) const {
  std::vector<Crossing> found;
  if (!clip(a, b, center_, 2 * radius_)) return found;
  const Vec d = b - a;
  std::vector<std::pair<double, int>> roots;
  for (std::size_t i = 0; i < primitives_.size(); ++i) add_roots(primitives_[i], a, d, static_cast<int>(i), roots);
  std::sort(roots.begin(), roots.end());
  int before = region_(a);
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const double next = i + 1 < roots.size() ? roots[i + 1].first : 1.0;
    const int after = region_(a + (roots[i].first + next) / 2 * d);
    if (after != before) found.push_back({a + roots[i].first * d, patch(roots[i].second, before, after)});
    before = after;
  }
  return found;
}

int Arrangement::patch(int primitive, int a, int b) const {
  const int key = (primitive * 16 + std::min(a, b)) * 16 + std::max(a, b);
  const int id = patch_ids_.try_emplace(key, static_cast<int>(patch_ids_.size())).first->second;
  if (id >= 64) throw std::logic_error("more than 64 patches");
  return id;
}

void Arrangement::find_patches_around(Curve& curve) const {
  constexpr int kSides = 360;
  const Point middle = curve.at(curve.length / 2);
  const Vec tangent = unit(curve.at(curve.length * 0.5001) - curve.at(curve.length * 0.4999));
  const Vec any = std::abs(tangent.x) < 0.7 ? Vec{1, 0, 0} : Vec{0, 1, 0};
  const Vec e = unit(cross(tangent, any)), f = cross(tangent, e);
  const auto on_circle = [&](int i) {
    const double angle = (i + 0.3) * 2 * std::numbers::pi / kSides;
    return middle + (1e-4 * radius_) * (std::cos(angle) * e + std::sin(angle) * f);
  };
  for (int i = 0; i < kSides; ++i) {
    for (const Crossing& crossing : crossings(on_circle(i), on_circle(i + 1)))
      curve.patches |= Patches{1} << crossing.patch;
  }
  curve.sheets = std::popcount(curve.patches);
}

}  // namespace scantet::bench
