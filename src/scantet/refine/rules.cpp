// R1 also refines a facet whose vertices and ball centres do not all lie on one component of ∂O. On a 0.09 d_M-sample
// that cannot happen (paper, proof of Lemma 3), so it changes nothing where the proofs hold; where the sample is
// sparser it keeps components apart that lie closer than σ.
#include <bit>

#include "scantet/refine/circumcenter.h"
#include "scantet/refine/rules_impl.h"

namespace scantet::refine {
namespace {

/// A number that depends on the coordinates only and orders equal ranks.
std::uint64_t hash_of(const Point& p) {
  std::uint64_t h = 0;
  for (double coordinate : {p.x, p.y, p.z}) {
    h = (h ^ std::bit_cast<std::uint64_t>(coordinate)) * 0x9e3779b97f4a7c15ULL;
    h ^= h >> 32;
  }
  return h;
}

}  // namespace

bool Rules::breaks_r1(const RestrictedTriangulation& t, CellHandle cell, int facet, std::uint32_t ball) const {
  const auto v = facet_vertices(cell, facet);
  for (VertexHandle vertex : v) {
    if (!vertex->info().on_boundary) return true;
  }
  if (radius_edge(position(v[0]), position(v[1]), position(v[2])) > options_.facet_radius_edge) return true;
  const BoundaryId boundary = v[0]->info().boundary;
  if (v[1]->info().boundary != boundary || v[2]->info().boundary != boundary) return true;
  for (; ball != kNone; ball = t.balls()[ball].next) {
    if (t.balls()[ball].boundary != boundary) return true;
  }
  return false;
}

std::optional<Violation> Rules::facet(const RestrictedTriangulation& t, std::uint32_t ball) const {
  const CellHandle cell = t.cell(t.balls()[ball].cell);
  const int facet = t.balls()[ball].facet;
  const auto violation = [&](Rule rule, double rank, std::uint32_t id) {
    return Violation{rule, rank, hash_of(t.balls()[id].center), id, t.balls()[id].serial};
  };
  std::uint32_t largest = ball;
  for (std::uint32_t b = t.balls()[ball].next; b != kNone; b = t.balls()[b].next) {
    if (t.balls()[b].radius > t.balls()[largest].radius) largest = b;
  }
  if (breaks_r1(t, cell, facet, ball)) return violation(Rule::r1, t.balls()[largest].radius, largest);

  std::uint32_t worst = kNone;
  double worst_excess = 1;
  for (std::uint32_t b = ball; b != kNone; b = t.balls()[b].next) {
    const SurfaceBall& candidate = t.balls()[b];
    double excess = candidate.radius / (options_.alpha * size_.size_at(candidate.center));
    if (options_.facet_distance_mm) {
      const auto v = facet_vertices(cell, facet);
      const Point flat_center = circumcenter(position(v[0]), position(v[1]), position(v[2]));
      excess = std::max(excess, distance(flat_center, candidate.center) / *options_.facet_distance_mm);
    }
    if (excess > worst_excess) {
      worst_excess = excess;
      worst = b;
    }
  }
  if (worst == kNone) return std::nullopt;
  return violation(Rule::r2, worst_excess, worst);
}

std::optional<Violation> Rules::tet(const RestrictedTriangulation& t, std::uint32_t slot) const {
  const CellHandle cell = t.cell(slot);
  if (cell->info().region == kOutside) return std::nullopt;
  const Point& center = cell->info().circumcenter;
  const std::array<Point, 4> points{position(cell->vertex(0)), position(cell->vertex(1)), position(cell->vertex(2)),
                                    position(cell->vertex(3))};
  const double squared_radius = squared_distance(center, points[0]);
  const double size = size_.size_at(center);
  const double by_size = squared_radius / (size * size);
  const double by_shape =
      squared_radius / (squared_shortest_edge(points) * options_.cell_radius_edge * options_.cell_radius_edge);
  if (by_size <= 1 && by_shape <= 1) return std::nullopt;
  return Violation{Rule::r3, std::max(by_size, by_shape), hash_of(center), slot, t.cell_serial(slot)};
}

}  // namespace scantet::refine
