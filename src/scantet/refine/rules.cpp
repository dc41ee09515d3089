// R1 also refines a facet whose vertices and ball centres do not all lie on one component of ∂O. On a 0.09 d_M-sample
// that cannot happen (paper, proof of Lemma 3), so it changes nothing where the proofs hold. Where the sample is
// sparser it keeps components apart that lie closer than σ. A vertex on a curve or at a corner lies on all patches that
// meet there. Components that touch are parted by no sample: where the balls are too small for the size asked for,
// these are left to Untangler. Along a line where components touch, that is still far too many points (a thousand times
// the line's length over σ): Refinement allows a number of them.
#include <algorithm>
#include <cassert>
#include <limits>

#include "scantet/base/coordinate_hash.h"
#include "scantet/delaunay/circumcentre.h"
#include "scantet/refine/rules_impl.h"

namespace scantet::engine {
namespace {

constexpr double kSmallestApart = 1e-3;  // of alpha·σ: smaller balls on several components are left
constexpr double kAtCurve = 2;           // times the bound on shape, for facets that have a vertex on a curve
constexpr double kClose = 0.1;           // of alpha·σ: balls on several components that cost many points
constexpr double kBeyond = 1.001;        // times the size that an element needs, larger sizes need not be known

/// A number that depends on the coordinates only and orders equal ranks.
std::uint64_t tie_of(const Point& p) {
  return hash_of_coordinates(p, {0x9e3779b97f4a7c15ULL, 32});
}

/// A facet's radius over its shortest edge: of its circumcircle, or where points have weights of the circle orthogonal
/// to them. Balls promise only to that how far its centre is from other points (docs/algorithm.md, "Protection").
double ratio_of(const Triangulation& t, const std::array<PointId, 3>& v) {
  if (!t.has_weights()) return radius_edge(t.point(v[0]), t.point(v[1]), t.point(v[2]));
  return orthoradius_edge(t.weighted_point(v[0]), t.weighted_point(v[1]), t.weighted_point(v[2]));
}

}  // namespace

/// Times the bound on shape, for a facet of this size.
double Rules::slack_of(const Triangulation& t, const std::array<PointId, 3>& facet) const {
  const Point& corner = t.point(facet[0]);
  const Point center = circumcentre(corner, t.point(facet[1]), t.point(facet[2]));
  return options_.bounds.slack(distance(center, corner), options_.bounds.alpha * size_.size_at(center));
}

/// ball: the first of the facet; largest: the largest of them.
Rules::Fault Rules::r1_fault(const RestrictedTriangulation& t, const std::array<PointId, 3>& facet, std::uint32_t ball,
                             const SurfaceBall& largest) const {
  const Triangulation& points = t.triangulation();
  for (const PointId v : facet) {
    if (!points.vertex_info(v).on_boundary()) return Fault::plain;
  }
  const bool is_at_curve =
      std::any_of(facet.begin(), facet.end(), [&](PointId v) { return points.vertex_info(v).dimension < 2; });
  const double shape = ratio_of(points, facet) / options_.bounds.facet_radius_edge;
  if (shape > 1 && shape > std::max(is_at_curve ? kAtCurve : 1, slack_of(points, facet))) return Fault::plain;
  const auto on_patch =
      std::find_if(facet.begin(), facet.end(), [&](PointId v) { return points.vertex_info(v).dimension == 2; });
  const Patch& patch = on_patch != facet.end() ? points.vertex_info(*on_patch).patch : t.balls()[ball].patch;
  bool is_one = true;
  bool is_one_pair = true;  // of regions: boundaries of others do not touch
  const auto look = [&](const Patch& other) {
    is_one = is_one && other == patch;
    is_one_pair = is_one_pair && other.regions == patch.regions;
  };
  for (const PointId v : facet) {
    if (points.vertex_info(v).dimension == 2) {
      look(points.vertex_info(v).patch);
    } else {
      is_one = is_one && t.junctions().meet_at(v, patch.regions);
    }
  }
  for (; ball != kNone; ball = t.balls()[ball].next) look(t.balls()[ball].patch);
  if (is_one) return Fault::none;
  const double share = largest.radius / (options_.bounds.alpha * size_.size_at(largest.center));
  if (!t.junctions().empty() && share < kClose) return Fault::none;  // where curves were merged, patches fit nowhere
  if (is_one_pair && share < kClose) return leaves_close_ || share < kSmallestApart ? Fault::none : Fault::close;
  return share >= kSmallestApart ? Fault::plain : Fault::none;
}

std::optional<Violation> Rules::facet(const RestrictedTriangulation& t, std::uint32_t ball) const {
  const FacetCode code = t.balls()[ball].facet;
  assert(t.balls()[ball].generation % 2 == 1 && t.triangulation().info(code / 4).balls[code % 4] == ball);
  const auto facet = facet_vertices(t.triangulation().cell(code / 4), static_cast<int>(code % 4));
  const auto violation = [&](Rule rule, double rank, std::uint32_t id, bool is_close = false) {
    return Violation{rule, rank, tie_of(t.balls()[id].center), id, t.balls()[id].generation, is_close};
  };
  std::uint32_t largest = ball;
  for (std::uint32_t b = t.balls()[ball].next; b != kNone; b = t.balls()[b].next) {
    if (t.balls()[b].radius > t.balls()[largest].radius) largest = b;
  }
  const Fault fault = r1_fault(t, facet, ball, t.balls()[largest]);
  if (fault != Fault::none) return violation(Rule::r1, t.balls()[largest].radius, largest, fault == Fault::close);

  std::uint32_t worst = kNone;
  double worst_excess = 1;
  for (std::uint32_t b = ball; b != kNone; b = t.balls()[b].next) {
    const SurfaceBall& candidate = t.balls()[b];
    const double alpha = options_.bounds.alpha;
    double excess = candidate.radius / (alpha * size_.size_up_to(candidate.center, kBeyond * candidate.radius / alpha));
    if (options_.bounds.facet_distance_mm) {
      const Triangulation& points = t.triangulation();
      const Point flat_center = orthocentre(points.weighted_point(facet[0]), points.weighted_point(facet[1]),
                                            points.weighted_point(facet[2]));
      excess = std::max(excess, distance(flat_center, candidate.center) / *options_.bounds.facet_distance_mm);
    }
    if (excess > worst_excess) {
      worst_excess = excess;
      worst = b;
    }
  }
  if (worst == kNone) return std::nullopt;
  return violation(Rule::r2, worst_excess, worst);
}

std::optional<Violation> Rules::tet(const RestrictedTriangulation& t, CellId c) const {
  const CellInfo& info = t.triangulation().info(c);
  if (info.region == kOutside) return std::nullopt;
  const Point& center = t.triangulation().cell(c).circumcentre;
  const std::array<Point, 4> points = t.triangulation().points_of(c);
  const PointId vertex = t.triangulation().cell(c).vertex[0];
  const double squared_radius = squared_distance(center, points[0]) - t.triangulation().weight(vertex);
  const double size = size_.bounds_tets() ? size_.size_up_to(center, kBeyond * std::sqrt(squared_radius))
                                          : std::numeric_limits<double>::infinity();
  const double by_size = squared_radius / (size * size);
  double by_shape = squared_radius / (squared_shortest_edge(points) * options_.bounds.cell_radius_edge *
                                      options_.bounds.cell_radius_edge);
  if (by_shape > 1 && size_.bounds_tets()) {
    const double radius = std::sqrt(squared_radius);
    const double slack = options_.bounds.slack(radius, size_.size_up_to(center, kBeyond / kSmallElement * radius));
    by_shape /= slack * slack;
  }
  if (by_size <= 1 && by_shape <= 1) return std::nullopt;
  return Violation{Rule::r3, std::max(by_size, by_shape), tie_of(center), c, info.generation};
}

}  // namespace scantet::engine
