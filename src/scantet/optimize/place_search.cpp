// A pattern search: steps to all sides, and shorter ones when none helps. The sharpest angle around a vertex changes
// along ridges, where its gradient says little; and most steps are given up at the first tet, for it is kept in front.
#include <algorithm>
#include <limits>

#include "scantet/base/mesh_topology.h"
#include "scantet/optimize/place_search_impl.h"

namespace scantet::optimize {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The unit vectors from the middle of a cube to its faces and its corners.
constexpr std::array<Vec, 14> make_directions() {
  constexpr double kCorner = 0.57735026918962576;
  std::array<Vec, 14> directions{Vec{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (unsigned i = 0; i < 8; ++i) {
    directions[6 + i] = {(i & 1U) != 0 ? kCorner : -kCorner, (i & 2U) != 0 ? kCorner : -kCorner,
                         (i & 4U) != 0 ? kCorner : -kCorner};
  }
  return directions;
}

constexpr std::array<Vec, 14> kDirections = make_directions();

}  // namespace

void PlaceSearch::add_star(const TetComplex& complex, VertexId v, VertexId without) {
  for (const TetId t : complex.star(v)) {
    const Tet& tet = complex.tet(t);
    if (has_vertex(tet, without)) continue;
    const Triangle face = face_of(tet, corner_index(tet, v));
    add_face(complex.point(face[0]), complex.point(face[1]), complex.point(face[2]));
  }
}

Place PlaceSearch::run(const Point& start, double facets_at_start, const Step& step, const RateFacets& rate_facets) {
  constexpr double kFirstStep = 1.0 / 4;  // of the shortest edge
  const double last_step = depth_ == Depth::deep ? 1.0 / 65536 : 1.0 / 256;
  const double scale = shortest_edge(start);
  Place place{start, std::max(sharpest_at(start, kInfinity), facets_at_start)};
  direction_ = 0;
  for (double length = kFirstStep; length >= last_step && place.sharpest > bound_;) {
    if (!look_around(place, length * scale, step, rate_facets)) length /= 2;
  }
  return place;
}

Place PlaceSearch::run_on_surface(const Point& start, SurfaceGuard& guard, const SurfaceMove& move) {
  const Vec normal = SurfaceGuard::mean_normal(move.before.all());
  SurfaceGuard::Known known{std::nullopt, move.sharpest};
  const auto rate = [&](const Point& p, double too_sharp) {
    if (move.lid && move.lid->turns_over(p)) return kInverted;
    for (Corners& facet : move.moved.all()) facet[0] = p;
    return guard.rate_replacement(move.before, move.moved, move.sides, known, too_sharp);
  };
  const auto step = [&](const Point& from, const Vec& direction, double length_mm) {
    return guard.step_along(from, direction, length_mm, normal, move.sides);
  };
  return run(start, move.sharpest ? *move.sharpest : rate(start, kInverted), step, rate);
}

double PlaceSearch::shortest_edge(const Point& start) const {
  double shortest = kInfinity;
  for (const Corners& face : faces_) {
    for (const Point& p : face) shortest = std::min(shortest, squared_distance(p, start));
  }
  return std::sqrt(shortest);
}

/// Takes the first step in any direction that makes the place better. Returns whether there is one.
bool PlaceSearch::look_around(Place& place, double step_mm, const Step& step, const RateFacets& rate_facets) {
  const double least_gain = depth_ == Depth::deep ? 1e-8 : 1e-5;
  for (std::size_t i = 0; i < kDirections.size(); ++i) {
    const std::size_t direction = (direction_ + i) % kDirections.size();
    const std::optional<Point> p = step(place.point, kDirections[direction], step_mm);
    if (!p) continue;
    const double too_sharp = place.sharpest - least_gain;
    const double of_tets = sharpest_at(*p, too_sharp);
    if (of_tets == kInverted) continue;
    const double of_facets = rate_facets(*p, too_sharp);
    if (of_facets >= too_sharp) continue;
    place = {*p, std::max(of_tets, of_facets)};
    direction_ = direction;
    return true;
  }
  return false;
}

/// How sharp the sharpest tet is with the vertex at p; kInverted if one is as sharp as `too_sharp`.
double PlaceSearch::sharpest_at(const Point& p, double too_sharp) {
  double sharpest = bound_;
  for (Corners& face : faces_) {
    const double sharpness = judge_.sharpness(p, face[0], face[1], face[2], too_sharp);
    if (sharpness >= too_sharp) {
      std::swap(faces_.front(), face);
      return kInverted;
    }
    sharpest = std::max(sharpest, sharpness);
  }
  return sharpest;
}

}  // namespace scantet::optimize
