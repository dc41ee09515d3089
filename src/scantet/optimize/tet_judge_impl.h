// Private: all that is asked of a tet as one number.
#pragma once

#include <algorithm>

#include "scantet/optimize/dihedral_impl.h"
#include "scantet/optimize/element_bounds.h"

namespace scantet::optimize {

/// What a tet has of each thing asked for, as a share of the least that will do: from 1 on it is enough, 0 is nothing.
/// Angles count by their squared sines, lengths and the Jacobian by their squares: no share takes a root.
struct TetShares {
  double min_dihedral;
  double max_dihedral;
  double scaled_jacobian;
  double size;          ///< σ at the circumcentre over the circumradius
  double radius_edge;   ///< the bound over the ratio
  double squared_sine;  ///< of the smallest dihedral angle, if that is under 90°: no share

  double least() const { return std::min({min_dihedral, max_dihedral, scaled_jacobian, size, radius_edge}); }
};

/// Judges tets by the sharpness of their smallest dihedral angle. A tet that breaks a bound of another kind is as sharp
/// as an angle that falls short of the bound on angles by the same share. So whatever a tet lacks, worse ones are
/// sharper.
class TetJudge {
 public:
  /// Asks for nothing: sharpness() is tet_sharpness().
  TetJudge() = default;
  /// bounds.rules: asked for R3. Their size must outlive the judge.
  explicit TetJudge(const ElementBounds& bounds);

  /// The sharpness that is good enough; tets that are sharper break a bound.
  double bound() const { return bound_; }
  /// The sharpness that goes with a share of what is asked for.
  double sharpness_of_share(double share) const { return share < 1 ? 1 - (1 - bound_) * share : bound_; }

  /// kInverted if the tet is not positively oriented as computed; never under the bound if anything is asked for.
  double sharpness(const Point& p, const Point& q, const Point& r, const Point& s) const {
    if (!asks_) return tet_sharpness(p, q, r, s);
    const TetShares all = shares(p, q, r, s);
    return all.least() < 0 ? kInverted : sharpness_of_share(all.least());
  }

  /// All of them are negative for a tet that is not positively oriented as computed, infinite where nothing is asked.
  TetShares shares(const Point& p, const Point& q, const Point& r, const Point& s) const;

 private:
  bool asks_ = false;
  double bound_ = -1;
  double squared_min_sine_ = 0;  // 0 here and below: no bound
  double squared_max_sine_ = 0;
  double squared_jacobian_ = 0;
  double squared_ratio_ = 0;
  double squared_size_ = 0;            // where it is the same everywhere
  const SizingField* size_ = nullptr;  // where it is not
};

}  // namespace scantet::optimize
