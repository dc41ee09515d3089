// From the boundary of one mesh to that of another. The distance to one facet is a convex function, so over a triangle
// its greatest value is at a corner; and no point of a triangle is farther than its centroid plus the way from there.
// Where neither bound is good enough the triangle is divided in four.
#include <algorithm>

#include "scantet/base/parallel.h"
#include "scantet/check/distance_impl.h"

namespace scantet::measuring {
namespace {

constexpr int kMostDivisions = 6;  // the parts are 1/64 of the facet
constexpr std::size_t kGrain = 64;

class ToOther {
 public:
  ToOther(const FacetTree& tree, const Aim& aim) : tree_(tree), aim_(aim) {}

  /// divisions: that are still allowed.
  void settle(const FacetCorners& part, std::uint32_t facet, int divisions, PartBounds& bounds) const {
    double upper_mm = farthest_mm(part, facet);
    if (upper_mm > aim_.of(bounds.farthest.distance_mm)) {
      const Point center = centroid_of(part);
      const FacetTree::Nearest nearest = tree_.nearest(center, facet);
      bounds.take({center, tree_.nearest_point(nearest.facet, center), nearest.distance_mm});
      if (nearest.facet != facet) upper_mm = std::min(upper_mm, farthest_mm(part, nearest.facet));
      upper_mm = std::min(upper_mm, nearest.distance_mm + farthest_corner_mm(part, center));
      facet = nearest.facet;
    }
    if (divisions == 0 || upper_mm <= aim_.of(bounds.farthest.distance_mm)) {
      bounds.upper_mm = std::max(bounds.upper_mm, upper_mm);
      return;
    }
    const auto& [a, b, c] = part;
    const FacetCorners middle{0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)};
    const FacetCorners parts[] = {
        {a, middle[0], middle[2]}, {middle[0], b, middle[1]}, {middle[2], middle[1], c}, middle};
    for (const FacetCorners& p : parts) settle(p, facet, divisions - 1, bounds);
  }

 private:
  double farthest_mm(const FacetCorners& part, std::uint32_t facet) const {
    double farthest_mm = 0;
    for (const Point& p : part) farthest_mm = std::max(farthest_mm, tree_.distance_to(facet, p));
    return farthest_mm;
  }

  const FacetTree& tree_;
  Aim aim_;
};

}  // namespace

OneWayDistance distance_between(const TetMesh& from, const FacetTree& to, const DistanceOptions& options,
                                std::vector<double>& facets_off_mm) {
  const std::size_t facets = from.boundary_facets.size();
  facets_off_mm.assign(facets, 0);
  if (to.empty()) return {};
  std::vector<FarPlace> farthest(facets);
  std::vector<std::uint32_t> hints(facets, FacetTree::kNone);
  parallel_for(facets, kGrain, [&](std::size_t begin, std::size_t end) {
    std::uint32_t hint = FacetTree::kNone;
    for (std::size_t i = begin; i < end; ++i) {
      for (const Point& p : corners_of(from, i)) {
        const FacetTree::Nearest nearest = to.nearest(p, hint);
        hint = nearest.facet;
        if (nearest.distance_mm < farthest[i].distance_mm) continue;
        farthest[i] = {p, to.nearest_point(hint, p), nearest.distance_mm};
      }
      facets_off_mm[i] = farthest[i].distance_mm;
      hints[i] = to.nearest(centroid_of(corners_of(from, i)), hint).facet;
    }
  });
  double known_mm = 0;
  for (const double off_mm : facets_off_mm) known_mm = std::max(known_mm, off_mm);
  const ToOther way(to, Aim(options, known_mm));
  std::vector<PartBounds> parts(facets);
  parallel_for(facets, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      parts[i].take(farthest[i]);
      parts[i].points = 3;
      way.settle(corners_of(from, i), hints[i], kMostDivisions, parts[i]);
    }
  });
  Gathering all(options);
  for (std::size_t i = 0; i < facets; ++i) all.add(parts[i], farthest[i].point);
  return all.result(true);
}

}  // namespace scantet::measuring
