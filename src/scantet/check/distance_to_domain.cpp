// From the mesh's boundary to the domain's. The farthest of the facets' centroids, by the crossings along their
// normals, give a lower bound. Then each facet is bounded: if the triangle moved to one side lies inside of the
// surface, and moved to the other side outside of it, then the surface crosses every line between the two, and so is no
// farther from any point of the triangle. Or there is a point of the surface that all three corners are near to. Where
// neither can be shown the triangle is divided. A facet that the mesh before had, too, keeps its bound.
#include <algorithm>
#include <limits>

#include "scantet/base/parallel.h"
#include "scantet/check/distance_memory_impl.h"
#include "scantet/check/facet_corners_impl.h"
#include "scantet/check/nearest_boundary_impl.h"
#include "scantet/domain/nearest_crossing.h"

namespace scantet::measuring {
namespace {

constexpr std::size_t kGrain = 64;  // facets

FacetCorners moved(const FacetCorners& t, const Vec& by) {
  return {t[0] + by, t[1] + by, t[2] + by};
}

class ToDomain {
 public:
  ToDomain(const TetMesh& mesh, const Domain& domain, const BoundaryCells& cells, std::size_t surface,
           const DistanceOptions& options, SurfaceMemory& memory)
      : mesh_(mesh),
        domain_(domain),
        cells_(cells),
        surface_(surface),
        options_(options),
        memory_(memory),
        most_mm_(2 * domain.bounds().diagonal()),
        facets_(facets_of(mesh, surface)) {}

  Gathering run() {
    const Aim aim(options_, known_distance());
    Gathering all(options_);
    std::vector<PartBounds> bounds(facets_.size());
    std::vector<Gathering> pieces((facets_.size() + kGrain - 1) / kGrain, all);
    parallel_for(facets_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      Work work;
      for (std::size_t i = begin; i < end; ++i) {
        const FacetCorners t = corners_of(mesh_, facets_[i]);
        const PartBounds* const before = memory_.of_facet(t);
        PartBounds& part = bounds[i];
        if (before != nullptr && before->upper_mm <= aim.of(before->farthest.distance_mm)) {
          part = *before;
        } else {
          settle(t, aim, work, part);
        }
        pieces[begin / kGrain].add(part, centroid_of(t));
      }
    });
    memory_.keep_facets(std::move(bounds));
    for (const Gathering& piece : pieces) all.add(piece);
    for (const PartBounds& part : probed_) all.add_measured(part.farthest);
    return all;
  }

  /// The lower bound, from the centroids that seem to be farthest.
  double known_distance() {
    constexpr std::size_t kProbed = 128;
    struct Guess {
      double distance_mm;
      std::uint32_t facet;
    };
    std::vector<Guess> guesses(facets_.size());
    parallel_for(facets_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      Crossings crossings;
      for (std::size_t i = begin; i < end; ++i) guesses[i] = {guess(facets_[i], crossings), facets_[i]};
    });
    const std::size_t count = std::min(kProbed, guesses.size());
    std::partial_sort(guesses.begin(), guesses.begin() + static_cast<std::ptrdiff_t>(count), guesses.end(),
                      [](const Guess& a, const Guess& b) {
                        return a.distance_mm != b.distance_mm ? a.distance_mm > b.distance_mm : a.facet < b.facet;
                      });
    probed_.resize(count);
    parallel_for(count, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Point p = centroid_of(corners_of(mesh_, guesses[i].facet));
        const NearestBoundary found = nearest(p, std::max(guesses[i].distance_mm, kLeastReach), 0);
        probed_[i].take({p, found.point, found.lower_mm});
      }
    });
    double known_mm = 0;
    for (const PartBounds& part : probed_) known_mm = std::max(known_mm, part.farthest.distance_mm);
    return known_mm;
  }

 private:
  /// What bounding a facet needs room for.
  struct Work {
    std::vector<FacetCorners> parts;
    Crossings crossings;
  };

  static constexpr double kLeastReach = 1e-9;  // mm

  /// From the facet's centroid to the nearest crossing of a line along its normal, as long as the facet.
  double guess(std::uint32_t facet, Crossings& crossings) const {
    const FacetCorners t = corners_of(mesh_, facet);
    const Point center = centroid_of(t);
    const double reach_mm = farthest_corner_mm(t, center);
    const std::optional<Point> nearest = crossing_near(center, reach_mm * along_normal(t, 1), crossings);
    return nearest ? std::min(reach_mm, distance(center, *nearest)) : reach_mm;
  }

  /// The surface's crossing with the line to both sides of p that is nearest to it. crossings: all of them.
  std::optional<Point> crossing_near(const Point& p, const Vec& along, Crossings& crossings) const {
    domain_.crossings({p - along, p + along}, crossings);
    const auto surface = static_cast<Region>(surface_);
    const Crossing* const nearest =
        nearest_crossing(crossings, p, [&](const Crossing& c) { return (c.from <= surface) != (c.to <= surface); });
    return nearest != nullptr ? std::optional(nearest->point) : std::nullopt;
  }

  NearestBoundary nearest(const Point& p, double around_mm, double enough_mm) const {
    constexpr double kTolerance = 0.04;
    return nearest_boundary(cells_, surface_, p, around_mm, most_mm_, enough_mm, kTolerance);
  }

  /// Bounds a facet. All parts of one size come before the smaller ones, so that a point that is too far is found
  /// early.
  void settle(const FacetCorners& facet, const Aim& aim, Work& work, PartBounds& bounds) const {
    const Vec normal = along_normal(facet, 1);
    std::vector<FacetCorners>& parts = work.parts;
    parts.assign(1, facet);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const FacetCorners t = parts[i];
      if (is_bounded(t, normal, aim, work.crossings, bounds)) continue;
      const FacetCorners middles{lerp(t[1], t[2], 0.5), lerp(t[2], t[0], 0.5), lerp(t[0], t[1], 0.5)};
      parts.push_back(middles);
      parts.push_back({t[0], middles[2], middles[1]});
      parts.push_back({middles[2], t[1], middles[0]});
      parts.push_back({middles[1], middles[0], t[2]});
    }
  }

  /// Whether a part of a facet need not be divided.
  bool is_bounded(const FacetCorners& t, const Vec& normal, const Aim& aim, Crossings& crossings,
                  PartBounds& bounds) const {
    const double infinite = std::numeric_limits<double>::infinity();
    const double aim_mm = aim.of(bounds.farthest.distance_mm);
    if (between_sides(t, normal, aim_mm)) {
      bounds.upper_mm = std::max(bounds.upper_mm, aim_mm);
      return true;
    }
    const Point center = centroid_of(t);
    const double radius_mm = farthest_corner_mm(t, center);
    const std::optional<Point> crossing = crossing_near(center, aim_mm * normal, crossings);
    if (const double upper_mm = crossing ? farthest_corner_mm(t, *crossing) : infinite; upper_mm <= aim_mm) {
      bounds.upper_mm = std::max(bounds.upper_mm, upper_mm);
      return true;
    }
    if (radius_mm >= kSmall * aim_mm && (crossing || !aim.limit_mm())) return false;
    const NearestBoundary found = nearest(center, aim_mm, std::max(aim_mm - radius_mm, 0.0));
    bounds.take({center, found.point, found.lower_mm});
    const double upper_mm = farthest_corner_mm(t, found.point);
    if (upper_mm > aim.of(bounds.farthest.distance_mm) && radius_mm >= kSmallest * aim_mm) return false;
    bounds.upper_mm = std::max(bounds.upper_mm, upper_mm);
    return true;
  }

  /// Whether the triangle, moved along its normal by no more than reach_mm, lies inside of the surface for one such
  /// move and outside for another one.
  bool between_sides(const FacetCorners& t, const Vec& normal, double reach_mm) const {
    using Side = BoundaryCells::Side;
    bool inside = false;
    bool outside = false;
    for (const double share : {1.0, -1.0, 0.4, -0.4, 0.15, -0.15}) {
      const Side side = cells_.side_of(surface_, moved(t, share * reach_mm * normal));
      inside = inside || side == Side::inside;
      outside = outside || side == Side::outside;
      if (inside && outside) return true;
    }
    return false;
  }

  static constexpr double kSmall = 0.5;      // of the bound aimed at: when to look for the nearest point
  static constexpr double kSmallest = 0.04;  // of it: what is still not bounded remains so

  const TetMesh& mesh_;
  const Domain& domain_;
  const BoundaryCells& cells_;
  std::size_t surface_;
  DistanceOptions options_;
  SurfaceMemory& memory_;
  double most_mm_;
  std::vector<std::uint32_t> facets_;
  std::vector<PartBounds> probed_;
};

}  // namespace

OneWayDistance distance_to_domain(const TetMesh& mesh, const Domain& domain, const BoundaryCells& cells,
                                  const DistanceOptions& options, std::vector<SurfaceMemory>& memory) {
  Gathering all(options);
  for (std::size_t surface = 0; surface < cells.surfaces(); ++surface) {
    all.add(ToDomain(mesh, domain, cells, surface, options, memory[surface]).run());
  }
  return all.result(true);
}

}  // namespace scantet::measuring
