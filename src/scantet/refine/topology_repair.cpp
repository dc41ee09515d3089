// The checks read the finished surface; the caller inserts the points, lets the rules finish and asks again, until
// nothing is missing. Each point is the centre of a surface ball that was too large for the place, so the sample gets
// denser only there, and a ball under the floor is left: where the level set itself is pinched there is no end to it.
#include <algorithm>

#include "scantet/refine/pieces_impl.h"
#include "scantet/refine/topology_repair_impl.h"

namespace scantet::refine {
namespace {

constexpr double kNeckShare = 0.3;  // of the smallest ball: a search for a neck ends when it is found

using LinkEdge = std::array<std::uint32_t, 2>;

/// Whether the edges form one closed path through each of their vertices.
bool is_one_cycle(std::vector<LinkEdge>& edges) {
  if (edges.size() < 3) return false;
  // Unwind the path from the first edge: each step swaps the one edge that goes on into place.
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    std::size_t found = 0;
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      if (edges[j][0] != edges[i][1] && edges[j][1] != edges[i][1]) continue;
      if (++found > 1) return false;
      std::swap(edges[i + 1], edges[j]);
    }
    if (found == 0) return false;
    if (edges[i + 1][0] != edges[i][1]) std::swap(edges[i + 1][0], edges[i + 1][1]);
  }
  return edges.back()[1] == edges.front()[0];
}

}  // namespace

std::vector<SamplePoint> TopologyRepair::missing_points() {
  balls_.clear();
  points_.clear();
  check_disks();
  if (!components_.empty()) {
    check_components();
    check_pieces();
  }
  std::sort(balls_.begin(), balls_.end());
  balls_.erase(std::unique(balls_.begin(), balls_.end()), balls_.end());
  for (std::uint32_t ball : balls_) points_.push_back({triangulation_.balls()[ball].center, true});
  return std::move(points_);
}

void TopologyRepair::check_disks() {
  for (VertexHandle v : triangulation_.triangulation().finite_vertex_handles()) {
    if (!v->info().on_boundary || v->info().disk_checked) continue;
    v->info().disk_checked = true;
    star_.clear();
    triangulation_.triangulation().incident_cells(v, std::back_inserter(star_));
    if (!boundary_is_disk_around(v)) add_largest_ball_around(v);
  }
}

bool TopologyRepair::boundary_is_disk_around(VertexHandle v) {
  std::vector<LinkEdge> link;
  for (CellHandle cell : star_) {
    const int at = cell->index(v);
    for (int i = 0; i < 4; ++i) {
      const CellHandle neighbor = cell->neighbor(i);
      if (i == at || cell->info().slot > neighbor->info().slot) continue;
      if (cell->info().region == neighbor->info().region) continue;
      std::array<std::uint32_t, 2> edge{};
      std::size_t n = 0;
      for (int k = 0; k < 4; ++k) {
        if (k != i && k != at) edge[n++] = cell->vertex(k)->info().id;
      }
      link.push_back(edge);
    }
  }
  return is_one_cycle(link);
}

void TopologyRepair::add_largest_ball_around(VertexHandle v) {
  std::uint32_t largest = kNone;
  for (CellHandle cell : star_) {
    for (int i = 0; i < 4; ++i) {
      if (i == cell->index(v)) continue;
      for (std::uint32_t b = cell->info().balls[static_cast<std::size_t>(i)]; b != kNone;
           b = triangulation_.balls()[b].next) {
        if (largest == kNone || triangulation_.balls()[b].radius > triangulation_.balls()[largest].radius) largest = b;
      }
    }
  }
  if (largest != kNone && triangulation_.balls()[largest].radius >= smallest_ball_mm_) balls_.push_back(largest);
}

void TopologyRepair::check_components() {
  std::vector<BoundaryId> caught;
  for (CellHandle cell : triangulation_.triangulation().finite_cell_handles()) {
    for (int i = 0; i < 4; ++i) {
      const std::uint32_t ball = cell->info().balls[static_cast<std::size_t>(i)];
      const bool bounds_a_tet = cell->info().region != cell->neighbor(i)->info().region;
      if (ball != kNone && bounds_a_tet) caught.push_back(triangulation_.balls()[ball].boundary);
    }
  }
  std::sort(caught.begin(), caught.end());
  const double reach = domain_.bounds().diagonal();
  for (const Component& component : components_) {
    // Grid nodes exactly at the level and none below: a cavity without volume, which no mesh can have.
    if (component.region == kOutside && domain_.residual_at(component.witness) == 0.0) continue;
    for (int i = 0; i < 27; ++i) {
      const Vec direction{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0};
      if (direction == Vec{}) continue;
      domain_.crossings({component.witness, component.witness + reach * direction}, crossings_);
      if (crossings_.empty() || crossings_.front().from != component.region) continue;
      const Point& p = crossings_.front().point;
      if (!std::binary_search(caught.begin(), caught.end(), domain_.boundary_at(p))) points_.push_back({p, true});
    }
  }
}

void TopologyRepair::check_pieces() {
  Pieces pieces(triangulation_);
  pieces.each_boundary_facet([&](CellHandle cell, int i, BoundaryId boundary) {
    if (cell->info().region != kOutside && pieces.is_side_piece(cell, boundary)) thin_balls_of(cell, i);
  });
}

void TopologyRepair::thin_balls_of(CellHandle cell, int i) {
  for (std::uint32_t b = cell->info().balls[static_cast<std::size_t>(i)]; b != kNone;
       b = triangulation_.balls()[b].next) {
    const SurfaceBall& ball = triangulation_.balls()[b];
    if (ball.radius >= kNeckShare * smallest_ball_mm_ && larger_than_thickness(ball, cell, i)) balls_.push_back(b);
  }
}

/// Whether the domain, measured from the ball's centre along the facet's inward normal, is thinner than the ball asks
/// for.
bool TopologyRepair::larger_than_thickness(const SurfaceBall& ball, CellHandle inside, int i) {
  constexpr double kShareOfThickness = 0.6;  // about five points around a tube
  const auto v = facet_vertices(inside, i);
  const Point a = position(v[0]);
  Vec normal = cross(position(v[1]) - a, position(v[2]) - a);
  if (dot(normal, position(inside->vertex(i)) - a) < 0) normal = -1 * normal;
  const double reach = ball.radius / kShareOfThickness;
  domain_.crossings({ball.center, ball.center + (reach / length(normal)) * normal}, crossings_);
  const double own = 1e-6 * reach;  // the crossing that is the centre itself
  return std::any_of(crossings_.begin(), crossings_.end(),
                     [&](const Crossing& c) { return c.to == kOutside && distance(c.point, ball.center) > own; });
}

}  // namespace scantet::refine
