// Each domain is a polynomial of degree at most four along a line. Its real roots are isolated by the roots of its
// derivative, recursively, so none is missed; Newton's method, kept between the ends of its interval, then finds each.
#include "scantet/domain/analytic.h"

#include <algorithm>
#include <array>

#include "scantet/base/box_clip.h"

namespace scantet {
namespace {

using Quartic = std::array<double, 5>;  // coefficients, constant first

double evaluate(const Quartic& c, double t) {
  return (((c[4] * t + c[3]) * t + c[2]) * t + c[1]) * t + c[0];
}

/// Whether the polynomial has no root in [0, 1], as its Bernstein coefficients there, of which it is an average, tell.
bool keeps_its_sign(const Quartic& c) {
  const std::array<double, 5> b{c[0], c[0] + c[1] / 4, c[0] + c[1] / 2 + c[2] / 6,
                                c[0] + 3 * c[1] / 4 + c[2] / 2 + c[3] / 4, c[0] + c[1] + c[2] + c[3] + c[4]};
  const auto [least, most] = std::minmax_element(b.begin(), b.end());
  return *least > 0 || *most < 0;
}

/// The root in (lo, hi), at the ends of which the polynomial has different signs and between which it is monotone.
double root_between(const Quartic& c, const Quartic& derivative, double lo, double hi, bool lo_inside) {
  constexpr double kClose = 4e-16;
  for (double t = 0.5 * (lo + hi); lo < t && t < hi;) {
    const double value = evaluate(c, t);
    const double newton = t - value / evaluate(derivative, t);
    if (std::abs(newton - t) <= kClose) return t;
    ((value < 0) == lo_inside ? lo : hi) = t;
    t = newton > lo && newton < hi ? newton : 0.5 * (lo + hi);
  }
  return lo;
}

/// Ascending places in [0, 1].
struct Places {
  std::array<double, 6> at;
  std::size_t count = 0;
  void add(double t) { at[count++] = t; }
};

/// Sign changes of the polynomial in (0, 1), ascending.
Places sign_changes(const Quartic& c, int degree) {
  Places roots;
  if (degree == 0 || keeps_its_sign(c)) return roots;
  Quartic derivative{};
  for (int i = 1; i <= degree; ++i) derivative[static_cast<std::size_t>(i - 1)] = i * c[static_cast<std::size_t>(i)];
  Places ends;
  ends.add(0);
  const Places turns = sign_changes(derivative, degree - 1);
  for (std::size_t i = 0; i < turns.count; ++i) ends.add(turns.at[i]);
  ends.add(1);
  bool inside = evaluate(c, 0) < 0;
  for (std::size_t i = 0; i + 1 < ends.count; ++i) {
    const bool lo_inside = inside;
    inside = evaluate(c, ends.at[i + 1]) < 0;
    if (inside != lo_inside) roots.add(root_between(c, derivative, ends.at[i], ends.at[i + 1], lo_inside));
  }
  return roots;
}

/// Inside is where a function, polynomial of degree ≤ 4 along every line, is negative.
class PolynomialDomain : public Domain {
 public:
  Region region_at(const Point& p) const final { return value(p) < 0 ? 1 : kOutside; }

  void crossings(const Segment& segment, Crossings& out) const final {
    find_places(segment, out);
    for (Crossing& crossing : out) crossing.components = components_at(crossing.point);
  }

  Patch patch_at(const Point& p) const final { return {{kOutside, 1}, components_at(p)}; }

  std::optional<double> residual_at(const Point& p) const final { return std::abs(value(p)) / scale(); }

 protected:
  /// As Patch::components, of a point on the boundary.
  virtual std::array<ComponentId, 2> components_at(const Point&) const { return {}; }
  virtual double value(const Point& p) const = 0;
  virtual double scale() const = 0;
  /// Coefficients of value(source + t (target - source)).
  virtual Quartic along(const Segment& segment) const = 0;

 private:
  /// The crossings, but for what meets there.
  void find_places(const Segment& whole, Crossings& out) const {
    out.clear();
    Region region = region_at(whole.source);
    const Region last = region_at(whole.target);
    // The coefficients of a segment much longer than the domain would have no digits left for it.
    const std::optional<Segment> near = clipped(whole, bounds());
    if (!near) return;
    const Segment& segment = *near;
    const Places places = sign_changes(along(segment), 4);
    for (std::size_t i = 0; i < places.count; ++i) {
      out.push_back({lerp(segment.source, segment.target, places.at[i]), region, 1 - region});
      region = 1 - region;
    }
    // Rounding of the expanded polynomial may disagree with region_at at an end that lies on the boundary.
    if (region == last) return;
    const bool from_source =
        !out.empty() && distance(out.front().point, segment.source) < distance(out.back().point, segment.target);
    if (out.empty()) {
      const bool near_source = std::abs(value(segment.source)) < std::abs(value(segment.target));
      out.push_back({near_source ? segment.source : segment.target, region, last});
    } else if (from_source) {
      out.erase(out.begin());
      for (Crossing& crossing : out) std::swap(crossing.from, crossing.to);
      if (!out.empty()) return;
    } else {
      out.pop_back();
    }
  }
};

/// Squared distance to `center` along the segment, as a polynomial of degree 2.
std::array<double, 3> squared_distance_along(const Segment& s, const Point& center) {
  const Vec d = s.target - s.source;
  const Vec e = s.source - center;
  return {dot(e, e), 2 * dot(d, e), dot(d, d)};
}

Quartic product(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  Quartic c{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) c[i + j] += a[i] * b[j];
  }
  return c;
}

Box cube(const Point& center, double half) {
  return Box{center, center}.grown(half);
}

/// (|p - a|² - r²)(|p - b|² - s²): with a == b a shell, with s == r and a, b apart (negated) a pair of balls.
class TwoBalls final : public PolynomialDomain {
 public:
  TwoBalls(const Point& a, double r, const Point& b, double s) : a_(a), b_(b), r_(r), s_(s) {
    box_ = cube(a, 1.01 * r);
    box_.unite(cube(b, 1.01 * s));
  }
  Box bounds() const override { return box_; }
  std::vector<Component> components() const override {
    if (a_ == b_) {
      Component shell{1, a_ + Vec{0.5 * (r_ + s_), 0, 0}, cube(a_, std::max(r_, s_)), 0, false, 4, 2};
      return {shell, Component{kOutside, a_, cube(a_, std::min(r_, s_)), 0, false, 2, 1}};
    }
    return {Component{1, a_, cube(a_, r_), 0, false, 2, 1}, Component{1, b_, cube(b_, s_), 0, false, 2, 1}};
  }

 protected:
  /// Two balls are components of the inside, the ball within a shell one of the outside.
  std::array<ComponentId, 2> components_at(const Point& p) const override {
    const bool at_first = std::abs(distance(p, a_) - r_) < std::abs(distance(p, b_) - s_);
    return {a_ == b_ && !at_first ? 1U : 0U, a_ != b_ && !at_first ? 1U : 0U};
  }
  double value(const Point& p) const override {
    return (squared_distance(p, a_) - r_ * r_) * (squared_distance(p, b_) - s_ * s_);
  }
  double scale() const override { return r_ * r_ * s_ * s_; }
  Quartic along(const Segment& segment) const override {
    auto f = squared_distance_along(segment, a_);
    auto g = squared_distance_along(segment, b_);
    f[0] -= r_ * r_;
    g[0] -= s_ * s_;
    return product(f, g);
  }

 private:
  Point a_, b_;
  double r_, s_;
  Box box_;
};

class Sphere final : public PolynomialDomain {
 public:
  Sphere(const Point& center, double radius) : center_(center), radius_(radius) {}
  Box bounds() const override { return cube(center_, 1.01 * radius_); }
  std::vector<Component> components() const override {
    return {Component{1, center_, cube(center_, radius_), 4.0 / 3.0 * M_PI * radius_ * radius_ * radius_, false, 2, 1}};
  }

 protected:
  double value(const Point& p) const override { return squared_distance(p, center_) - radius_ * radius_; }
  double scale() const override { return radius_ * radius_; }
  Quartic along(const Segment& segment) const override {
    const auto f = squared_distance_along(segment, center_);
    return {f[0] - radius_ * radius_, f[1], f[2], 0, 0};
  }

 private:
  Point center_;
  double radius_;
};

/// (|p|² + R² − r²)² − 4R²(x² + y²) < 0.
class Torus final : public PolynomialDomain {
 public:
  Torus(const Point& center, double ring, double tube) : center_(center), ring_(ring), tube_(tube) {}
  Box bounds() const override { return cube(center_, 1.01 * (ring_ + tube_)); }
  std::vector<Component> components() const override {
    return {Component{1, center_ + Vec{ring_, 0, 0}, cube(center_, ring_ + tube_),
                      2 * M_PI * M_PI * ring_ * tube_ * tube_, false, 0, 1}};
  }

 protected:
  double value(const Point& p) const override {
    const Vec e = p - center_;
    const double a = dot(e, e) + ring_ * ring_ - tube_ * tube_;
    return a * a - 4 * ring_ * ring_ * (e.x * e.x + e.y * e.y);
  }
  double scale() const override { return ring_ * ring_ * ring_ * ring_; }
  Quartic along(const Segment& segment) const override {
    auto f = squared_distance_along(segment, center_);
    f[0] += ring_ * ring_ - tube_ * tube_;
    Quartic c = product(f, f);
    const Vec d = segment.target - segment.source;
    const Vec e = segment.source - center_;
    const double k = 4 * ring_ * ring_;
    c[0] -= k * (e.x * e.x + e.y * e.y);
    c[1] -= 2 * k * (d.x * e.x + d.y * e.y);
    c[2] -= k * (d.x * d.x + d.y * d.y);
    return c;
  }

 private:
  Point center_;
  double ring_, tube_;
};

class Tanglecube final : public PolynomialDomain {
 public:
  Box bounds() const override { return cube({}, 3); }

 protected:
  double value(const Point& p) const override {
    const Vec s{p.x * p.x, p.y * p.y, p.z * p.z};
    return s.x * s.x - 5 * s.x + s.y * s.y - 5 * s.y + s.z * s.z - 5 * s.z + 11.8;
  }
  double scale() const override { return 11.8; }
  Quartic along(const Segment& segment) const override {
    Quartic c{11.8, 0, 0, 0, 0};
    for (int axis = 0; axis < 3; ++axis) {
      const double e = segment.source[axis];
      const double d = segment.target[axis] - e;
      const std::array<double, 3> square{e * e, 2 * d * e, d * d};
      const Quartic fourth = product(square, square);
      for (std::size_t i = 0; i < 5; ++i) c[i] += fourth[i] - (i < 3 ? 5 * square[i] : 0);
    }
    return c;
  }
};

}  // namespace

std::unique_ptr<Domain> make_sphere(const Point& center, double radius_mm) {
  return std::make_unique<Sphere>(center, radius_mm);
}

std::unique_ptr<Domain> make_shell(const Point& center, double inner_mm, double outer_mm) {
  return std::make_unique<TwoBalls>(center, outer_mm, center, inner_mm);
}

std::unique_ptr<Domain> make_torus(const Point& center, double ring_mm, double tube_mm) {
  return std::make_unique<Torus>(center, ring_mm, tube_mm);
}

std::unique_ptr<Domain> make_tanglecube() {
  return std::make_unique<Tanglecube>();
}

std::unique_ptr<Domain> make_two_spheres(double radius_mm, double gap_mm) {
  const double half = radius_mm + 0.5 * gap_mm;
  return std::make_unique<TwoBalls>(Point{-half, 0, 0}, radius_mm, Point{half, 0, 0}, radius_mm);
}

}  // namespace scantet
