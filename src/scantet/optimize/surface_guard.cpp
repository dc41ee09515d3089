// A face at a vertex lies on the boundary if the edge across from the vertex belongs to one tet of its star only, or to
// two of different regions. How far a facet is from the surface is asked along its normal, in a few places.
#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

#include "scantet/base/mesh_topology.h"
#include "scantet/domain/nearest_crossing.h"
#include "scantet/optimize/surface_guard_impl.h"

namespace scantet::optimize {
namespace {

/// Where a facet's distance from the surface is asked for: its middle and those of its edges.
std::array<Point, 4> samples_of(const Corners& facet) {
  return {(1.0 / 3) * (facet[0] + facet[1] + facet[2]), lerp(facet[0], facet[1], 0.5), lerp(facet[1], facet[2], 0.5),
          lerp(facet[2], facet[0], 0.5)};
}

/// How far it is looked for there: half the longest edge, along the normal.
Vec reach_of(const Corners& facet) {
  const Vec normal = facet_normal(facet);
  const double longest = std::max({squared_distance(facet[0], facet[1]), squared_distance(facet[1], facet[2]),
                                   squared_distance(facet[2], facet[0])});
  return 0.5 * std::sqrt(longest / squared_length(normal)) * normal;
}

}  // namespace

Freedom SurfaceGuard::freedom(VertexId v, Fan& fan) {
  if (!complex_.on_boundary(v)) return Freedom::inside;
  if (complex_.on_curve(v)) return Freedom::none;
  find_link(v);
  const std::size_t count = keep_boundary_edges();
  if (count == 0) return Freedom::inside;
  fan.behind = edges_[0].region;
  fan.front = front_[0];
  for (std::size_t i = 1; i < count; ++i) {
    if (edges_[i].region != fan.behind || front_[i] != fan.front) return Freedom::none;
  }
  // The facet (v, to, from) points out of the tet.
  fan.rim.assign(1, edges_[0].to);
  for (auto at = edges_.begin(); at->from != fan.rim.front(); ++at) {
    const auto next = std::find_if(at + 1, edges_.end(), [&](const LinkEdge& e) { return e.to == at->from; });
    if (next == edges_.end()) return Freedom::none;
    fan.rim.push_back(at->from);
    std::swap(*(at + 1), *next);
  }
  return fan.rim.size() == count ? Freedom::on_surface : Freedom::none;
}

/// Fills edges_ with the edges across from v, each once for each tet.
void SurfaceGuard::find_link(VertexId v) {
  edges_.clear();
  for (const TetId t : complex_.star(v)) {
    const Triangle face = face_of(complex_.tet(t), corner_index(complex_.tet(t), v));
    for (std::size_t i = 0; i < 3; ++i) edges_.push_back({face[i], face[(i + 1) % 3], complex_.region(t)});
  }
}

std::optional<Lid> SurfaceGuard::lid_of(std::span<const VertexId> rim, std::initializer_list<VertexId> tips) const {
  if (rim.size() != 3) return std::nullopt;
  const auto is_on_rim = [&](VertexId v) { return v == rim[0] || v == rim[1] || v == rim[2]; };
  for (const TetId t : complex_.star(rim[0])) {
    const Tet& tet = complex_.tet(t);
    if (std::count_if(tet.begin(), tet.end(), is_on_rim) != 3) continue;
    const VertexId behind = *std::find_if_not(tet.begin(), tet.end(), is_on_rim);
    if (std::find(tips.begin(), tips.end(), behind) != tips.end()) continue;
    if (complex_.across(t, corner_index(tet, behind)) != kNoTet) return std::nullopt;
    return Lid{{complex_.point(rim[0]), complex_.point(rim[1]), complex_.point(rim[2])}, complex_.point(behind)};
  }
  return std::nullopt;
}

std::vector<FacetBetween> SurfaceGuard::facets_on_curve(VertexId v) {
  find_link(v);
  keep_boundary_edges();
  std::map<VertexId, std::size_t> facets_at;  // by the edge from v
  for (const LinkEdge& e : edges_) {
    ++facets_at[e.from];
    ++facets_at[e.to];
  }
  std::vector<std::size_t> several;
  for (const auto& [to, count] : facets_at) {
    if (count != 2) several.push_back(count);
  }
  const bool goes_on = several.empty() || (several.size() == 2 && several[0] == several[1] && several[0] > 2);
  std::vector<FacetBetween> facets;
  if (!goes_on) return facets;
  facets.reserve(edges_.size());
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const LinkEdge& e = edges_[i];
    facets.push_back({{complex_.point(v), complex_.point(e.to), complex_.point(e.from)}, {e.region, front_[i]}});
  }
  return facets;
}

bool SurfaceGuard::may_move(const FacetBetween& facet, const Corners& there, std::optional<double>& squared_bound) {
  const std::span old(&facet.corners, 1);
  if (!turns_little(old, {&there, 1})) return false;
  if (!squared_bound) squared_bound = squared_bound_of(old, facet.sides);
  return is_near(there, facet.sides, *squared_bound);
}

/// Leaves of edges_ those of boundary facets, and in front_ the regions in front of them; returns how many.
std::size_t SurfaceGuard::keep_boundary_edges() {
  const auto key = [](const LinkEdge& e) {
    return std::tuple(std::min(e.from, e.to), std::max(e.from, e.to), e.region);
  };
  const auto same = [](const LinkEdge& e, const LinkEdge& f) {
    return std::minmax(e.from, e.to) == std::minmax(f.from, f.to);
  };
  std::sort(edges_.begin(), edges_.end(), [&](const LinkEdge& e, const LinkEdge& f) { return key(e) < key(f); });
  front_.clear();
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const LinkEdge edge = edges_[i];
    const bool paired = i + 1 < edges_.size() && same(edge, edges_[i + 1]);
    const Region front = paired ? edges_[++i].region : kOutside;
    if (front == edge.region) continue;
    edges_[front_.size()] = edge;
    front_.push_back(front);
  }
  edges_.resize(front_.size());
  return front_.size();
}

Facets SurfaceGuard::facets(VertexId v, const Fan& fan) const {
  Facets facets;
  for (std::size_t i = 0; i < fan.rim.size(); ++i) {
    const VertexId p = fan.rim[i];
    const VertexId q = fan.rim[(i + 1) % fan.rim.size()];
    facets.add({complex_.point(v), complex_.point(p), complex_.point(q)}, touches_curve({v, p, q}));
  }
  return facets;
}

std::vector<VertexId> SurfaceGuard::boundary_neighbours(VertexId v) {
  find_link(v);
  keep_boundary_edges();
  std::vector<VertexId> neighbours;
  for (const LinkEdge& e : edges_) neighbours.insert(neighbours.end(), {e.from, e.to});
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  return neighbours;
}

std::optional<Point> SurfaceGuard::nearest(const Point& p, const Vec& reach, const Sides& sides) {
  domain_.crossings({p - reach, p + reach}, crossings_);
  const Crossing* const nearest =
      nearest_crossing(crossings_, p, [&](const Crossing& c) { return c.from == sides.behind && c.to == sides.front; });
  return nearest != nullptr ? std::optional(nearest->point) : std::nullopt;
}

std::optional<Point> SurfaceGuard::step_along(const Point& from, const Vec& direction, double length_mm,
                                              const Vec& normal, const Sides& sides) {
  constexpr double kLeast = 0.2;  // of a direction must be along the surface
  const Vec tangent = direction - dot(direction, normal) * normal;
  const double along = length(tangent);
  if (along < kLeast) return std::nullopt;
  return nearest(from + (length_mm / along) * tangent, length_mm * normal, sides);
}

std::optional<Point> SurfaceGuard::middle_on_surface(VertexId a, VertexId b, const Facets& facets, const Sides& sides) {
  const Vec reach = 0.5 * distance(complex_.point(a), complex_.point(b)) * mean_normal(facets.all());
  return nearest(lerp(complex_.point(a), complex_.point(b), 0.5), reach, sides);
}

Vec SurfaceGuard::mean_normal(std::span<const Corners> facets) {
  Vec sum;
  for (const Corners& facet : facets) sum = sum + facet_normal(facet);
  return (1 / length(sum)) * sum;
}

double SurfaceGuard::squared_distance_to_surface(const Corners& facet, const Sides& sides) {
  const Vec reach = reach_of(facet);
  double farthest = 0;
  for (const Point& sample : samples_of(facet)) {
    const std::optional<Point> on_surface = nearest(sample, reach, sides);
    if (!on_surface) return std::numeric_limits<double>::infinity();
    farthest = std::max(farthest, squared_distance(sample, *on_surface));
  }
  return farthest;
}

/// Whether squared_distance_to_surface() is no more than the bound. Looks no farther than that: short segments are
/// asked for quickly.
bool SurfaceGuard::is_near(const Corners& facet, const Sides& sides, double squared_bound) {
  constexpr double kBeyond = 1 + 1e-9;
  if (std::isinf(squared_bound)) return true;
  Vec reach = reach_of(facet);
  const double share = std::sqrt(squared_bound / squared_length(reach)) * kBeyond;
  if (share < 1) reach = share * reach;
  const std::array<Point, 4> samples = samples_of(facet);
  return std::all_of(samples.begin(), samples.end(), [&](const Point& sample) {
    const std::optional<Point> on_surface = nearest(sample, reach, sides);
    return on_surface && squared_distance(sample, *on_surface) <= squared_bound;
  });
}

double SurfaceGuard::sharpest(const Facets& facets) {
  double sharpest = kNoFacets;
  for (const Corners& facet : facets.asked()) sharpest = std::max(sharpest, check_.of_facet(facet, crossings_));
  return sharpest;
}

/// The domain is asked last, once for each new facet and then several times.
double SurfaceGuard::rate_replacement(const Facets& old_facets, const Facets& new_facets, const Sides& sides,
                                      Known& known, double too_sharp) {
  const std::span<const Corners> fresh = new_facets.all();
  const std::span<const Corners> asked = new_facets.asked();
  if (!turns_little(old_facets.all(), fresh)) return kInverted;
  const auto is_ill_shaped = [&](const Corners& facet) { return check_.by_shape(facet) >= too_sharp; };
  if (std::any_of(asked.begin(), asked.end(), is_ill_shaped)) return kInverted;
  double rating = kNoFacets;
  for (const Corners& facet : asked) {
    rating = std::max(rating, check_.of_facet(facet, crossings_));
    if (rating >= too_sharp) return kInverted;
  }
  if (rating > check_.bound()) {
    if (!known.sharpest) known.sharpest = sharpest(old_facets);
    if (rating > *known.sharpest) return kInverted;
  }
  if (!known.squared_bound) known.squared_bound = squared_bound_of(old_facets.all(), sides);
  const auto stays_near = [&](const Corners& facet) { return is_near(facet, sides, *known.squared_bound); };
  return std::all_of(fresh.begin(), fresh.end(), stays_near) ? rating : kInverted;
}

/// Whether no new facet turns by more than 60° from the mean of the old ones.
bool SurfaceGuard::turns_little(std::span<const Corners> old_facets, std::span<const Corners> new_facets) const {
  constexpr double kSquaredCosine = 0.25;
  Vec mean;
  for (const Corners& facet : old_facets) mean = mean + facet_normal(facet);
  return std::all_of(new_facets.begin(), new_facets.end(), [&](const Corners& facet) {
    const Vec normal = facet_normal(facet);
    const double along = dot(normal, mean);
    return along > 0 && along * along > kSquaredCosine * squared_length(normal) * squared_length(mean);
  });
}

/// How far new facets may be from the surface, squared.
double SurfaceGuard::squared_bound_of(std::span<const Corners> old_facets, const Sides& sides) {
  double bound = tolerance_mm_ * tolerance_mm_;
  for (const Corners& facet : old_facets) bound = std::max(bound, squared_distance_to_surface(facet, sides));
  return bound;
}

double typical_distance_mm(const TetComplex& complex, const Domain& domain) {
  constexpr std::size_t kVertices = 2000;
  SurfaceGuard guard(complex, domain, 0);
  Fan fan;
  double sum = 0;
  std::size_t count = 0;
  const std::size_t stride = complex.vertex_slots() / kVertices + 1;
  for (std::size_t v = 0; v < complex.vertex_slots(); v += stride) {
    const auto vertex = static_cast<VertexId>(v);
    if (guard.freedom(vertex, fan) != Freedom::on_surface) continue;
    const double squared = guard.squared_distance_to_surface(guard.facets(vertex, fan).all().front(), fan);
    if (!std::isfinite(squared)) continue;
    sum += squared;
    ++count;
  }
  return count == 0 ? 0 : std::sqrt(sum / static_cast<double>(count));
}

}  // namespace scantet::optimize
