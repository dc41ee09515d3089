// Every element is looked at by itself, side by side; each piece keeps its own counts. Comparisons are the negation of
// "within the bound", so that the infinities and NaNs of degenerate elements count as broken.
#include "scantet/optimize/conformance.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "scantet/base/parallel.h"

namespace scantet {
namespace {

constexpr double kRounding = 1 + 1e-9;

struct Circumsphere {
  Point center;
  double squared_radius;
  double squared_shortest_edge;

  bool has_ratio(double radius_edge) const {
    const double bound = radius_edge * kRounding;
    return squared_radius <= bound * bound * squared_shortest_edge;
  }
};

Circumsphere circumsphere(const Point& p, const Point& q, const Point& r) {
  const Vec a = q - p;
  const Vec b = r - p;
  const Vec normal = cross(a, b);
  const double aa = dot(a, a);
  const double bb = dot(b, b);
  const Vec offset = (0.5 / squared_length(normal)) * (bb * cross(normal, a) + aa * cross(b, normal));
  return {p + offset, squared_length(offset), std::min({aa, bb, squared_distance(q, r)})};
}

Circumsphere circumsphere(const Point& p, const Point& q, const Point& r, const Point& s) {
  const Vec a = q - p;
  const Vec b = r - p;
  const Vec c = s - p;
  const Vec bc = cross(b, c);
  const double aa = dot(a, a);
  const double bb = dot(b, b);
  const double cc = dot(c, c);
  const Vec offset = (0.5 / dot(a, bc)) * (aa * bc + bb * cross(c, a) + cc * cross(a, b));
  return {p + offset, squared_length(offset),
          std::min({aa, bb, cc, squared_distance(q, r), squared_distance(q, s), squared_distance(r, s)})};
}

class RuleCheck {
 public:
  RuleCheck(const TetMesh& mesh, const Domain& domain, const SizingField& size, const RuleBounds& bounds)
      : mesh_(mesh), domain_(domain), size_(size), bounds_(bounds) {}

  /// Counts facet i under the rules that it breaks.
  void facet(std::size_t i, Crossings& crossings, RuleConformance& counts) const {
    const Triangle& v = mesh_.boundary_facets[i];
    const auto on_boundary = [&](VertexId u) { return mesh_.on_boundary[u] != 0; };
    const Circumsphere circle = circumsphere(at(v[0]), at(v[1]), at(v[2]));
    if (!std::all_of(v.begin(), v.end(), on_boundary) || !circle.has_ratio(bounds_.facet_radius_edge)) ++counts.r1;
    if (!is_finite(circle.center) || !has_ball(circle, cross(at(v[1]) - at(v[0]), at(v[2]) - at(v[0])), crossings)) {
      ++counts.r2;
    }
  }

  /// Counts tet i if it breaks R3.
  void tet(std::size_t i, RuleConformance& counts) const {
    const Tet& v = mesh_.tets[i];
    const Circumsphere sphere = circumsphere(at(v[0]), at(v[1]), at(v[2]), at(v[3]));
    if (!is_finite(sphere.center) || !sphere.has_ratio(bounds_.cell_radius_edge) ||
        (size_.bounds_tets() && !(sphere.squared_radius <= squared_bound(1, sphere.center)))) {
      ++counts.r3;
    }
  }

 private:
  const Point& at(VertexId v) const { return mesh_.vertices[v]; }

  double squared_bound(double factor, const Point& p) const {
    const double bound = factor * size_.size_at(p) * kRounding;
    return bound * bound;
  }

  /// Whether the surface ball nearest to the circumcentre is within its bounds.
  bool has_ball(const Circumsphere& circle, const Vec& normal, Crossings& crossings) const {
    const Vec reach = (bounds_.alpha * size_.size_at(circle.center) / length(normal)) * normal;
    domain_.crossings({circle.center - reach, circle.center + reach}, crossings);
    if (crossings.empty()) return false;
    const auto to_center = [&](const Crossing& c) { return squared_distance(c.point, circle.center); };
    const auto nearest =
        std::min_element(crossings.begin(), crossings.end(),
                         [&](const Crossing& a, const Crossing& b) { return to_center(a) < to_center(b); });
    const double squared_radius = circle.squared_radius + to_center(*nearest);
    const double distance_bound =
        bounds_.facet_distance_mm.value_or(std::numeric_limits<double>::infinity()) * kRounding;
    return squared_radius <= squared_bound(bounds_.alpha, nearest->point) &&
           to_center(*nearest) <= distance_bound * distance_bound;
  }

  const TetMesh& mesh_;
  const Domain& domain_;
  const SizingField& size_;
  RuleBounds bounds_;
};

}  // namespace

RuleConformance check_conformance(const TetMesh& mesh, const Domain& domain, const SizingField& size,
                                  const RuleBounds& bounds) {
  constexpr std::size_t kGrain = 4096;
  const RuleCheck check(mesh, domain, size, bounds);
  const std::size_t facets = mesh.boundary_facets.size();
  const std::size_t tets = mesh.tets.size();
  std::vector<RuleConformance> pieces((std::max(facets, tets) + kGrain - 1) / kGrain);
  parallel_for(facets, kGrain, [&](std::size_t begin, std::size_t end) {
    Crossings crossings;
    for (std::size_t i = begin; i < end; ++i) check.facet(i, crossings, pieces[begin / kGrain]);
  });
  parallel_for(tets, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) check.tet(i, pieces[begin / kGrain]);
  });
  RuleConformance total;
  total.facets = facets;
  total.tets = tets;
  for (const RuleConformance& piece : pieces) {
    total.r1 += piece.r1;
    total.r2 += piece.r2;
    total.r3 += piece.r3;
  }
  return total;
}

}  // namespace scantet
