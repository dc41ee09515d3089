// Private: puts all that is asked of a tet into one number.
#pragma once

#include <algorithm>

#include "scantet/optimize/dihedral_impl.h"
#include "scantet/optimize/element_bounds.h"

namespace scantet::optimize {

/// For each thing that is asked of a tet, what the tet has of it as a share of the least that will do: from 1 on it is
/// enough, and 0 is nothing at all. Angles are compared by their squared sines, lengths and the Jacobian by their
/// squares, so that no share takes a root.
struct TetShares {
  double min_dihedral;
  double max_dihedral;
  double scaled_jacobian;
  double size;         ///< σ at the circumcentre over the circumradius, or less, but enough
  double radius_edge;  ///< the bound over the ratio

  double least() const { return std::min({min_dihedral, max_dihedral, scaled_jacobian, size, radius_edge}); }
};

/// The squared edge lengths of a tet, as far as ratios and the Jacobian need them, and where its circumcentre is.
struct EdgeSquares {
  double shortest;        // the squared length of the shortest edge
  double longest_corner;  // the largest product of the squared lengths of three edges that meet at a corner
  Vec center;             // 2·det times the way from the first corner to the circumcentre

  explicit EdgeSquares(const TetForm& t) {
    const double aa = dot(t.a, t.a);
    const double bb = dot(t.b, t.b);
    const double cc = dot(t.c, t.c);
    const double ab = squared_distance(t.a, t.b);
    const double ac = squared_distance(t.a, t.c);
    const double bc = squared_distance(t.b, t.c);
    shortest = std::min({aa, bb, cc, ab, ac, bc});
    longest_corner = std::max({aa * bb * cc, aa * ab * ac, bb * ab * bc, cc * ac * bc});
    center = aa * t.bc + bb * t.ca + cc * t.ab;
  }
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

  /// The largest sharpness that is good enough: tets that are sharper break a bound.
  double bound() const { return bound_; }
  /// How sharp a tet is that has this share of what is asked for.
  double sharpness_of_share(double share) const { return share < 1 ? 1 - (1 - bound_) * share : bound_; }

  /// kInverted if the tet is not positively oriented as computed; never under the bound if anything is asked for.
  /// too_sharp: of a tet that is as sharp it is not said how sharp.
  double sharpness(const Point& p, const Point& q, const Point& r, const Point& s, double too_sharp = kInverted) const {
    if (!asks_) return tet_sharpness(p, q, r, s);
    const TetForm t(p, q, r, s);
    if (!(t.det > 0)) return kInverted;
    const DihedralCosines cosines(t);
    const double of_angle = squared_min_sine_ > 0 ? std::max(cosines.sharpest, bound_) : bound_;
    if (of_angle >= too_sharp) return of_angle;
    const EdgeSquares edges(t);
    if (keeps_the_rest(p, t, cosines, edges)) return of_angle;
    TetShares shares = shares_at_most(t, cosines, edges);
    const double at_least = sharpness_of_share(shares.least());
    if (at_least >= too_sharp) return at_least;
    ask_size(p, t, edges, shares);
    return std::max(of_angle, sharpness_of_share(shares.least()));
  }

  /// Whether the tet breaks no bound. Costs less than shares().
  bool keeps_all(const Point& p, const Point& q, const Point& r, const Point& s) const {
    const TetForm t(p, q, r, s);
    if (!(t.det > 0)) return false;
    const DihedralCosines cosines(t);
    return 1 - cosines.sharp() >= squared_min_sine_ && keeps_the_rest(p, t, cosines, EdgeSquares(t));
  }

  /// All shares are negative for a tet that is not positively oriented as computed; a share of which nothing is asked
  /// is infinite.
  TetShares shares(const Point& p, const Point& q, const Point& r, const Point& s) const;

  /// The same without rule R3.
  TetJudge without_rules() const {
    TetJudge judge = *this;
    judge.squared_ratio_ = 0;
    judge.squared_size_ = 0;
    judge.size_ = nullptr;
    return judge;
  }

 private:
  static constexpr double kAlmost = 1 - 1e-12;  // rounding takes less from a share

  /// What needs no size, which takes longest to look up; of what does, no less than there is.
  TetShares shares_at_most(const TetForm& t, const DihedralCosines& cosines, const EdgeSquares& edges) const;
  /// Makes these shares those of the tet, whose first corner is p.
  void ask_size(const Point& p, const TetForm& t, const EdgeSquares& edges, TetShares& shares) const;

  /// Whether everything but the smallest angle is as asked. Nearly all tets keep these bounds, so this is computed
  /// without a division.
  bool keeps_the_rest(const Point& p, const TetForm& t, const DihedralCosines& cosines,
                      const EdgeSquares& edges) const {
    const double squared_det = t.det * t.det;
    if (1 - cosines.blunt() < squared_max_sine_) return false;
    if (2 * squared_det < edges.longest_corner * squared_jacobian_) return false;
    if (squared_ratio_ == 0) return true;
    const double squared_radius = 0.25 * squared_length(edges.center);  // times det²
    const double squared_longest = squared_ratio_ * edges.shortest * squared_det;
    if (!(squared_longest >= squared_radius)) {
      if (!(squared_slack_ * squared_longest >= kAlmost * squared_radius)) return false;
      if (!(ratio_share(p + (0.5 / t.det) * edges.center, squared_radius / squared_det, edges.shortest) >= 1))
        return false;
    }
    if (squared_size_ > 0) return squared_size_ * squared_det >= squared_radius;
    return size_ == nullptr || share_of_size(p + (0.5 / t.det) * edges.center, squared_radius / squared_det) >= 1;
  }

  /// Of a tet with that circumcentre, and squared circumradius, mm²; where it is more than 1, it is not said how much.
  double share_of_size(const Point& center, double squared_radius) const;
  /// Of such a tet with that squared shortest edge, mm².
  double ratio_share(const Point& center, double squared_radius, double squared_edge) const;

  bool asks_ = false;
  double bound_ = -1;
  double squared_min_sine_ = 0;  // here and in the next four, 0 stands for no bound
  double squared_max_sine_ = 0;
  double squared_jacobian_ = 0;
  double squared_ratio_ = 0;
  double squared_slack_ = 1;           // of small tets
  double squared_size_ = 0;            // set where the size is the same everywhere
  const SizingField* size_ = nullptr;  // set where the size is not the same everywhere
};

}  // namespace scantet::optimize
