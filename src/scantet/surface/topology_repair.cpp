// The checks read the finished surface. The caller inserts the points, lets the rules finish and asks again, until
// nothing is missing. Each point is the centre of a surface ball that was too large for the place, so the sample gets
// denser only there. A ball below a floor is left as it is: where the level set itself is pinched, ever smaller balls
// would follow. Most rounds are about pinches, and look only at vertices whose star has changed since the round before.
#include <algorithm>
#include <cassert>

#include "scantet/base/neighbors.h"
#include "scantet/base/parallel.h"
#include "scantet/surface/boundary_link_impl.h"
#include "scantet/surface/channel_search_impl.h"
#include "scantet/surface/pieces_impl.h"
#include "scantet/surface/topology_repair_impl.h"

namespace scantet::engine {
namespace {

constexpr std::size_t kBalls = 256;  // to a thread at a time
constexpr std::size_t kDirections = 26;
constexpr double kSmallestRepair = 0.1;  // of alpha·σ: smaller surface balls are not thinned to mend the topology
constexpr double kChannelStep = 0.25;    // of alpha·σ: at which the search for a channel begins
// Balls' radii, as a share of the thickness that they should show: about five points around a tube.
constexpr double kShareOfThickness = 0.6;
// How far other points must be, as shares of a ball's radius, which is the distance to its nearest vertices. Points in
// the balls of others make short edges, and R1 much work around them. Where a neck should join pieces, less is asked,
// as more points help to find the neck.
constexpr double kEmptyAtPinch = 0.75;
constexpr double kEmptyAtNeck = 0.5;
constexpr double kNeckShare = 0.3;  // of the smallest ball: a search for a neck ends when it is found

std::uint32_t largest_ball_around(const RestrictedTriangulation& t, PointId v, const std::vector<CellId>& star) {
  std::uint32_t largest = kNone;
  for (const CellId c : star) {
    for (std::uint32_t i = 0; i < 4; ++i) {
      if (t.triangulation().cell(c).vertex[i] == v) continue;
      largest = t.largest_ball(4 * c + i, largest);
    }
  }
  return largest;
}

}  // namespace

std::vector<ExtraPoint> TopologyRepair::points_at_pinches() {
  balls_.clear();
  points_.clear();
  is_whole_ = false;
  boundary_.update_disks();
  std::erase_if(pinches_, [&](const Pinch& pinch) {
    return std::binary_search(boundary_.disks().asked().begin(), boundary_.disks().asked().end(), pinch.vertex);
  });
  constexpr std::size_t kVertices = 64;
  const std::vector<PointId>& found = boundary_.disks().found();
  const std::vector<Pinch> fresh =
      parallel_collect<Pinch>(found.size(), kVertices, [&](std::size_t begin, std::size_t end, auto& pinches) {
        std::vector<CellId> star;
        for (std::size_t n = begin; n < end; ++n) {
          triangulation_.triangulation().star_of(found[n], star);
          const std::uint32_t ball = largest_ball_around(triangulation_, found[n], star);
          if (ball != kNone && is_large(triangulation_.balls()[ball], 1)) pinches.push_back({found[n], ball});
        }
      });
  pinches_.insert(pinches_.end(), fresh.begin(), fresh.end());
  look_for_sheets();
  for (const Pinch& pinch : pinches_) balls_.push_back(pinch.ball);
  return take_points(kEmptyAtPinch);
}

/// Where a sheet is thinner than the smallest balls, each round of points leaves more pinches than the one before,
/// until all of it is covered with such balls, and pinched still. Once that is seen no more points are spent on sheets.
void TopologyRepair::look_for_sheets() {
  constexpr std::size_t kManyPinches = 1000;
  constexpr int kGrowingRounds = 3;      // before thickness is asked for
  constexpr std::size_t kGrowth = 5;     // times as many pinches: a scan of bone has grown 3.5 times and come to an end
  constexpr double kMostPinches = 0.67;  // are narrower than the smallest balls: of bone at most 0.62, of a sheet 0.77
  const bool is_growing = pinches_.size() > last_pinches_;
  growing_rounds_ = is_growing ? growing_rounds_ + 1 : 0;
  if (growing_rounds_ <= 1) first_pinches_ = pinches_.size();
  last_pinches_ = pinches_.size();
  if (!sheets_.empty() || growing_rounds_ < kGrowingRounds || pinches_.size() < kManyPinches) return;
  auto narrow = parallel_collect<Point>(pinches_.size(), kBalls, [&](std::size_t begin, std::size_t end, auto& found) {
    Crossings crossings;
    for (std::size_t i = begin; i < end; ++i) {
      const SurfaceBall& ball = triangulation_.balls()[pinches_[i].ball];
      if (is_narrower_than(1, ball, crossings)) found.push_back(ball.center);
    }
  });
  const bool are_most = static_cast<double>(narrow.size()) >= kMostPinches * static_cast<double>(pinches_.size());
  if (are_most || pinches_.size() > kGrowth * first_pinches_) sheets_ = std::move(narrow);
}

/// Whether the boundary passes once more nearer to the ball's centre than so many radii of the smallest ball there.
bool TopologyRepair::is_narrower_than(double smallest_radii, const SurfaceBall& ball, Crossings& crossings) const {
  const double reach = smallest_radii * kSmallestRepair * alpha_ * size_.size_at(ball.center);
  const double own = 1e-3 * reach;  // the crossing that is the centre itself
  return std::any_of(kNeighborDirections.begin(), kNeighborDirections.end(), [&](const Vec& direction) {
    domain_.crossings({ball.center, ball.center + (reach / length(direction)) * direction}, crossings);
    return std::any_of(crossings.begin(), crossings.end(),
                       [&](const Crossing& c) { return distance(c.point, ball.center) > own; });
  });
}

std::vector<ExtraPoint> TopologyRepair::points_on_pieces() {
  balls_.clear();
  points_.clear();
  if (known_.components.empty() && !boundary_.disks().on_facets().empty())
    return {};  // not whole, and nothing to compare it with
  const BoundarySurfaces& surfaces = boundary_.surfaces();
  is_whole_ = surfaces.is_whole();
  if (!known_.components.empty()) {
    check_components(surfaces, kDirections);
    if (!is_whole_ && known_.are_all) check_pieces(surfaces);
  }
  return take_points(kEmptyAtNeck);
}

std::vector<ExtraPoint> TopologyRepair::points_at(const Tangles& tangles) {
  balls_.clear();
  points_.clear();
  if (!tangles.pieces.empty()) find_channels(tangles);
  std::vector<CellId> star;
  for (const PointId v : tangles.vertices) {
    triangulation_.triangulation().star_of(v, star);
    const std::uint32_t ball = largest_ball_around(triangulation_, v, star);
    if (ball != kNone && is_large(triangulation_.balls()[ball], kNeckShare)) balls_.push_back(ball);
  }
  return take_points(kEmptyAtNeck);
}

/// A search in vain takes longest, and would end in the same way as long as the piece is the same.
void TopologyRepair::find_channels(const Tangles& tangles) {
  if (!hints_) {
    hints_.emplace();
    domain_.size_hints([&](const SizeHint& hint) { hints_->push_back(hint.point); });
  }
  ChannelSearch search(domain_, triangulation_, *tangles.all_pieces, *hints_);
  for (const auto& facets : tangles.pieces) {
    Outline outline = outline_of(facets);
    if (closed_.count(outline) > 0) continue;
    const double ball_mm = alpha_ * size_.size_at(vertex_of(facets.front()));
    const std::vector<SamplePoint> found =
        search.points(facets, kChannelStep * ball_mm, kNeckShare * kSmallestRepair * ball_mm);
    if (found.empty()) closed_.insert(std::move(outline));
    for (const SamplePoint& sample : found) points_.push_back(sample.point);
  }
}

TopologyRepair::Outline TopologyRepair::outline_of(const std::vector<FacetCode>& facets) const {
  Outline outline;
  for (const FacetCode facet : facets) {
    outline.push_back(facet_vertices(triangulation_.triangulation().cell(facet / 4), static_cast<int>(facet % 4)));
    std::sort(outline.back().begin(), outline.back().end());
  }
  std::sort(outline.begin(), outline.end());
  return outline;
}

const Point& TopologyRepair::vertex_of(FacetCode facet) const {
  const Triangulation& t = triangulation_.triangulation();
  return t.point(facet_vertices(t.cell(facet / 4), static_cast<int>(facet % 4))[0]);
}

/// Whether the ball is larger than the floor there, or a share of the floor.
bool TopologyRepair::is_large(const SurfaceBall& ball, double share) const {
  return ball.radius >= share * kSmallestRepair * alpha_ * size_.size_at(ball.center);
}

std::vector<Point> TopologyRepair::places_of(const Tangles& tangles) {
  const Triangulation& t = triangulation_.triangulation();
  points_.clear();
  for (const PointId v : tangles.vertices) points_.push_back(t.point(v));
  for (const auto& facets : tangles.pieces) points_.push_back(vertex_of(facets.front()));
  check_components(boundary_.surfaces(), 1);
  return std::move(points_);
}

/// Takes points_ and the centres of balls_, the largest first, where no vertex is nearer than empty_share of the
/// radius.
std::vector<ExtraPoint> TopologyRepair::take_points(double empty_share) {
  constexpr double kClosest = 1e-4;  // of alpha·σ
  const auto closest_mm = [&](const Point& p) { return kClosest * alpha_ * size_.size_at(p); };
  if (!sheets_.empty()) {
    Crossings crossings;
    std::erase_if(balls_, [&](std::uint32_t ball) {
      return is_narrower_than(1 / kShareOfThickness, triangulation_.balls()[ball], crossings);
    });
  }
  std::vector<ExtraPoint> points;
  for (const Point& p : points_) points.push_back({p, closest_mm(p)});
  for (const std::uint32_t id : balls_) {
    const SurfaceBall& ball = triangulation_.balls()[id];
    assert(ball.generation % 2 == 1);
    points.push_back({ball.center, std::max(closest_mm(ball.center), empty_share * ball.radius), ball.facet / 4});
  }
  std::sort(points.begin(), points.end(), clearer);
  points.erase(std::unique(points.begin(), points.end(),
                           [](const ExtraPoint& a, const ExtraPoint& b) { return a.point == b.point; }),
               points.end());
  return points;
}

/// Casts rays from each component's witness. They do not change while points are inserted.
void TopologyRepair::find_walls() {
  constexpr std::size_t kComponents = 4;
  walls_.resize(known_.components.size());
  const double reach = domain_.bounds().diagonal();
  parallel_for(known_.components.size(), kComponents, [&](std::size_t begin, std::size_t end) {
    Crossings crossings;
    for (std::size_t i = begin; i < end; ++i) {
      const Component& component = known_.components[i];
      for (const Vec& direction : kNeighborDirections) {
        domain_.crossings({component.witness, component.witness + reach * direction}, crossings);
        if (crossings.empty() || crossings.front().from != component.region) continue;
        walls_[i].push_back({crossings.front().patch(), crossings.front().point});
      }
    }
  });
}

/// Adds up to points_each points on each component and cavity without a facet.
void TopologyRepair::check_components(const BoundarySurfaces& surfaces, std::size_t points_each) {
  if (walls_.empty()) find_walls();
  for (const std::vector<Wall>& walls : walls_) {
    const std::size_t enough = points_.size() + points_each;
    for (const Wall& wall : walls) {
      if (points_.size() >= enough) break;
      if (!surfaces.has(wall.patch)) points_.push_back(wall.point);
    }
  }
}

void TopologyRepair::check_pieces(const BoundarySurfaces& surfaces) {
  const Pieces pieces(triangulation_, surfaces);
  const std::vector<FacetCode>& sides = pieces.side_facets();
  const auto thin =
      parallel_collect<std::uint32_t>(sides.size(), kBalls, [&](std::size_t begin, std::size_t end, auto& found) {
        Crossings crossings;
        for (std::size_t i = begin; i < end; ++i) {
          if (triangulation_.triangulation().info(sides[i] / 4).region == kOutside) continue;
          find_thin_balls(sides[i], crossings, found);
        }
      });
  balls_.insert(balls_.end(), thin.begin(), thin.end());
}

void TopologyRepair::find_thin_balls(FacetCode facet, Crossings& crossings, std::vector<std::uint32_t>& found) const {
  const std::uint32_t head = triangulation_.triangulation().info(facet / 4).balls[facet % 4];
  for (std::uint32_t b = head; b != kNone; b = triangulation_.balls()[b].next) {
    const SurfaceBall& ball = triangulation_.balls()[b];
    if (is_large(ball, kNeckShare) && is_larger_than_thickness(ball, facet, crossings)) found.push_back(b);
  }
}

/// Whether the region on that side of a facet, measured from the ball's centre along the normal into it, is thinner
/// than the ball asks for.
bool TopologyRepair::is_larger_than_thickness(const SurfaceBall& ball, FacetCode inside, Crossings& crossings) const {
  const Triangulation& t = triangulation_.triangulation();
  const Cell& cell = t.cell(inside / 4);
  const auto v = facet_vertices(cell, static_cast<int>(inside % 4));
  const Point a = t.point(v[0]);
  Vec normal = cross(t.point(v[1]) - a, t.point(v[2]) - a);
  if (dot(normal, t.point(cell.vertex[inside % 4]) - a) < 0) normal = -1 * normal;
  const double reach = ball.radius / kShareOfThickness;
  domain_.crossings({ball.center, ball.center + (reach / length(normal)) * normal}, crossings);
  const double own = 1e-6 * reach;  // the crossing that is the centre itself
  const Region region = t.info(inside / 4).region;
  return std::any_of(crossings.begin(), crossings.end(),
                     [&](const Crossing& c) { return c.from == region && distance(c.point, ball.center) > own; });
}

}  // namespace scantet::engine
