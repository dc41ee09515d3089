// Both looks read the finished surface only, on all threads. Most groups of misplaced places need few points; where
// facets bridge a long slit it takes many, so each such round takes twice as many from a group as the one before.
#include <algorithm>
#include <array>

#include "scantet/base/known_sum.h"
#include "scantet/base/parallel.h"
#include "scantet/delaunay/inserter_impl.h"
#include "scantet/surface/boundary_around_impl.h"
#include "scantet/surface/boundary_link_impl.h"
#include "scantet/surface/handle_repair_impl.h"

namespace scantet::engine {
namespace {

// Tets on broken ways for each boundary vertex, and in all: with more the size is too coarse for the handles.
constexpr double kMostBroken = 0.04;
constexpr double kAlwaysMended = 1000;
constexpr double kEmpty = 0.5;  // of a ball's radius: no vertex is nearer to a point that is added

/// Goes from place to place in a triangulation that does not change.
class Walker {
 public:
  Walker(Triangulation& t, CellId start) : inserter_(t), at_(start) {}
  CellId cell_at(const Point& p) { return at_ = inserter_.cell_at(p, at_); }

 private:
  Inserter inserter_;
  CellId at_;
};

/// Looks along a way, from its ends to ever shorter parts of it, until the ends of each are in one tet.
class WayWalk {
 public:
  WayWalk(Triangulation& t, CellId start) : t_(t), walker_(t, start) {}

  /// Calls take(cell, place) for the places that are in tets of another region.
  template <class Take>
  void run(const NarrowWay& way, const Take& take) {
    const Point& a = way.segment.source;
    const Point& b = way.segment.target;
    const CellId at_a = look(way, a, take);
    look_between(way, a, at_a, b, look(way, b, take), 1, take);
  }

 private:
  static constexpr double kShortest = 0.02;  // of the way

  template <class Take>
  CellId look(const NarrowWay& way, const Point& p, const Take& take) {
    const CellId cell = walker_.cell_at(p);
    if (t_.info(cell).region != way.region) take(cell, p);
    return cell;
  }

  template <class Take>
  void look_between(const NarrowWay& way, const Point& a, CellId at_a, const Point& b, CellId at_b, double share,
                    const Take& take) {
    if (at_a == at_b || share < kShortest) return;
    const Point middle = a + 0.5 * (b - a);
    const CellId at_middle = look(way, middle, take);
    look_between(way, a, at_a, middle, at_middle, share / 2, take);
    look_between(way, middle, at_middle, b, at_b, share / 2, take);
  }

  Triangulation& t_;
  Walker walker_;
};

/// Of the boundaries of all components together; none if not known.
std::optional<std::int64_t> euler_of(const Domain& domain) {
  const std::vector<Component> components = domain.components();
  std::optional<std::int64_t> euler;
  if (!components.empty()) euler = 0;
  for (const Component& component : components) {
    if (component.region != kOutside) euler = known_sum(euler, component.euler);
  }
  return euler;
}

}  // namespace

HandleRepair::HandleRepair(const Domain& domain, RestrictedTriangulation& triangulation, const SizingField& size,
                           double alpha)
    : domain_(domain),
      restricted_(triangulation),
      t_(triangulation.triangulation()),
      closest_mm_(kClosest * alpha * size.min_size()),
      euler_(euler_of(domain)) {}

std::vector<ExtraPoint> HandleRepair::missing_points() {
  points_.clear();
  if (way_rounds_ == kWayRounds || has_euler_number()) return {};
  if (!knows_ways_) find_ways();
  std::vector<WrongTet> wrong = wrong_on_ways();
  const double vertices = 0.5 * static_cast<double>(restricted_.balls().slots());
  if (static_cast<double>(wrong.size()) > std::max(kAlwaysMended, kMostBroken * vertices)) {
    way_rounds_ = kWayRounds;
    return {};
  }
  if (!wrong.empty()) {
    ++way_rounds_;
  } else if (place_rounds_ < kPlaceRounds) {
    wrong = misplaced();
    ++place_rounds_;
  }
  for (const WrongTet& tet : wrong) add_points_at(tet);
  std::sort(points_.begin(), points_.end(), clearer);
  return std::move(points_);
}

/// Only those on which the domain's own regions, as rounding has them, agree.
void HandleRepair::find_ways() {
  knows_ways_ = true;
  domain_.narrow_ways([&](const NarrowWay& way) {
    domain_.crossings(way.segment, crossings_);
    if (crossings_.empty() && domain_.region_at(way.segment.source) == way.region) ways_.push_back(way);
  });
}

/// Whether the boundary has the Euler number of the domain's, where that is known. A closed surface of triangles has as
/// many as its Euler number and its vertices say.
bool HandleRepair::has_euler_number() const {
  if (!euler_) return true;
  const std::vector<FacetCode> facets = boundary_facets(t_);
  std::vector<bool> is_on(t_.vertex_slots());
  std::int64_t vertices = 0;
  for (const FacetCode facet : facets) {
    for (const PointId v : facet_vertices(t_.cell(facet / 4), static_cast<int>(facet % 4))) {
      vertices += is_on[v] ? 0 : 1;
      is_on[v] = true;
    }
  }
  return 2 * vertices - static_cast<std::int64_t>(facets.size()) == 2 * *euler_;
}

CellId HandleRepair::any_cell() const {
  CellId cell = 0;
  while (!t_.is_cell(cell)) ++cell;
  return cell;
}

/// Each tet once, the first place of it.
std::vector<HandleRepair::WrongTet> HandleRepair::wrong_on_ways() const {
  constexpr std::size_t kGrain = 2048;
  const CellId start = any_cell();
  std::vector<WrongTet> wrong =
      parallel_collect<WrongTet>(ways_.size(), kGrain, [&](std::size_t begin, std::size_t end, auto& found) {
        WayWalk walk(t_, start);
        for (std::size_t i = begin; i < end; ++i) {
          walk.run(ways_[i], [&](CellId cell, const Point& place) { found.push_back({cell, place}); });
        }
      });
  std::stable_sort(wrong.begin(), wrong.end(), [](const WrongTet& a, const WrongTet& b) { return a.cell < b.cell; });
  const auto is_same = [](const WrongTet& a, const WrongTet& b) { return a.cell == b.cell; };
  wrong.erase(std::unique(wrong.begin(), wrong.end(), is_same), wrong.end());
  return wrong;
}

/// Of each group those with the largest balls, as many as it is their turn.
std::vector<HandleRepair::WrongTet> HandleRepair::misplaced() {
  const std::size_t places_each = std::size_t{16} << place_rounds_;
  const CellId start = any_cell();
  const std::vector<Misplaced> places =
      domain_.misplaced([&](std::span<const Point> points, std::span<Region> regions) {
        Walker walker(t_, start);
        for (std::size_t i = 0; i < points.size(); ++i) regions[i] = t_.info(walker.cell_at(points[i])).region;
      });
  struct Ranked {
    double radius;
    WrongTet tet;
  };
  Walker walker(t_, start);
  std::vector<Ranked> group;
  std::vector<WrongTet> wrong;
  for (std::size_t i = 0; i < places.size();) {
    group.clear();
    for (const std::uint32_t number = places[i].group; i < places.size() && places[i].group == number; ++i) {
      const CellId cell = walker.cell_at(places[i].point);
      if (t_.info(cell).region == places[i].region) continue;
      const std::uint32_t ball = largest_ball(cell);
      group.push_back({ball == kNone ? 0 : restricted_.balls()[ball].radius, {cell, places[i].point}});
    }
    std::stable_sort(group.begin(), group.end(), [](const Ranked& a, const Ranked& b) { return a.radius > b.radius; });
    for (std::size_t n = 0; n < std::min(places_each, group.size()); ++n) wrong.push_back(group[n].tet);
  }
  return wrong;
}

std::uint32_t HandleRepair::largest_ball(CellId cell) const {
  std::uint32_t largest = kNone;
  for (std::uint32_t i = 0; i < 4; ++i) largest = restricted_.largest_ball(4 * cell + i, largest);
  return largest;
}

void HandleRepair::add_points_at(const WrongTet& wrong) {
  const std::uint32_t id = largest_ball(wrong.cell);
  if (id == kNone) return add_points_around(wrong.place);
  const SurfaceBall& ball = restricted_.balls()[id];
  points_.push_back({ball.center, std::max(closest_mm_, kEmpty * ball.radius)});
}

/// For tets with no facet on the surface: the boundary points along the axes.
void HandleRepair::add_points_around(const Point& place) {
  constexpr std::array<Vec, 6> kAlongAxes{{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
  const BoundaryAround around = boundary_around(domain_, place, kAlongAxes, 2 * domain_.bounds().diagonal());
  for (const Point& p : around.points) points_.push_back({p, std::max(closest_mm_, around.apart_mm)});
}

}  // namespace scantet::engine
