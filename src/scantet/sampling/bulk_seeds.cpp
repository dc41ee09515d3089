// A body-centred cubic lattice of cube side a has tets of circumradius a·√5/4, all alike, with dihedral angles of 60°
// and 90°. Of all lattices it is the one whose balls of a given radius cover space with the fewest points. Where σ
// varies, there is a lattice for each step of σ, which holds where σ is between this step and the next.
//
// Near the boundary a lattice point is moved along the normal to the depth where it is just outside of the surface
// balls; points a little outside of the domain are brought in, too. So the layer under the boundary is as dense as the
// lattice asks for, and stays in step with it. At a boundary between two regions there is such a layer on either side.
// Where moved points come too near each other or the rest, the later one is left out.
#include "scantet/sampling/bulk_seeds.h"

#include <array>
#include <limits>
#include <optional>
#include <span>

#include "scantet/base/coordinate_hash.h"
#include "scantet/base/parallel.h"
#include "scantet/sampling/boundary_planes_impl.h"
#include "scantet/sampling/dart_throwing_impl.h"

namespace scantet {
namespace {

constexpr double kLattice = 0.998 * 1.788854381999832;  // cube side over σ; 4/√5 would make the circumradius σ
constexpr double kStep = 1.189207115002721;             // from one step of σ to the next: the fourth root of 2
constexpr int kMostSteps = 100;                         // σ up to 2^25 times its least value
// Multiples of σ:
constexpr double kDepth = 0.9;        // of the layer under the boundary, for alpha ≤ 1
constexpr double kShallowest = -0.1;  // less deep points are not moved there
constexpr double kReach = 1.35;       // distance to the boundary sample at depth kDepth, at most
constexpr double kClear = 0.8;        // from the boundary sample
constexpr double kApart = 0.65;       // from each other
constexpr double kShallow = 0.3;      // of the layer's depth: nearer to a boundary there is no seed

/// The point, moved by a little: points that are exactly cospherical would take exact arithmetic to triangulate.
Point shaken(const Point& p, double scale_mm) {
  constexpr double kShake = 1e-4;
  const std::uint64_t h = hash_of_coordinates(p);
  const auto part = [&](int shift) { return kShake * scale_mm * (double(h >> shift & 0xffff) / 0x8000 - 1); };
  return p + Vec{part(0), part(16), part(32)};
}

/// The lattice of one step of σ.
struct Lattice {
  Point corner;
  double side_mm;
  double size_mm;   // the step: the lattice holds where σ is at least this
  double next_mm;   // the next step: and less than this
  double reach_mm;  // how far from its points the boundary sample matters
};

constexpr std::int64_t kLeaf = 4;  // lattice cubes along the edge of the smallest block
constexpr std::size_t kLeafPoints = 2 * kLeaf * kLeaf * kLeaf;

/// A cube of lattice cubes, numbered from the corner of the lattice.
struct Block {
  std::array<std::int64_t, 3> first;
  std::int64_t edge;
};

class SeedMaker {
 public:
  SeedMaker(const Domain& domain, const SizingField& size, const std::vector<Point>& boundary_sample,
            const BulkSeedOptions& options, Progress& progress)
      : domain_(domain),
        size_(size),
        bounds_(domain.bounds()),
        scale_(std::max(1.0, options.alpha)),
        max_points_(options.max_points),
        progress_(progress),
        planes_(domain, size, options.alpha, boundary_sample) {}

  std::vector<Point> run() {
    double size_mm = size_.min_size();
    for (int step = 0; step < kMostSteps && !stopped(); ++step, size_mm *= kStep) {
      if (size_mm > size_.size_at(bounds_.center()) + 0.5 * bounds_.diagonal()) break;
      const double next_mm = kStep * size_mm;
      add({bounds_.min, kLattice * size_mm, size_mm, next_mm, kReach * scale_ * next_mm});
    }
    std::vector<Point> points;
    for (std::size_t i = 0; i < darts_.size(); ++i) darts_[i].turn = i;
    for (const engine::Dart& dart : engine::throw_darts(darts_, 1)) {
      points.push_back(dart.fixed ? shaken(dart.point, dart.radius_mm) : dart.point);
    }
    return points;
  }

 private:
  bool stopped() const { return darts_.size() >= max_points_ || progress_.cancelled(); }

  void add(const Lattice& lattice) {
    Block root{{0, 0, 0}, kLeaf};
    const Vec extent = bounds_.extent();
    const double longest = std::max({extent.x, extent.y, extent.z});
    while (static_cast<double>(root.edge) * lattice.side_mm < longest) root.edge *= 2;
    std::vector<Block> blocks{root};
    while (!blocks.empty() && blocks.front().edge > kLeaf && !stopped()) blocks = halved(lattice, blocks);
    moved_.clear();
    constexpr std::size_t kLeaves = 512;  // between two looks at whether to stop
    for (std::size_t begin = 0; begin < blocks.size() && !stopped(); begin += kLeaves) {
      fill({blocks.data() + begin, std::min(kLeaves, blocks.size() - begin)}, lattice);
    }
    darts_.insert(darts_.end(), moved_.begin(), moved_.end());
  }

  static Box box_of(const Lattice& lattice, const Block& block) {
    const double edge_mm = static_cast<double>(block.edge) * lattice.side_mm;
    Point low = lattice.corner;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] += lattice.side_mm * static_cast<double>(block.first[static_cast<std::size_t>(axis)]);
    }
    return {low, low + Vec{edge_mm, edge_mm, edge_mm}};
  }

  /// The halves of the blocks in which the lattice can have seeds.
  std::vector<Block> halved(const Lattice& lattice, const std::vector<Block>& blocks) const {
    constexpr std::size_t kGrain = 16;
    const auto collect = [&](std::size_t begin, std::size_t end, std::vector<Block>& halves) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto& f = blocks[i].first;
        const std::int64_t half = blocks[i].edge / 2;
        for (std::int64_t k = 0; k < 8; ++k) {
          const Block block{{f[0] + half * (k % 2), f[1] + half * (k / 2 % 2), f[2] + half * (k / 4)}, half};
          if (may_have_seeds(lattice, block)) halves.push_back(block);
        }
      }
    };
    return parallel_collect<Block>(blocks.size(), kGrain, collect);
  }

  /// Whether σ, which is 1-Lipschitz, can be in the range of the lattice there, and whether a part of the domain is
  /// there.
  bool may_have_seeds(const Lattice& lattice, const Block& block) const {
    const Box box = box_of(lattice, block);
    if (box.min.x > bounds_.max.x || box.min.y > bounds_.max.y || box.min.z > bounds_.max.z) return false;
    const double size = size_.size_at(box.center());
    const double half_diagonal = 0.5 * box.diagonal();
    if (size + half_diagonal < lattice.size_mm || size - half_diagonal >= lattice.next_mm) return false;
    // A leaf is asked when it is filled.
    return block.edge == kLeaf || holds_domain(lattice, box, [](std::uint32_t, const Point&) { return true; });
  }

  /// Makes the seeds of the leaves.
  void fill(std::span<const Block> leaves, const Lattice& lattice) {
    constexpr std::size_t kGrain = 16;
    std::vector<std::vector<engine::Dart>> made((leaves.size() + kGrain - 1) / kGrain);
    parallel_for(leaves.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) fill_leaf(lattice, leaves[i], made[begin / kGrain]);
    });
    for (const std::vector<engine::Dart>& seeds : made) {
      for (const engine::Dart& seed : seeds) (seed.fixed ? darts_ : moved_).push_back(seed);
    }
    progress_.report({"sample", "lattice", darts_.size(), std::nullopt, 0});
  }

  /// The point of the boundary sample nearest to a lattice point that has a plane.
  struct Foot {
    double squared;  // distance
    std::uint32_t index;
    double depth_mm;  // of the lattice point under the plane
  };
  using Feet = std::array<Foot, kLeafPoints>;

  static Point lattice_point(const Lattice& lattice, const Block& leaf, std::size_t i) {
    const auto n = static_cast<std::int64_t>(i) / 2;
    const double half = i % 2 == 0 ? 0.0 : 0.5;
    const Vec cube{double(leaf.first[0] + n % kLeaf), double(leaf.first[1] + n / kLeaf % kLeaf),
                   double(leaf.first[2] + n / kLeaf / kLeaf)};
    return lattice.corner + lattice.side_mm * (cube + Vec{half, half, half});
  }

  /// Calls visit(index, point) for the points of the boundary sample within reach of the box, until it returns true.
  /// Returns false if there are none and the box is outside.
  template <class Visit>
  bool holds_domain(const Lattice& lattice, const Box& box, Visit visit) const {
    const Vec reach{lattice.reach_mm, lattice.reach_mm, lattice.reach_mm};
    bool any = false;
    planes_.points().any_in({box.min - reach, box.max + reach}, [&](std::uint32_t index, const Point& foot) {
      any = true;
      return visit(index, foot);
    });
    return any || domain_.region_at(box.center()) != kOutside;
  }

  /// Offers a point of the boundary sample as foot to the points of the leaf within reach: it is taken by those that
  /// have none nearer.
  void offer(const Lattice& lattice, const Point& low, std::uint32_t index, const Point& foot, Feet& feet) const {
    for (std::size_t odd = 0; odd < 2; ++odd) {
      std::array<std::int64_t, 3> first;
      std::array<std::int64_t, 3> last;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double place = (foot[int(axis)] - low[int(axis)]) / lattice.side_mm - 0.5 * double(odd);
        const double reach = lattice.reach_mm / lattice.side_mm;
        first[axis] = std::max<std::int64_t>(0, static_cast<std::int64_t>(std::ceil(place - reach)));
        last[axis] = std::min(kLeaf - 1, static_cast<std::int64_t>(std::floor(place + reach)));
      }
      for (std::int64_t z = first[2]; z <= last[2]; ++z) {
        for (std::int64_t y = first[1]; y <= last[1]; ++y) {
          for (std::int64_t x = first[0]; x <= last[0]; ++x) {
            const double half = 0.5 * double(odd);
            const Vec away = low + lattice.side_mm * Vec{double(x) + half, double(y) + half, double(z) + half} - foot;
            const double squared = squared_length(away);
            Foot& nearest = feet[static_cast<std::size_t>(2 * (x + kLeaf * (y + kLeaf * z))) + odd];
            if (squared < nearest.squared) nearest = {squared, index, dot(planes_.inward(index), away)};
          }
        }
      }
    }
  }

  /// Makes the seeds of a leaf.
  void fill_leaf(const Lattice& lattice, const Block& leaf, std::vector<engine::Dart>& seeds) const {
    std::array<double, kLeafPoints> sizes;  // at the points; 0 where this lattice does not hold
    bool any = false;
    for (std::size_t i = 0; i < kLeafPoints; ++i) {
      const double size = size_.size_at(lattice_point(lattice, leaf, i));
      const bool holds = size >= lattice.size_mm && size < lattice.next_mm;
      sizes[i] = holds ? size : 0;
      any = any || holds;
    }
    Feet feet;
    feet.fill({std::numeric_limits<double>::infinity(), 0, 0});
    const Box box = box_of(lattice, leaf);
    const auto offer_plane = [&](std::uint32_t index, const Point& foot) {
      if (planes_.has_plane(index)) offer(lattice, box.min, index, foot, feet);
      return false;
    };
    if (!any || !holds_domain(lattice, box, offer_plane)) return;
    std::array<std::size_t, kLeafPoints> of;  // the lattice point of each place
    std::array<Point, kLeafPoints> places;
    std::array<Region, kLeafPoints> regions;
    std::size_t count = 0;
    for (std::size_t i = 0; i < kLeafPoints; ++i) {
      if (sizes[i] == 0) continue;
      const std::optional<Point> place = placed(lattice_point(lattice, leaf, i), sizes[i], feet[i]);
      if (!place) continue;
      of[count] = i;
      places[count++] = *place;
    }
    domain_.regions_at({places.data(), count}, {regions.data(), count});
    const auto always = [](std::uint32_t, const Point&, double) { return true; };
    for (std::size_t k = 0; k < count; ++k) {
      if (regions[k] == kOutside) continue;
      if (planes_.points().any_near(places[k], kClear * scale_ * sizes[of[k]], always)) continue;
      if (is_shallow(places[k], regions[k], sizes[of[k]])) continue;
      const bool fixed = places[k] == lattice_point(lattice, leaf, of[k]);
      seeds.push_back({places[k], kApart * lattice.size_mm, 0, fixed});
    }
  }

  /// The place that the lattice point is moved to; none if it is too far outside.
  std::optional<Point> placed(Point p, double size, const Foot& foot) const {
    const double reach = kReach * scale_ * size;
    if (foot.squared < reach * reach) {
      // Between two regions there is a layer on either side.
      const double side = planes_.is_interface(foot.index) && foot.depth_mm < 0 ? -1 : 1;
      const double depth_mm = side * foot.depth_mm;
      if (depth_mm < kShallowest * size) return std::nullopt;
      const double lacking = kDepth * scale_ * size - depth_mm;
      if (lacking > 0) p = p + side * lacking * planes_.inward(foot.index);
    }
    return p;
  }

  /// Whether the boundary is close to a place, far from the points that sample it: where two surfaces meet, one may be
  /// where the layer of the other is. A vertex there would have R1 part the surface from it by ever smaller facets.
  bool is_shallow(const Point& place, Region region, double size) const {
    const double shallow_mm = kShallow * kDepth * scale_ * size;
    return planes_.points().any_near(place, kReach * scale_ * size, [&](std::uint32_t i, const Point& foot, double) {
      if (!planes_.has_plane(i)) return false;
      const double depth_mm = dot(planes_.inward(i), place - foot);
      if (std::abs(depth_mm) >= shallow_mm) return false;
      const double way_mm = depth_mm < 0 ? shallow_mm : -shallow_mm;
      return domain_.region_at(place + way_mm * planes_.inward(i)) != region;
    });
  }

  const Domain& domain_;
  const SizingField& size_;
  Box bounds_;
  double scale_;  // of depth and distances, for alpha over 1
  std::uint64_t max_points_;
  Progress& progress_;
  engine::BoundaryPlanes planes_;
  LargeVector<engine::Dart> darts_;  // by step; those still in the lattice before the moved ones
  LargeVector<engine::Dart> moved_;
};

}  // namespace

SeedLattice seed_lattice(const Domain& domain, const SizingField& size) {
  constexpr double kRounding = 1e-9;
  const double steps = std::floor(std::log(size.usual_size() / size.min_size()) / std::log(kStep) + kRounding);
  return {domain.bounds().min, kLattice * size.min_size() * std::pow(kStep, std::max(steps, 0.0))};
}

std::vector<Point> bulk_seeds(const Domain& domain, const SizingField& size, const std::vector<Point>& boundary_sample,
                              const BulkSeedOptions& options, Progress& progress) {
  return SeedMaker(domain, size, boundary_sample, options, progress).run();
}

}  // namespace scantet
