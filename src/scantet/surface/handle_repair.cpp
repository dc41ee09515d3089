// All looks read the finished surface only, on all threads. Most groups of misplaced places need few points; where
// facets bridge a long slit it takes many, so each such round takes twice as many from a group as the one before.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include "scantet/base/known_sum.h"
#include "scantet/base/parallel.h"
#include "scantet/delaunay/inserter_impl.h"
#include "scantet/domain/append_groups.h"
#include "scantet/surface/along_curve_impl.h"
#include "scantet/surface/boundary_around_impl.h"
#include "scantet/surface/false_handles_impl.h"
#include "scantet/surface/handle_repair_impl.h"
#include "scantet/surface/misplaced_groups_impl.h"

namespace scantet::engine {
namespace {

// Tets on broken ways: so many are always mended.
constexpr double kAlwaysMended = 1000;
// One in so many ways is looked at first; if these have that many times the tets that would be too many for them, the
// others are not looked at.
constexpr std::size_t kOneIn = 16;
constexpr double kFarTooMany = 4;
constexpr std::uint64_t kFewWrong = 20;    // handles
constexpr double kSmallestOfChain = 30;    // balls, beside the least distance of points
constexpr std::size_t kMostChains = 1000;  // with more, new tangles outweigh the handles that come right
constexpr double kFewerChains = 0.75;      // so many are left by each round that helps
constexpr double kEmpty = 0.5;             // of a ball's radius: no vertex is nearer to a point that is added

/// Of a group that is so large that most of its places are not worth a look, one in so many; all of the others.
std::vector<Misplaced> thinned(const std::vector<Misplaced>& places) {
  constexpr std::size_t kMostOfGroup = 8192;
  std::vector<Misplaced> kept;
  for (std::size_t begin = 0, end = 0; begin < places.size(); begin = end) {
    while (end < places.size() && places[end].group == places[begin].group) ++end;
    const std::size_t step = (end - begin + kMostOfGroup - 1) / kMostOfGroup;
    for (std::size_t i = begin; i < end; i += step) kept.push_back(places[i]);
  }
  return kept;
}

}  // namespace

HandleRepair::HandleRepair(const Domain& domain, RestrictedTriangulation& triangulation, KnownBoundary& boundary,
                           const SizingField& size, double alpha, const Care& care)
    : domain_(domain),
      restricted_(triangulation),
      t_(triangulation.triangulation()),
      boundary_(boundary),
      size_(size),
      alpha_(alpha),
      care_(care),
      watched_asked_(triangulation.triangulation()),
      watched_(triangulation.triangulation()) {
  const std::vector<Component> components = domain.components();
  is_unknown_ = components.empty();
  if (is_unknown_) return;
  euler_ = 0;
  domain_handles_ = 0;
  for (const Component& component : components) {
    if (component.region == kOutside) continue;
    last_region_ = std::max(last_region_, component.region);
    euler_ = known_sum(euler_, component.euler);
    domain_handles_ = known_sum(domain_handles_, component.handles());
  }
}

std::vector<ExtraPoint> HandleRepair::missing_points() {
  if (are_too_many_) return {};
  is_other_euler_number_ = !has_euler_number();
  std::vector<ExtraPoint> points = points_on_ways();
  if (!is_other_euler_number_ || !points.empty() || are_too_many_ || place_rounds_ == kPlaceRounds) return points;
  points = points_at(misplaced());
  ++place_rounds_;
  return points;
}

/// Whether a ball of the chain that begins with this one is on its patch, too.
bool HandleRepair::meets_a_patch_again(const SurfaceBall& first) const {
  for (std::uint32_t b = first.next; b != kNone; b = restricted_.balls()[b].next) {
    if (restricted_.balls()[b].patch == first.patch) return true;
  }
  return false;
}

/// Small balls are left alone, as where the boundary is pinched there is no end to them.
std::vector<ExtraPoint> HandleRepair::points_on_chains() {
  points_.clear();
  if (!is_other_euler_number_ || are_too_many_ || most_chains_ == 0) return {};
  for (std::uint32_t b = 0; b < restricted_.balls().slots(); ++b) {
    const SurfaceBall& first = restricted_.balls()[b];
    if (first.generation % 2 == 0 || first.next == kNone) continue;
    if (t_.info(first.facet / 4).balls[first.facet % 4] != b || !meets_a_patch_again(first)) continue;
    const SurfaceBall& ball = restricted_.balls()[restricted_.largest_ball(first.facet, kNone)];
    const double closest_mm = closest_at(ball.center);
    if (ball.radius < kSmallestOfChain * closest_mm) continue;
    points_.push_back({ball.center, std::max(closest_mm, kEmpty * ball.radius), first.facet / 4});
  }
  if (points_.size() > std::min(most_chains_, kMostChains)) {
    most_chains_ = 0;
    return {};
  }
  most_chains_ = static_cast<std::size_t>(kFewerChains * static_cast<double>(points_.size()));
  std::sort(points_.begin(), points_.end(), clearer);
  return std::move(points_);
}

std::vector<ExtraPoint> HandleRepair::points_on_ways() {
  if (!(is_other_euler_number_ || is_unknown_) || are_too_many_ || way_rounds_ == care_.way_rounds) return {};
  const double vertices = 0.5 * static_cast<double>(restricted_.balls().slots());
  const double most = std::max(kAlwaysMended, care_.most_broken * vertices);
  if (!knows_ways_) {
    ways_ = agreed_ways(domain_, care_.ground);
    knows_ways_ = true;
    if (are_far_too_many(most)) return leave_ways();
  }
  const std::vector<WrongTet> wrong = watched_.wrong(ways_);
  if (static_cast<double>(wrong.size()) > most) return leave_ways();
  if (!wrong.empty()) ++way_rounds_;
  return points_at(wrong);
}

/// Where the size is too coarse for the ways, it is so for the handles; but if few of these are wrong, most ways are of
/// no account, and the handles are mended without them.
std::vector<ExtraPoint> HandleRepair::leave_ways() {
  way_rounds_ = care_.way_rounds;
  are_too_many_ = !care_.keeps_few || wrong_count() > kFewWrong;
  return {};
}

std::vector<ExtraPoint> HandleRepair::points_on_asked_ways() {
  if (!are_ways_asked_for()) return {};
  return points_at(watched_asked_.wrong(care_.asked));
}

std::vector<ExtraPoint> HandleRepair::points_on_false_handles() {
  if (are_too_many_ || false_rounds_ == kFalseRounds || !(seeks_exchanged_ || missing_euler() > 0)) return {};
  const std::size_t places_each = std::size_t{4} << false_rounds_;
  ++false_rounds_;
  std::vector<Misplaced> places;
  for (Region first = 1; first <= last_region_; ++first) {
    append_groups(false_handles(boundary_within(first), first, t_, domain_, size_), places);
  }
  return points_at(wrong_at(places, places_each));
}

std::vector<Point> HandleRepair::exchanged_places() {
  if (!euler_ || domain_handles_ == 0 || !has_euler_number()) return {};
  return one_of_each_group();
}

std::vector<Point> HandleRepair::wrong_places() {
  if (are_too_many_ || has_euler_number()) return {};
  std::vector<Point> places = one_of_each_group();
  for (const MisplacedGroup& group : misplaced_groups(domain_, t_)) places.push_back(group.place);
  if (places.empty()) {
    for (const WrongTet& tet : watched_.wrong(ways_)) places.push_back(tet.place);
  }
  return places;
}

std::uint64_t HandleRepair::wrong_count() {
  return (static_cast<std::uint64_t>(std::abs(missing_euler())) + 1) / 2;
}

std::int64_t HandleRepair::missing_euler() {
  return euler_ && !are_too_many_ ? *euler_ - boundary_.surfaces().euler_number() : 0;
}

std::vector<Point> HandleRepair::one_of_each_group() {
  std::vector<Point> places;
  const std::vector<WrongTet> wrong = misplaced();
  for (std::size_t i = 0; i < wrong.size(); ++i) {
    if (i == 0 || wrong[i].group != wrong[i - 1].group) places.push_back(wrong[i].place);
  }
  return places;
}

/// Whether the boundary has the Euler number of the domain's, where that is known.
bool HandleRepair::has_euler_number() {
  return !euler_ || boundary_.surfaces().euler_number() == *euler_;
}

/// Whether the ways that are looked at first are broken so often that all would have too many broken tets by far.
bool HandleRepair::are_far_too_many(double most) {
  std::vector<NarrowWay> some;
  for (std::size_t n = 0; n < ways_.size(); n += kOneIn) some.push_back(ways_[n]);
  WatchedWays watched(t_);
  return static_cast<double>(kOneIn * watched.wrong(some).size()) > kFarTooMany * most;
}

/// The facets between regions from `first` on and those before, as seen from within.
TriangleSurface HandleRepair::boundary_within(Region first) {
  TriangleSurface surface;
  surface.vertices.reserve(t_.vertex_slots());
  for (PointId v = 0; v < t_.vertex_slots(); ++v) surface.vertices.push_back(t_.point(v));
  const BoundaryFacets& facets = boundary_.facets();
  surface.facets.reserve(facets.codes.size());
  for (std::size_t n = 0; n < facets.codes.size(); ++n) {
    const CellId cell = facets.codes[n] / 4;
    const bool is_within = t_.info(cell).region >= first;
    if (is_within == (t_.info(t_.cell(cell).neighbor[facets.codes[n] % 4] / 4).region >= first)) continue;
    const auto& [a, b, c] = facets.corners[n];
    surface.facets.push_back(is_within ? Triangle{a, b, c} : Triangle{a, c, b});
  }
  return surface;
}

std::vector<WrongTet> HandleRepair::misplaced() {
  return wrong_at(thinned(domain_.misplaced([&](Region first) { return boundary_within(first); }, {})),
                  std::size_t{16} << place_rounds_);
}

/// Of each group so many, those with the largest balls.
std::vector<WrongTet> HandleRepair::wrong_at(const std::vector<Misplaced>& places, std::size_t places_each) const {
  const std::vector<CellId> cells = cells_at(places);
  struct Ranked {
    double radius;
    WrongTet tet;
  };
  std::vector<Ranked> group;
  std::vector<WrongTet> wrong;
  for (std::size_t i = 0; i < places.size();) {
    group.clear();
    for (const std::uint32_t number = places[i].group; i < places.size() && places[i].group == number; ++i) {
      if (t_.info(cells[i]).region == places[i].region) continue;
      const std::uint32_t ball = largest_ball(cells[i]);
      group.push_back({ball == kNone ? 0 : restricted_.balls()[ball].radius, {cells[i], places[i].point, number}});
    }
    std::stable_sort(group.begin(), group.end(), [](const Ranked& a, const Ranked& b) { return a.radius > b.radius; });
    for (std::size_t n = 0; n < std::min(places_each, group.size()); ++n) wrong.push_back(group[n].tet);
  }
  return wrong;
}

std::vector<CellId> HandleRepair::cells_at(const std::vector<Misplaced>& places) const {
  constexpr std::size_t kGrain = 1024;
  const CellId start = any_cell(t_);
  std::vector<CellId> cells(places.size());
  const auto point = [](const Misplaced& place) -> const Point& { return place.point; };
  const std::vector<std::uint32_t> order = along_curve(places, domain_.bounds(), point);
  parallel_for(places.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    Inserter inserter(t_);
    CellId at = start;
    for (std::size_t i = begin; i < end; ++i) {
      cells[order[i]] = at = inserter.cell_at(places[order[i]].point, at);
    }
  });
  return cells;
}

std::uint32_t HandleRepair::largest_ball(CellId cell) const {
  std::uint32_t largest = kNone;
  for (std::uint32_t i = 0; i < 4; ++i) largest = restricted_.largest_ball(4 * cell + i, largest);
  return largest;
}

std::vector<ExtraPoint> HandleRepair::points_at(const std::vector<WrongTet>& wrong) {
  points_.clear();
  for (const WrongTet& tet : wrong) add_points_at(tet);
  std::sort(points_.begin(), points_.end(), clearer);
  return std::move(points_);
}

void HandleRepair::add_points_at(const WrongTet& wrong) {
  const std::uint32_t id = largest_ball(wrong.cell);
  if (id == kNone) return add_points_around(wrong);
  const SurfaceBall& ball = restricted_.balls()[id];
  points_.push_back({ball.center, std::max(closest_at(ball.center), kEmpty * ball.radius), wrong.cell});
}

/// For tets with no facet on the surface: the boundary points along the axes.
void HandleRepair::add_points_around(const WrongTet& wrong) {
  constexpr std::array<Vec, 6> kAlongAxes{{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
  const BoundaryAround around = boundary_around(domain_, wrong.place, kAlongAxes, 2 * domain_.bounds().diagonal());
  for (const Point& p : around.points) points_.push_back({p, std::max(closest_at(p), around.apart_mm), wrong.cell});
}

}  // namespace scantet::engine
