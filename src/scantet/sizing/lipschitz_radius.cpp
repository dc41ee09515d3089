// A part of the boundary is the graph of a k-Lipschitz function over some plane if all its outward normals are within
// arctan k of that plane's normal; a second sheet within the ball has normals that point back. So around each point the
// normals are added to a cone, in rings from the inside out, until the cone is too wide. A ring of twice the radius
// looks at a quarter of the points: the sample is in random order, so every fourth point makes a sample of twice the
// spacing.
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "scantet/base/parallel.h"
#include "scantet/base/point_grid_impl.h"
#include "scantet/sampling/plane_fit_impl.h"
#include "scantet/sizing/lipschitz_radius_impl.h"

namespace scantet {
namespace {

constexpr std::size_t kGrain = 256;
constexpr double kPlaneReach = 1.8;  // spacings: points that near make the tangent plane
constexpr double kProbe = 0.3;       // spacings off it, to see which side is outside
constexpr double kFirstRing = 8;     // spacings: up to there all points are looked at

/// A cone of unit vectors around an axis. The vectors are added one by one, which makes it at most 1.5 times as wide as
/// it must be.
class NormalCone {
 public:
  explicit NormalCone(const Vec& axis) : axis_(axis) {}
  double half_angle() const { return half_angle_; }
  void add(const Vec& normal) {
    const double angle = std::acos(std::clamp(dot(axis_, normal), -1.0, 1.0));
    if (angle <= half_angle_) return;
    const double turn = 0.5 * (angle - half_angle_);
    const Vec across = normal - dot(axis_, normal) * axis_;
    const double norm = length(across);
    half_angle_ += turn;
    if (norm > 0) axis_ = std::cos(turn) * axis_ + (std::sin(turn) / norm) * across;
  }

 private:
  Vec axis_;
  double half_angle_ = 0;
};

/// The outward unit normal at a point of the sample; none where there is no clear one, as at an edge.
std::optional<Vec> outward_normal(const Domain& domain, const PointGrid& grid, const Point& p, double spacing_mm) {
  engine::PlaneFit plane;
  const double reach = kPlaneReach * spacing_mm;
  grid.any_near(p, reach, [&](std::uint32_t, const Point& other, double squared) {
    plane.add(other - p, 1 - squared / (reach * reach));
    return false;
  });
  const std::optional<Vec> normal = plane.normal();
  if (!normal) return std::nullopt;
  const Vec probe = (kProbe * spacing_mm) * *normal;
  const bool inside = domain.region_at(p + probe) != kOutside;
  if (inside == (domain.region_at(p - probe) != kOutside)) return std::nullopt;
  return inside ? -1.0 * *normal : *normal;
}

class RadiusFinder {
 public:
  RadiusFinder(const Domain& domain, const std::vector<Point>& sample, double spacing_mm, double k)
      : spacing_mm_(spacing_mm), widest_(std::atan(k)), normals_(sample.size()) {
    double ring = spacing_mm;
    for (std::uint32_t stride = 1; stride <= sample.size(); stride *= 4, ring *= 2) {
      std::vector<Point> some;
      for (std::size_t i = 0; i < sample.size(); i += stride) some.push_back(sample[i]);
      strides_.push_back(stride);
      grids_.emplace_back(some, ring);
    }
    parallel_for(sample.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        normals_[i] = outward_normal(domain, grids_.front(), sample[i], spacing_mm);
      }
    });
  }

  double radius_at(const Point& p) const {
    std::optional<NormalCone> cone;
    double outer = kFirstRing * spacing_mm_;
    double inner = 0;
    for (std::size_t level = 0; level < grids_.size(); ++level) {
      const std::optional<double> end = add_ring(level, p, inner, outer, cone);
      if (end) return *end;
      inner = outer;
      outer *= 2;
    }
    return std::numeric_limits<double>::infinity();
  }

 private:
  /// Adds the normals of the ring from the inside out; returns the distance at which they become too many.
  std::optional<double> add_ring(std::size_t level, const Point& p, double inner, double outer,
                                 std::optional<NormalCone>& cone) const {
    std::vector<std::pair<double, std::uint32_t>> ring;
    grids_[level].any_near(p, outer, [&](std::uint32_t nth, const Point&, double squared) {
      const std::uint32_t i = nth * strides_[level];
      if (squared >= inner * inner && normals_[i]) ring.emplace_back(squared, i);
      return false;
    });
    std::sort(ring.begin(), ring.end());
    for (const auto& [squared, i] : ring) {
      if (!cone) cone = NormalCone(*normals_[i]);
      cone->add(*normals_[i]);
      if (cone->half_angle() > widest_) return std::sqrt(squared);
    }
    return std::nullopt;
  }

  double spacing_mm_;
  double widest_;                       // half-angle, radians
  std::vector<std::uint32_t> strides_;  // 1, 4, 16, …
  std::vector<PointGrid> grids_;        // grid n: of every strides_[n]-th point of the sample
  std::vector<std::optional<Vec>> normals_;
};

}  // namespace

std::vector<double> lipschitz_radii(const Domain& domain, const std::vector<Point>& sample, double spacing_mm,
                                    double k) {
  const RadiusFinder finder(domain, sample, spacing_mm, k);
  std::vector<double> radii(sample.size());
  parallel_for(sample.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) radii[i] = std::max(finder.radius_at(sample[i]), spacing_mm);
  });
  return radii;
}

}  // namespace scantet
