// One pass over the six edges of a tet: normals give the angles, lengths the rest. What improvement must reach is a
// little more than the bounds on angles, so that they are met whichever way they are computed; sizes and ratios, which
// refinement has met to the last bit, may be missed by as little.
#include <limits>

#include "scantet/optimize/tet_judge_impl.h"

namespace scantet::optimize {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-9;
/// Where no smallest angle is asked for, shares of other bounds are put on the scale of angles with this one.
constexpr double kLeastDihedralDeg = 1;

double squared(double x) {
  return x * x;
}

double squared_sine(double degrees) {
  return 1 - squared(std::cos(degrees * std::numbers::pi / 180));
}

/// What there is over what is asked for. One infinity over another is NaN, and counts as nothing.
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
  squared_slack_ = squared(bounds.rules->bounds.small_slack);
  size_ = bounds.rules->size;
  if (const auto* uniform = dynamic_cast<const UniformSize*>(size_)) {
    squared_size_ = squared(uniform->min_size() * (1 + kRounding));
    size_ = nullptr;
  }
}

double TetJudge::share_of_size(const Point& center, double squared_radius) const {
  if (!is_finite(center)) return 0;
  const double size = size_->size_up_to(center, std::sqrt(squared_radius));
  return share(squared(size * (1 + kRounding)), squared_radius);
}

double TetJudge::ratio_share(const Point& center, double squared_radius, double squared_edge) const {
  const double strict = share(squared_ratio_ * squared_edge, squared_radius);
  if (strict >= 1 || squared_slack_ == 1 || !is_finite(center)) return strict;
  const double squared_small = squared_radius / squared(kSmallElement);
  const double squared_size =
      size_ != nullptr ? squared(size_->size_up_to(center, 2 * std::sqrt(squared_small))) : squared_size_;
  return squared_small < squared_size ? squared_slack_ * strict : strict;
}

TetShares TetJudge::shares(const Point& p, const Point& q, const Point& r, const Point& s) const {
  const TetForm t(p, q, r, s);
  if (!(t.det > 0)) return {-1, -1, -1, -1, -1};
  const EdgeSquares edges(t);
  TetShares shares = shares_at_most(t, DihedralCosines(t), edges);
  ask_size(p, t, edges, shares);
  return shares;
}

TetShares TetJudge::shares_at_most(const TetForm& t, const DihedralCosines& cosines, const EdgeSquares& edges) const {
  TetShares shares{kInfinity, kInfinity, kInfinity, kInfinity, kInfinity};
  if (squared_min_sine_ > 0) shares.min_dihedral = share(std::max(1 - cosines.sharp(), 0.0), squared_min_sine_);
  if (squared_max_sine_ > 0) shares.max_dihedral = share(std::max(1 - cosines.blunt(), 0.0), squared_max_sine_);
  if (squared_jacobian_ > 0) {
    shares.scaled_jacobian = share(2 * t.det * t.det, edges.longest_corner * squared_jacobian_);
  }
  if (squared_ratio_ > 0) {
    const double squared_radius = squared_length((0.5 / t.det) * edges.center);
    shares.radius_edge = squared_slack_ * share(squared_ratio_ * edges.shortest, squared_radius);
  }
  return shares;
}

void TetJudge::ask_size(const Point& p, const TetForm& t, const EdgeSquares& edges, TetShares& shares) const {
  if (squared_ratio_ == 0) return;
  const Vec offset = (0.5 / t.det) * edges.center;
  const double squared_radius = squared_length(offset);
  shares.radius_edge = ratio_share(p + offset, squared_radius, edges.shortest);
  if (squared_size_ > 0) shares.size = share(squared_size_, squared_radius);
  if (size_ != nullptr) shares.size = share_of_size(p + offset, squared_radius);
}

}  // namespace scantet::optimize
