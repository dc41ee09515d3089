// One pass over the six edges of a tet: normals give the angles, lengths the rest. What improvement must reach is a
// little more than the bounds on angles, so that they are met whichever way they are computed; sizes and ratios, which
// refinement has met to the last bit, may be missed by as little.
#include <limits>

#include "scantet/optimize/tet_judge_impl.h"

namespace scantet::optimize {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-9;
constexpr double kLeastDihedralDeg = 1;  // what shares are put on the scale of angles with, where no angle is asked for

double squared(double x) {
  return x * x;
}

double squared_sine(double degrees) {
  return 1 - squared(std::cos(degrees * std::numbers::pi / 180));
}

/// NaN, of an infinity over another, is nothing.
double share(double has, double asked) {
  const double share = has / asked;
  return share >= 0 ? share : 0;
}

}  // namespace

TetJudge::TetJudge(const ElementBounds& bounds) : asks_(true) {
  const double scale_deg = bounds.min_dihedral_deg > 0 ? bounds.min_dihedral_deg : kLeastDihedralDeg;
  bound_ = sharpness_of_angle(scale_deg) - kRounding;
  if (bounds.min_dihedral_deg > 0) squared_min_sine_ = squared_sine(scale_deg) + kRounding;
  if (bounds.max_dihedral_deg < 180) squared_max_sine_ = squared_sine(bounds.max_dihedral_deg) + kRounding;
  squared_jacobian_ = squared(bounds.min_scaled_jacobian * (1 + kRounding));
  if (!bounds.rules) return;
  squared_ratio_ = squared(bounds.rules->bounds.cell_radius_edge * (1 + kRounding));
  if (!bounds.rules->size->bounds_tets()) return;
  size_ = bounds.rules->size;
  if (const auto* uniform = dynamic_cast<const UniformSize*>(size_)) {
    squared_size_ = squared(uniform->min_size() * (1 + kRounding));
    size_ = nullptr;
  }
}

TetShares TetJudge::shares(const Point& p, const Point& q, const Point& r, const Point& s) const {
  const Vec a = q - p;
  const Vec b = r - p;
  const Vec c = s - p;
  const Vec bc = cross(b, c);
  const double det = dot(a, bc);
  if (!(det > 0)) return {-1, -1, -1, -1, -1, 0};
  const Vec ca = cross(c, a);
  const Vec ab = cross(a, b);
  // Normals of the faces opposite to p, q, r and s; all point out of the tet or, here, all into it.
  const std::array<Vec, 4> normals{-1.0 * (bc + ca + ab), bc, ca, ab};
  std::array<double, 4> inverse{};
  for (std::size_t i = 0; i < 4; ++i) inverse[i] = 1 / squared_length(normals[i]);
  double sharp = 0;  // squared cosines: of the smallest angle under 90°, of the largest over it
  double blunt = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double product = -dot(normals[i], normals[j]);
      const double squared_cosine = product * product * inverse[i] * inverse[j];
      double& most = product > 0 ? sharp : blunt;
      most = std::max(most, squared_cosine);
    }
  }
  TetShares shares{kInfinity, kInfinity, kInfinity, kInfinity, kInfinity, std::max(1 - sharp, 0.0)};
  if (squared_min_sine_ > 0) shares.min_dihedral = share(shares.squared_sine, squared_min_sine_);
  if (squared_max_sine_ > 0) shares.max_dihedral = share(std::max(1 - blunt, 0.0), squared_max_sine_);
  const double aa = dot(a, a);
  const double bb = dot(b, b);
  const double cc = dot(c, c);
  const double qr = squared_distance(q, r);
  const double qs = squared_distance(q, s);
  const double rs = squared_distance(r, s);
  if (squared_jacobian_ > 0) {
    const double longest = std::max({aa * bb * cc, aa * qr * qs, bb * qr * rs, cc * qs * rs});
    shares.scaled_jacobian = share(2 * det * det, longest * squared_jacobian_);
  }
  if (squared_ratio_ > 0) {
    const Vec offset = (0.5 / det) * (aa * bc + bb * ca + cc * ab);
    const double squared_radius = squared_length(offset);
    shares.radius_edge = share(squared_ratio_ * std::min({aa, bb, cc, qr, qs, rs}), squared_radius);
    if (squared_size_ > 0) shares.size = share(squared_size_, squared_radius);
    if (size_ != nullptr) {
      const Point center = p + offset;
      shares.size = is_finite(center) ? share(squared(size_->size_at(center) * (1 + kRounding)), squared_radius) : 0;
    }
  }
  return shares;
}

}  // namespace scantet::optimize
