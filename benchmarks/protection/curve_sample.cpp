// How far apart samples are: at most the size, a fraction of the curve's radius, and a fraction of the distance to
// other curves; and changing by at most half of the way along the curve. Weighted balls must stay clear of those of
// curves at the same corner, too; segments without weights need not, for those that leave a corner are equally long
// there.
#include "curve_sample.h"

#include <algorithm>
#include <limits>
#include <random>

namespace scantet::bench {
namespace {

constexpr int kSteps = 240;           ///< a curve is looked at in so many places
constexpr double kOverlap = 1.5;      ///< W: samples are so many ball radii apart
constexpr double kMostTurning = 0.6;  ///< spacing over the curve's radius
constexpr double kGrading = 0.5;
constexpr double kClear = 0.95;  ///< W: of the room between curves, so much is used

class CurveSampler {
 public:
  CurveSampler(const Arrangement& domain, double size, Method method)
      : domain_(domain), size_(size), method_(method), corner_reach_(domain.corners().size()) {}

  CurveSample run() {
    choose_corner_reaches();
    for (std::size_t c = 0; c < domain_.corners().size(); ++c) {
      const double reach = method_ == Method::kWeights ? corner_reach_[c] : 0;
      sample_.vertices.push_back({domain_.corners()[c].point, reach * reach, 0, domain_.corners()[c].patches});
    }
    for (std::size_t i = 0; i < domain_.curves().size(); ++i) sample_curve(static_cast<int>(i));
    if (method_ == Method::kWeights) count_loose();
    return std::move(sample_);
  }

 private:
  Point place(const Curve& curve, int step) const { return curve.at(curve.length * step / kSteps); }
  static bool touches(const Curve& curve, int corner) { return curve.corner[0] == corner || curve.corner[1] == corner; }
  static bool meet(const Curve& a, const Curve& b) {
    return !a.closed() && (touches(b, a.corner[0]) || touches(b, a.corner[1]));
  }

  /// The radius of a corner's ball, or of the sphere on which the first samples of its curves lie.
  void choose_corner_reaches() {
    for (std::size_t c = 0; c < corner_reach_.size(); ++c) {
      const Point& at = domain_.corners()[c].point;
      double reach = method_ == Method::kWeights ? size_ / kOverlap : size_;
      for (const Curve& curve : domain_.curves()) {
        if (touches(curve, static_cast<int>(c))) {
          reach = std::min(reach, curve.length / 3);
          continue;
        }
        for (int i = 0; i <= kSteps; ++i) reach = std::min(reach, 0.4 * distance(at, place(curve, i)));
      }
      corner_reach_[c] = reach;
    }
  }

  /// The distance from a point of a curve to the other curves that matter.
  double gap(int id, const Point& at) const {
    const Curve& curve = domain_.curves()[id];
    double apart = std::numeric_limits<double>::infinity(), meeting = apart;
    for (std::size_t j = 0; j < domain_.curves().size(); ++j) {
      if (static_cast<int>(j) == id) continue;
      const Curve& other = domain_.curves()[j];
      double& least = meet(curve, other) ? meeting : apart;
      for (int i = 0; i <= kSteps; ++i) least = std::min(least, distance(at, place(other, i)));
    }
    if (method_ == Method::kWeights) return kOverlap * kClear * std::min(apart / 2, half_gap_at_corners(curve, at));
    return method_ == Method::kCollar ? std::min(0.6 * apart, 0.75 * meeting) : 0.8 * apart;
  }

  /// W: the largest ball around a point of a curve that stays clear of curves from the same corner if their balls grow
  /// with the distance from the corner in the same way.
  double half_gap_at_corners(const Curve& curve, const Point& at) const {
    double least = std::numeric_limits<double>::infinity();
    for (const int c : curve.corner) {
      for (const Curve& other : domain_.curves()) {
        if (c < 0 || &other == &curve || !touches(other, c)) continue;
        const Point& corner = domain_.corners()[c].point;
        const double along = distance(at, corner);
        for (int i = 0; i <= kSteps; ++i) {
          const Point q = place(other, i);
          least = std::min(least, along * distance(at, q) / (along + distance(q, corner)));
        }
      }
    }
    return least;
  }

  std::vector<double> spacings(int id) const {
    const Curve& curve = domain_.curves()[id];
    const double step = curve.length / kSteps;
    std::vector<double> spacing(kSteps + 1);
    for (int i = 0; i <= kSteps; ++i) {
      double at = i * step;
      if (!curve.closed())  // Within the reach of a corner as where the curve leaves it.
        at = std::clamp(at, corner_reach_[curve.corner[0]], curve.length - corner_reach_[curve.corner[1]]);
      spacing[i] = std::min(size_, gap(id, curve.at(at)));
      if (curve.radius > 0) spacing[i] = std::min(spacing[i], kMostTurning * curve.radius);
    }
    for (int i = 1; i <= kSteps; ++i) spacing[i] = std::min(spacing[i], spacing[i - 1] + kGrading * step);
    for (int i = kSteps; i-- > 0;) spacing[i] = std::min(spacing[i], spacing[i + 1] + kGrading * step);
    return spacing;
  }

  /// The arc length at which a curve leaves the sphere of that radius around its start.
  static double leaves(const Curve& curve, bool at_end, double radius) {
    double low = 0, high = curve.length / 2;
    const Point corner = curve.at(at_end ? curve.length : 0);
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (distance(corner, curve.at(at_end ? curve.length - middle : middle)) < radius ? low : high) = middle;
    }
    return at_end ? curve.length - high : high;
  }

  void sample_curve(int id) {
    const Curve& curve = domain_.curves()[id];
    const std::vector<double> spacing = spacings(id);
    const auto spacing_at = [&](double s) {
      return spacing[std::clamp(static_cast<int>(std::lround(s / curve.length * kSteps)), 0, kSteps)];
    };
    double from = 0, to = curve.length;
    if (!curve.closed()) {
      for (const bool end : {false, true}) {
        const double reach = corner_reach_[curve.corner[end]];
        double first = leaves(curve, end, reach);
        if (method_ == Method::kWeights) {
          const double ball = spacing_at(end ? curve.length : 0) / kOverlap;
          first = leaves(curve, end, reach + 0.5 * ball);
        }
        (end ? to : from) = first;
      }
    }
    constexpr int kFine = 4000;
    std::vector<double> sum(kFine + 1, 0.0);
    for (int i = 1; i <= kFine; ++i)
      sum[i] = sum[i - 1] + (to - from) / kFine / spacing_at(from + (to - from) * (i - 0.5) / kFine);
    const int pieces = std::max(curve.closed() ? 5 : 1, static_cast<int>(std::ceil(sum.back() - 1e-9)));
    const double fill = sum.back() / pieces;  // Actual over wished spacing.
    std::vector<double> places;
    if (!curve.closed()) places.push_back(0);
    for (int piece = 0, i = 0; piece <= pieces - (curve.closed() ? 1 : 0); ++piece) {
      while (i < kFine && sum[i] < piece * fill) ++i;
      places.push_back(piece == pieces ? to : from + (to - from) * i / kFine);
    }
    if (!curve.closed()) places.push_back(curve.length);
    add(id, places, [&](double s) { return spacing_at(s) * fill / kOverlap; });
  }

  template <typename Ball>
  void add(int id, const std::vector<double>& places, const Ball& ball) {
    const Curve& curve = domain_.curves()[id];
    std::vector<int> ids;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool first = i == 0, last = i + 1 == places.size();
      if (!curve.closed() && (first || last)) {
        ids.push_back(curve.corner[last]);
        continue;
      }
      const double radius = method_ == Method::kWeights ? ball(places[i]) : 0;
      ids.push_back(static_cast<int>(sample_.vertices.size()));
      sample_.vertices.push_back({curve.at(places[i]), radius * radius, 1, curve.patches});
    }
    for (std::size_t i = 0; i + 1 < places.size(); ++i)
      sample_.segments.push_back({id, places[i], places[i + 1], {ids[i], ids[i + 1]}});
    if (curve.closed()) sample_.segments.push_back({id, places.back(), curve.length, {ids.back(), ids.front()}});
  }

  void count_loose() {
    const std::size_t count = sample_.vertices.size();
    std::vector<std::pair<int, int>> next;
    for (const CurveSegment& s : sample_.segments) next.emplace_back(std::minmax(s.vertex[0], s.vertex[1]));
    std::sort(next.begin(), next.end());
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = i + 1; j < count; ++j) {
        const MeshVertex &a = sample_.vertices[i], &b = sample_.vertices[j];
        const bool overlap = distance(a.point, b.point) < std::sqrt(a.weight) + std::sqrt(b.weight);
        const bool neighbours = std::binary_search(next.begin(), next.end(), std::pair<int, int>(i, j));
        if (overlap != neighbours) ++sample_.loose;
      }
    }
  }

  const Arrangement& domain_;
  double size_;
  Method method_;
  std::vector<double> corner_reach_;
  CurveSample sample_;
};

}  // namespace

CurveSample sample_curves(const Arrangement& domain, double size_mm, Method method) {
  CurveSample sample = CurveSampler(domain, size_mm, method).run();
  if (method == Method::kCollar) add_collars(domain, sample);
  return sample;
}

bool is_protected(const CurveSample& sample, const Point& p, int& segment) {
  segment = -1;
  for (std::size_t i = 0; i < sample.segments.size(); ++i) {
    const Point& a = sample.vertices[sample.segments[i].vertex[0]].point;
    const Point& b = sample.vertices[sample.segments[i].vertex[1]].point;
    if (dot(p - a, p - b) < 0) {
      segment = static_cast<int>(i);
      return true;
    }
  }
  return std::any_of(sample.guards.begin(), sample.guards.end(), [&](const Guard& guard) {
    return squared_distance(guard.center, p) < guard.radius * guard.radius;
  });
}

std::vector<MeshVertex> sample_patches(const Arrangement& domain, const CurveSample& sample, double size_mm,
                                       Method method, unsigned seed) {
  constexpr int kGiveUp = 2000;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto on_sphere = [&] {
    const double x = normal(random), y = normal(random), z = normal(random);
    return domain.center() + 1.2 * domain.radius() * unit(Vec{x, y, z});
  };
  std::vector<MeshVertex> found;
  const double apart = 0.92 * size_mm;
  const auto is_free = [&](const Point& p) {
    int segment = 0;
    if (method != Method::kWeights && is_protected(sample, p, segment)) return false;
    for (const MeshVertex& v : sample.vertices)
      if (squared_distance(v.point, p) < std::max(v.weight, 0.25 * apart * apart)) return false;
    return std::none_of(found.begin(), found.end(),
                        [&](const MeshVertex& v) { return squared_distance(v.point, p) < apart * apart; });
  };
  for (int failures = 0; failures < kGiveUp;) {
    const Point a = on_sphere(), b = on_sphere();
    bool one = false;
    for (const Crossing& crossing : domain.crossings(a, b)) {
      if (!is_free(crossing.point)) continue;
      found.push_back({crossing.point, 0, 2, Patches{1} << crossing.patch});
      one = true;
    }
    failures = one ? 0 : failures + 1;
  }
  return found;
}

}  // namespace scantet::bench
