// Rows of points on the patches along the curves, after Cohen-Steiner, Colin de Verdiere and Yvinec (spheres around
// samples meet patches) and Rand and Walkington (collars): over the middle of every segment, at the same height on each
// patch; and around a corner on each patch where its curves leave too wide an angle.
#include <algorithm>
#include <numbers>

#include "curve_sample.h"

namespace scantet::bench {
namespace {

constexpr double kHeight = 0.6;  ///< of a row, over the length of its segment
constexpr double kWidestAngle = 75 * std::numbers::pi / 180;

struct Collar {
  const Arrangement& domain;
  CurveSample& sample;
  std::vector<double> free;  ///< around each vertex of the sample, mm

  void add(const Point& p, int patch) {
    for (std::size_t i = 0; i < free.size(); ++i)
      free[i] = std::min(free[i], 0.999 * distance(sample.vertices[i].point, p));
    sample.vertices.push_back({p, 0, 2, Patches{1} << patch});
  }

  /// One point on each patch on the circle around the middle of a segment.
  void add_ring(const CurveSegment& segment) {
    constexpr int kSides = 90;
    const Point &a = sample.vertices[segment.vertex[0]].point, &b = sample.vertices[segment.vertex[1]].point;
    const double height = kHeight * distance(a, b);
    const Vec along = unit(b - a), any = std::abs(along.x) < 0.7 ? Vec{1, 0, 0} : Vec{0, 1, 0};
    const Vec e = unit(cross(along, any)), f = cross(along, e);
    const auto on_circle = [&](int i) {
      const double angle = (i + 0.3) * 2 * std::numbers::pi / kSides;
      return lerp(a, b, 0.5) + height * (std::cos(angle) * e + std::sin(angle) * f);
    };
    for (int i = 0; i < kSides; ++i) {
      for (const Crossing& crossing : domain.crossings(on_circle(i), on_circle(i + 1)))
        if (domain.curves()[segment.curve].patches >> crossing.patch & 1) add(crossing.point, crossing.patch);
    }
  }

  /// Points around a corner on each patch, between the first samples of its two curves there.
  void add_fan(int corner) {
    std::vector<std::pair<Patches, Point>> firsts;
    for (const CurveSegment& s : sample.segments) {
      for (int end = 0; end < 2; ++end) {
        if (s.vertex[end] == corner)
          firsts.emplace_back(domain.curves()[s.curve].patches, sample.vertices[s.vertex[1 - end]].point);
      }
    }
    const Point at = sample.vertices[corner].point;
    for (std::size_t i = 0; i < firsts.size(); ++i) {
      for (std::size_t j = i + 1; j < firsts.size(); ++j)
        add_between(at, firsts[i].second, firsts[j].second, firsts[i].first & firsts[j].first);
    }
  }

  void add_between(const Point& at, const Point& p, const Point& q, Patches shared) {
    const Vec u = unit(p - at), v = unit(q - at), normal = cross(u, v);
    const double angle = std::atan2(length(normal), dot(u, v)), reach = distance(at, p);
    const int pieces = static_cast<int>(std::ceil(angle / kWidestAngle));
    for (int i = 1; i < pieces; ++i) {
      const double t = angle * i / pieces;
      const Vec to = (1 / std::sin(angle)) * (std::sin(angle - t) * u + std::sin(t) * v);
      const Point guess = at + reach * to;
      const Vec off = (0.3 * reach) * unit(normal);
      for (const Crossing& crossing : domain.crossings(guess - off, guess + off))
        if (shared >> crossing.patch & 1) add(crossing.point, crossing.patch);
    }
  }
};

}  // namespace

void add_collars(const Arrangement& domain, CurveSample& sample) {
  const std::size_t corners = domain.corners().size();
  std::vector<double> longest(sample.vertices.size(), 0.0);
  for (const CurveSegment& s : sample.segments) {
    for (const int v : s.vertex) {
      const double l = distance(sample.vertices[s.vertex[0]].point, sample.vertices[s.vertex[1]].point);
      longest[v] = std::max(longest[v], std::hypot(0.5, kHeight) * l);
    }
  }
  for (std::size_t i = 0; i < corners; ++i) longest[i] /= std::hypot(0.5, kHeight);
  Collar collar{domain, sample, std::move(longest)};
  const std::size_t samples = collar.free.size();
  for (const CurveSegment& s : sample.segments)
    if (s.vertex[0] >= static_cast<int>(corners) && s.vertex[1] >= static_cast<int>(corners)) collar.add_ring(s);
  for (std::size_t i = 0; i < corners; ++i) collar.add_fan(static_cast<int>(i));
  for (std::size_t i = 0; i < samples; ++i) sample.guards.push_back({sample.vertices[i].point, collar.free[i]});
}

}  // namespace scantet::bench
