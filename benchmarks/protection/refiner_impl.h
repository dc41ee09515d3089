// The refinement loop that both kernels share: rules R1 to R3 of the paper (see docs/algorithm.md) on restricted facets
// and tets, worst first. Private: it shows CGAL. Long; reason: one class template, compiled for each kernel apart.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <optional>
#include <queue>
#include <stdexcept>

#include "refined.h"

namespace scantet::bench {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// A surface ball: where the dual of a facet crosses an interface.
struct SurfaceBall {
  Point center;
  double squared_radius = 0;  ///< power distance to the facet's vertices, mm^2
  int patch = 0;
};

struct CellInfo {
  std::uint64_t stamp = 0;  ///< one for each cell that ever was
  int region = 0;
  Point center;
  double squared_radius = 0;
  std::vector<SurfaceBall> balls[4];
};

/// The centre of the sphere orthogonal to four weighted points, without weights their circumcentre; and its
/// determinant.
template <typename Number>
std::array<Number, 4> orthocenter(const std::array<const MeshVertex*, 4>& v) {
  std::array<std::array<Number, 3>, 3> e;
  std::array<Number, 3> s;
  const Number origin[3] = {Number(v[0]->point.x), Number(v[0]->point.y), Number(v[0]->point.z)};
  for (int i = 0; i < 3; ++i) {
    s[i] = Number(v[0]->weight) - Number(v[i + 1]->weight);
    for (int k = 0; k < 3; ++k) {
      e[i][k] = Number(v[i + 1]->point[k]) - origin[k];
      s[i] += e[i][k] * e[i][k];
    }
  }
  const auto across = [](const std::array<Number, 3>& a, const std::array<Number, 3>& b, int k) {
    return Number(a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);
  };
  Number det(0);
  for (int k = 0; k < 3; ++k) det += e[0][k] * across(e[1], e[2], k);
  std::array<Number, 4> center{Number(0), Number(0), Number(0), det};
  if (det == Number(0)) return center;
  for (int k = 0; k < 3; ++k) {
    center[k] =
        origin[k] + (s[0] * across(e[1], e[2], k) + s[1] * across(e[2], e[0], k) + s[2] * across(e[0], e[1], k)) /
                        (Number(2) * det);
  }
  return center;
}

/// In rational arithmetic where the tet is nearly flat, as many are whose vertices lie on a plane of the domain.
inline Point center_of(const MeshVertex& a, const MeshVertex& b, const MeshVertex& c, const MeshVertex& d) {
  const std::array<const MeshVertex*, 4> v{&a, &b, &c, &d};
  const auto quick = orthocenter<double>(v);
  const double scale = distance(a.point, b.point) * distance(a.point, c.point) * distance(a.point, d.point);
  if (std::abs(quick[3]) > 1e-4 * scale) return {quick[0], quick[1], quick[2]};
  const auto exact = orthocenter<CGAL::Exact_rational>(v);
  return {CGAL::to_double(exact[0]), CGAL::to_double(exact[1]), CGAL::to_double(exact[2])};
}

/// Tr: a Delaunay or a regular triangulation, vertices with an int, cells with a CellInfo. Access: find_conflicts,
/// make, bare.
template <typename Tr, typename Access>
class Refiner {
  using Cell = typename Tr::Cell_handle;
  using Vertex = typename Tr::Vertex_handle;

 public:
  Refiner(const Arrangement& domain, Method method, const RefinementBounds& bounds)
      : domain_(domain), method_(method), bounds_(bounds) {}

  Refined run(unsigned seed) {
    const auto start = std::chrono::steady_clock::now();
    sample_ = sample_curves(domain_, bounds_.size_mm, method_);
    result_.loose = sample_.loose;
    result_.curve_samples = static_cast<int>(sample_.segments.size());
    const auto patches = sample_patches(domain_, sample_, bounds_.size_mm, method_, seed);
    std::vector<MeshVertex> first = std::exchange(sample_.vertices, {});
    insert_first(first);
    for (const MeshVertex& v : patches) insert(v, Cell());
    if (method_ == Method::kSplit)
      for (std::size_t s = 0; s < sample_.segments.size(); ++s) encroached_.push_back(static_cast<int>(s));
    for (Cell c : triangulation_.finite_cell_handles()) measure(c);
    for (Cell c : triangulation_.finite_cell_handles()) find_balls(c);
    running_ = true;
    while (!result_.capped && pass()) {
    }
    result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    extract();
    return std::move(result_);
  }

 private:
  struct Task {
    double badness;
    std::uint64_t order;
    Cell cell;
    std::uint64_t stamp;
    int facet;
    bool operator<(const Task& other) const {
      return badness != other.badness ? badness < other.badness : order > other.order;
    }
  };

  const MeshVertex& at(Cell c, int i) const { return sample_.vertices[c->vertex(i)->info()]; }

  /// The curves' samples, ids from 0 on; and before them, as they may lie in a plane, eight points so far away that all
  /// duals within the domain are finite.
  void insert_first(const std::vector<MeshVertex>& curves) {
    sample_.vertices = curves;
    for (int i = 0; i < 8; ++i) {
      const double far = 6 * domain_.radius();
      const Vec off{i & 1 ? far : -far, i & 2 ? far : -far, i & 4 ? far : -far};
      sample_.vertices.push_back({domain_.center() + off});
    }
    const std::size_t count = sample_.vertices.size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t id = (i + curves.size()) % count;
      const Vertex v = triangulation_.insert(Access::make(sample_.vertices[id]));
      if (v == Vertex() || triangulation_.number_of_vertices() != i + 1)
        throw std::logic_error("a sample of a curve is hidden by others");
      v->info() = static_cast<int>(id);
    }
  }

  /// Looks at every element until none is left to look at; false if no point came of it.
  bool pass() {
    const std::size_t before = sample_.vertices.size();
    for (Cell c : triangulation_.finite_cell_handles()) queue(c);
    result_.refused = 0;  // Those of the last pass are the ones that stay.
    while (!result_.capped && step())
      result_.capped = static_cast<int>(sample_.vertices.size()) >= bounds_.most_vertices;
    return sample_.vertices.size() > before;
  }

  /// Makes a vertex; -1 if the point is one already or hidden by weights.
  int insert(const MeshVertex& vertex, Cell near) {
    const int id = static_cast<int>(sample_.vertices.size());
    const std::size_t before = triangulation_.number_of_vertices();
    const Vertex v = triangulation_.insert(Access::make(vertex), near);
    if (v == Vertex() || triangulation_.number_of_vertices() <= before) return -1;
    v->info() = id;
    sample_.vertices.push_back(vertex);
    if (!running_) return id;
    std::vector<Cell> cells;
    triangulation_.finite_incident_cells(v, std::back_inserter(cells));
    for (Cell c : cells) measure(c);
    for (Cell c : cells) find_balls(c);
    for (Cell c : cells) queue(c);
    last_cell_ = cells.empty() ? Cell() : cells.front();
    return id;
  }

  void measure(Cell c) {
    CellInfo& info = c->info();
    info.stamp = ++stamps_;
    info.center = center_of(at(c, 0), at(c, 1), at(c, 2), at(c, 3));
    info.squared_radius = squared_distance(info.center, at(c, 0).point) - at(c, 0).weight;
    info.region = is_finite(info.center) ? domain_.region_at(info.center) : 0;
  }

  void find_balls(Cell c) {
    for (int i = 0; i < 4; ++i) {
      const Cell other = c->neighbor(i);
      c->info().balls[i].clear();
      if (triangulation_.is_infinite(other)) continue;
      // From the older cell to the younger, so that both find the same.
      const bool older = c->info().stamp < other->info().stamp;
      const Point &from = (older ? c : other)->info().center, &to = (older ? other : c)->info().center;
      const MeshVertex& v = at(c, (i + 1) % 4);
      for (const Crossing& crossing : domain_.crossings(from, to)) {
        c->info().balls[i].push_back(
            {crossing.point, squared_distance(crossing.point, v.point) - v.weight, crossing.patch});
      }
      other->info().balls[other->index(c)] = c->info().balls[i];
    }
  }

  bool is_off_patch(Cell c, int facet) const {
    for (const SurfaceBall& ball : c->info().balls[facet]) {
      for (int i = 1; i < 4; ++i)
        if (!(at(c, (facet + i) % 4).patches >> ball.patch & 1)) return true;
    }
    return false;
  }

  /// Of the circle orthogonal to the three vertices' balls: without weights the circumcircle. A point inserted for a
  /// bound on this ratio is farther from its neighbours than they are from each other, as in the proof without weights.
  double facet_radius_edge(Cell c, int facet) const {
    const MeshVertex &p = at(c, (facet + 1) % 4), &q = at(c, (facet + 2) % 4), &r = at(c, (facet + 3) % 4);
    const Vec u = q.point - p.point, v = r.point - p.point;
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), area = uu * vv - uv * uv;
    const double a = (uu + p.weight - q.weight) / 2, b = (vv + p.weight - r.weight) / 2;
    const Vec to_center = ((a * vv - b * uv) / area) * u + ((b * uu - a * uv) / area) * v;
    const double squared = squared_length(to_center) - p.weight;
    return squared <= 0 ? 0 : std::sqrt(squared / std::min({uu, vv, squared_distance(q.point, r.point)}));
  }

  static double largest(const std::vector<SurfaceBall>& balls) {
    double most = 0;
    for (const SurfaceBall& ball : balls) most = std::max(most, ball.squared_radius);
    return std::sqrt(most);
  }

  double tet_badness(Cell c) const {
    if (c->info().region == 0 || c->info().squared_radius <= 0) return 0;
    const double radius = std::sqrt(c->info().squared_radius);
    double shortest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) shortest = std::min(shortest, distance(at(c, i).point, at(c, j).point));
    return std::max(radius / bounds_.size_mm, radius / shortest / bounds_.tet_radius_edge);
  }

  void queue(Cell c) {
    for (int i = 0; i < 4; ++i) {
      if (c->info().balls[i].empty()) continue;
      const double radius = largest(c->info().balls[i]);
      if (is_off_patch(c, i) || facet_radius_edge(c, i) > bounds_.facet_radius_edge) push(0, radius, c, i);
      if (radius > bounds_.size_mm) push(1, radius, c, i);
    }
    if (const double badness = tet_badness(c); badness > 1) push(2, badness, c, -1);
  }
  void push(int rule, double badness, Cell c, int facet) {
    tasks_[rule].push({badness, ++orders_, c, c->info().stamp, facet});
  }

  /// One point more, or one refusal; false when nothing is left to do.
  bool step() {
    while (!encroached_.empty()) {
      const int segment = encroached_.front();
      encroached_.pop_front();
      if (is_encroached(segment) && split(segment)) return true;
    }
    for (int rule = 0; rule < 3; ++rule) {
      auto& tasks = tasks_[rule];
      while (!tasks.empty()) {
        const Task task = tasks.top();
        tasks.pop();
        if (!still_there(task) || !is_bad(task.cell, task.facet)) continue;
        const bool changed = rule == 2 ? refine_tet(task.cell) : refine_facet(task.cell, task.facet);
        if (changed && still_there(task)) tasks.push(task);
        return true;
      }
    }
    return false;
  }
  bool still_there(const Task& task) const {
    return triangulation_.tds().cells().is_used(task.cell) && task.cell->info().stamp == task.stamp;
  }

  bool is_bad(Cell c, int facet) const {
    if (facet < 0) return tet_badness(c) > 1;
    if (c->info().balls[facet].empty()) return false;
    return is_off_patch(c, facet) || is_bad_facet(c, facet);
  }
  bool is_bad_facet(Cell c, int facet) const {
    return facet_radius_edge(c, facet) > bounds_.facet_radius_edge || largest(c->info().balls[facet]) > bounds_.size_mm;
  }

  bool refine_facet(Cell c, int facet) {
    const auto& balls = c->info().balls[facet];
    may_push_ = is_off_patch(c, facet);
    return insert_ball(*std::max_element(balls.begin(), balls.end(),
                                         [](const SurfaceBall& a, const SurfaceBall& b) {
                                           return a.squared_radius < b.squared_radius;
                                         }),
                       c);
  }

  bool refine_tet(Cell c) {
    may_push_ = false;
    const Point center = c->info().center;
    std::vector<Cell> zone;
    Access::find_conflicts(triangulation_, center, c, zone);
    const SurfaceBall* deepest = nullptr;
    double depth = 0;
    for (Cell in : zone) {
      for (const auto& balls : in->info().balls) {
        for (const SurfaceBall& ball : balls) {
          const double d = ball.squared_radius - squared_distance(ball.center, center);
          if (d > depth) {
            depth = d;
            deepest = &ball;
          }
        }
      }
    }
    if (deepest) return insert_ball(*deepest, c);
    return offer({center}, c->info().squared_radius, c);
  }

  bool insert_ball(const SurfaceBall& ball, Cell near) {
    return offer({ball.center, 0, 2, Patches{1} << ball.patch}, ball.squared_radius, near);
  }

  /// Inserts a candidate, or what is done in its place if it is protected from; false if nothing is inserted.
  bool offer(const MeshVertex& vertex, double squared_radius, Cell near) {
    int segment = -1;
    if (method_ == Method::kWeights ? squared_radius <= 0 : is_protected(sample_, vertex.point, segment)) {
      if (segment >= 0 && method_ == Method::kSplit && split(segment)) return true;
      if (may_push_ && method_ == Method::kCollar && push_out(vertex)) return true;
      ++result_.refused;
      return false;
    }
    if (insert(vertex, near) >= 0) return true;
    ++result_.refused;
    return false;
  }

  /// C: a candidate in a guard gives way to the point of its patch where it leaves the guard, away from the curve.
  bool push_out(MeshVertex vertex) {
    for (int times = 0; times < 4; ++times) {
      const Guard* guard = nullptr;
      for (const Guard& g : sample_.guards) {
        if (squared_distance(g.center, vertex.point) < g.radius * g.radius &&
            (!guard ||
             distance(g.center, vertex.point) - g.radius < distance(guard->center, vertex.point) - guard->radius))
          guard = &g;
      }
      if (!guard) break;
      const Vec out = unit(vertex.point - guard->center);
      const auto moved = on_patch(guard->center + (1 + 1e-6) * guard->radius * out, vertex, 0.3 * guard->radius);
      if (!moved) return false;
      vertex.point = *moved;
    }
    int segment = -1;
    if (is_protected(sample_, vertex.point, segment)) return false;
    for (const Guard& guard : sample_.guards) {  // Not on top of what is there.
      if (distance(guard.center, vertex.point) < 1.01 * guard.radius && is_crowded(vertex.point, 0.02 * guard.radius))
        return false;
    }
    return insert(vertex, last_cell_used()) >= 0;
  }

  bool is_crowded(const Point& p, double reach) const {
    return std::any_of(sample_.vertices.begin(), sample_.vertices.end(),
                       [&](const MeshVertex& v) { return squared_distance(v.point, p) < reach * reach; });
  }

  /// The nearest crossing of the vertex's patch on lines along three axes; none within reach: nothing.
  std::optional<Point> on_patch(const Point& p, const MeshVertex& vertex, double reach) const {
    std::optional<Point> best;
    for (int axis = 0; axis < 3; ++axis) {
      Vec off;
      off[axis] = reach;
      for (const Crossing& crossing : domain_.crossings(p - off, p + off)) {
        if ((vertex.patches >> crossing.patch & 1) &&
            (!best || squared_distance(crossing.point, p) < squared_distance(*best, p)))
          best = crossing.point;
      }
    }
    return best;
  }

  double length_of(const CurveSegment& s) const {
    return distance(sample_.vertices[s.vertex[0]].point, sample_.vertices[s.vertex[1]].point);
  }

  bool is_encroached(int segment) const {
    const CurveSegment& s = sample_.segments[segment];
    const Point &a = sample_.vertices[s.vertex[0]].point, &b = sample_.vertices[s.vertex[1]].point;
    return std::any_of(sample_.vertices.begin(), sample_.vertices.end(), [&](const MeshVertex& v) {
      return v.point != a && v.point != b && dot(v.point - a, v.point - b) < 0;
    });
  }

  /// Halves a segment; one that ends at a corner together with all others there, so that they stay equally long.
  bool split(int segment) {
    const CurveSegment s = sample_.segments[segment];
    if (length_of(s) <= bounds_.split_floor * bounds_.size_mm) return false;
    const int corners = static_cast<int>(domain_.corners().size());
    bool done = false;
    for (int end = 0; end < 2; ++end) {
      if (s.vertex[end] >= corners) continue;
      const double reach = length_of(s) / 2;
      for (std::size_t i = 0, count = sample_.segments.size(); i < count; ++i) {
        for (int e = 0; e < 2; ++e) {
          if (sample_.segments[i].vertex[e] == s.vertex[end])
            done |= split_at(static_cast<int>(i), at_distance(sample_.segments[i], e, reach));
        }
      }
      return done;
    }
    return split_at(segment, (s.from + s.to) / 2);
  }

  double at_distance(const CurveSegment& s, int end, double reach) const {
    const Curve& curve = domain_.curves()[s.curve];
    const Point corner = sample_.vertices[s.vertex[end]].point;
    double near = end ? s.to : s.from, far = end ? s.from : s.to;
    for (int i = 0; i < 60; ++i) {
      const double middle = (near + far) / 2;
      (distance(curve.at(middle), corner) < reach ? near : far) = middle;
    }
    return near;
  }

  bool split_at(int segment, double place) {
    const CurveSegment s = sample_.segments[segment];
    const Curve& curve = domain_.curves()[s.curve];
    const int id = insert({curve.at(place), 0, 1, curve.patches}, last_cell_used());
    if (id < 0) return false;
    sample_.segments[segment] = {s.curve, s.from, place, {s.vertex[0], id}};
    sample_.segments.push_back({s.curve, place, s.to, {id, s.vertex[1]}});
    encroached_.push_back(segment);
    encroached_.push_back(static_cast<int>(sample_.segments.size()) - 1);
    const Point p = sample_.vertices[id].point;
    for (std::size_t i = 0; i < sample_.segments.size(); ++i) {
      const CurveSegment& other = sample_.segments[i];
      if (other.vertex[0] == id || other.vertex[1] == id) continue;
      if (dot(p - sample_.vertices[other.vertex[0]].point, p - sample_.vertices[other.vertex[1]].point) < 0)
        encroached_.push_back(static_cast<int>(i));
    }
    ++result_.splits;
    return true;
  }
  Cell last_cell_used() const {
    return last_cell_ != Cell() && triangulation_.tds().cells().is_used(last_cell_) ? last_cell_ : Cell();
  }

  void extract() {
    for (Cell c : triangulation_.finite_cell_handles()) {
      if (c->info().region != 0) {
        result_.tets.push_back(
            {c->vertex(0)->info(), c->vertex(1)->info(), c->vertex(2)->info(), c->vertex(3)->info()});
        if (tet_badness(c) > 1) ++result_.bad_tets;
      }
      for (int i = 0; i < 4; ++i) {
        const Cell other = c->neighbor(i);
        if (c->info().balls[i].empty() || other->info().stamp < c->info().stamp) continue;
        if (is_off_patch(c, i)) ++result_.off_patch;
        if (is_bad_facet(c, i)) ++result_.bad_facets;
        if (c->info().region != other->info().region) {
          result_.facets.push_back(
              {{c->vertex((i + 1) % 4)->info(), c->vertex((i + 2) % 4)->info(), c->vertex((i + 3) % 4)->info()},
               c->info().balls[i].front().patch});
        }
      }
    }
    result_.vertices = sample_.vertices;
    result_.segments = sample_.segments;
  }

  const Arrangement& domain_;
  Method method_;
  RefinementBounds bounds_;
  CurveSample sample_;  ///< its vertices are all of the triangulation's
  Tr triangulation_;
  Refined result_;
  std::priority_queue<Task> tasks_[3];
  std::deque<int> encroached_;  ///< segments to look at
  std::uint64_t stamps_ = 0, orders_ = 0;
  bool running_ = false;
  bool may_push_ = false;  ///< the candidate is for a facet with a vertex off its patch
  Cell last_cell_;
};

}  // namespace scantet::bench
