// A triangle is kept with every cube that it may meet: one that its box meets and that lies neither beyond its plane
// nor beyond an edge. A cube without triangles is clear. The centre of each cube follows from that of a cube before it:
// what is between the two is in their two lists. A point near the surface is then inside as the centre of its cube is,
// or not, by the triangles of that one cube between them.
#include "triangle_grid.h"

#include <algorithm>
#include <cmath>

namespace polyhedron {
namespace {

using scantet::CubeGrid;
using scantet::CubeState;
using scantet::Vec;

/// What a segment does at a triangle.
enum class Meeting { none, passes, open };

Meeting meeting(const Kernel::Point_3& p, const Kernel::Point_3& q, const TriangleGrid::Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const auto before = CGAL::orientation(a, b, c, p);
  const auto after = CGAL::orientation(a, b, c, q);
  if (before == after && before != CGAL::COPLANAR) return Meeting::none;
  if (before == CGAL::COPLANAR || after == CGAL::COPLANAR) {
    const bool meets = CGAL::do_intersect(Kernel::Segment_3(p, q), Kernel::Triangle_3(a, b, c));
    return meets ? Meeting::open : Meeting::none;
  }
  const auto turn = CGAL::orientation(p, q, a, b);
  const auto next = CGAL::orientation(p, q, b, c);
  if (turn * next < 0) return Meeting::none;
  const auto last = CGAL::orientation(p, q, c, a);
  if (turn * last < 0 || next * last < 0) return Meeting::none;
  return turn == next && next == last ? Meeting::passes : Meeting::open;
}

/// Tells cubes that a triangle cannot meet.
class TriangleShadow {
 public:
  TriangleShadow(const TriangleGrid::Triangle& triangle, double edge_mm) {
    const std::array<scantet::Point, 3> p{from_cgal(triangle[0]), from_cgal(triangle[1]), from_cgal(triangle[2])};
    scantet::Box box;
    for (const scantet::Point& corner : p) box.extend(corner);
    const double size = box.diagonal();
    // More than rounding can come to in a normal, times a distance; normals of thin triangles are mostly rounding.
    const double doubt = 1e-13 * size * size * (size + edge_mm);
    const Vec normal = cross(p[1] - p[0], p[2] - p[0]);
    add(normal, p[0], edge_mm, doubt);
    add(-1 * normal, p[0], edge_mm, doubt);
    for (std::size_t i = 0; i < 3; ++i) add(cross(p[(i + 1) % 3] - p[i], normal), p[i], edge_mm, size * doubt);
  }
  bool misses(const scantet::Point& center) const {
    return std::any_of(planes_.begin(), planes_.end(),
                       [&](const Plane& plane) { return dot(plane.normal, center - plane.point) > plane.reach; });
  }

 private:
  struct Plane {
    Vec normal;
    scantet::Point point;
    double reach;  // how far a cube's centre may be beyond it, times the normal's length
  };
  void add(const Vec& normal, const scantet::Point& point, double edge_mm, double doubt) {
    const double half = (0.5 + 2 * CubeGrid::kSlack) * edge_mm;
    planes_[count_++] = {normal, point, half * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z)) + doubt};
  }

  std::array<Plane, 5> planes_;
  std::size_t count_ = 0;
};

/// As many cubes along the box as give a few triangles to each of them that the surface meets.
int cubes_along(std::size_t triangles) {
  constexpr double kFewest = 32;
  constexpr double kMost = 160;  // 4 million cubes at most: 25 MB
  return static_cast<int>(std::clamp(1.5 * std::sqrt(static_cast<double>(triangles)), kFewest, kMost));
}

}  // namespace

TriangleGrid::TriangleGrid(const Surface& surface, const scantet::Box& box, const InsideTest& is_inside) {
  triangles_.reserve(surface.number_of_faces());
  for (const Surface::Face_index face : surface.faces()) {
    const auto h = surface.halfedge(face);
    triangles_.push_back({surface.point(surface.source(h)), surface.point(surface.target(h)),
                          surface.point(surface.target(surface.next(h)))});
  }
  const CubeGrid cubes(box, cubes_along(triangles_.size()));
  sort_into_cubes(cubes);
  clear_ = scantet::ClearanceGrid(cubes, settle_centers(cubes, is_inside));
}

void TriangleGrid::sort_into_cubes(const CubeGrid& cubes) {
  struct Entry {
    std::uint32_t cube;
    std::uint32_t triangle;
  };
  std::vector<Entry> entries;
  first_.assign(cubes.size() + 1, 0);
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    const TriangleShadow shadow(triangles_[t], cubes.edge_mm);
    scantet::Box box;
    for (const Kernel::Point_3& p : triangles_[t]) box.extend(from_cgal(p));
    const auto [low, high] = cubes.range(box);
    for (int z = low[2]; z <= high[2]; ++z) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int x = low[0]; x <= high[0]; ++x) {
          if (shadow.misses(cubes.center({x, y, z}))) continue;
          entries.push_back({static_cast<std::uint32_t>(cubes.index({x, y, z})), t});
          ++first_[entries.back().cube + 1];
        }
      }
    }
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  in_cubes_.resize(entries.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const Entry& entry : entries) in_cubes_[next[entry.cube]++] = entry.triangle;
}

std::vector<CubeState> TriangleGrid::settle_centers(const CubeGrid& cubes, const InsideTest& is_inside) {
  std::vector<CubeState> states(cubes.size());
  center_inside_.resize(cubes.size());
  std::array<int, 3> cube;
  for (cube[2] = 0; cube[2] < cubes.counts[2]; ++cube[2]) {
    for (cube[1] = 0; cube[1] < cubes.counts[1]; ++cube[1]) {
      for (cube[0] = 0; cube[0] < cubes.counts[0]; ++cube[0]) {
        const std::size_t here = cubes.index(cube);
        const Kernel::Point_3 center = to_cgal(cubes.center(cube));
        std::optional<bool> inside;
        for (std::size_t axis = 0; axis < 3 && !inside; ++axis) {
          std::array<int, 3> before = cube;
          if (--before[axis] < 0) continue;
          const std::size_t there = cubes.index(before);
          const std::optional<bool> changes = changes_side(to_cgal(cubes.center(before)), center, there, here);
          if (changes) inside = *changes != (center_inside_[there] != 0);
        }
        if (!inside) inside = is_inside(center);
        center_inside_[here] = *inside ? 1 : 0;
        if (first_[here] == first_[here + 1]) states[here] = *inside ? CubeState::inside : CubeState::outside;
      }
    }
  }
  return states;
}

std::optional<bool> TriangleGrid::changes_side(const Kernel::Point_3& p, const Kernel::Point_3& q, std::size_t a,
                                               std::size_t b) const {
  bool changes = false;
  const auto begin_of = [&](std::size_t cube) { return in_cubes_.begin() + first_[cube]; };
  for (const std::size_t cube : {a, b}) {
    for (auto t = begin_of(cube); t != begin_of(cube + 1); ++t) {
      const Meeting met = meeting(p, q, triangles_[*t]);
      if (met == Meeting::open) return std::nullopt;
      if (met == Meeting::none) continue;
      const bool counted = cube != a && std::binary_search(begin_of(a), begin_of(a + 1), *t);
      changes = changes != !counted;
    }
    if (a == b) break;
  }
  return changes;
}

std::optional<bool> TriangleGrid::is_inside(const scantet::Point& p) const {
  const auto [state, cube] = clear_.at(p);
  if (state != CubeState::near) return state == CubeState::inside;
  const std::size_t index = clear_.grid().index(cube);
  const auto changes = changes_side(to_cgal(p), to_cgal(clear_.grid().center(cube)), index, index);
  if (!changes) return std::nullopt;
  return *changes != (center_inside_[index] != 0);
}

std::optional<std::size_t> TriangleGrid::nearest_triangle(const scantet::Point& p) const {
  const auto [state, cube] = clear_.at(p);
  if (state != CubeState::near) return std::nullopt;
  const std::size_t index = clear_.grid().index(cube);
  std::optional<std::size_t> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = first_[index]; i < first_[index + 1]; ++i) {
    const auto& [a, b, c] = triangles_[in_cubes_[i]];
    const double squared = CGAL::squared_distance(to_cgal(p), Kernel::Triangle_3(a, b, c));
    if (squared >= least) continue;
    least = squared;
    nearest = in_cubes_[i];
  }
  return nearest;
}

bool TriangleGrid::find_passages(const scantet::Segment& segment, std::vector<double>& places) const {
  places.clear();
  const Kernel::Point_3 p = to_cgal(segment.source);
  const Kernel::Point_3 q = to_cgal(segment.target);
  std::vector<std::uint32_t> passed;
  bool settled = true;
  clear_.walk(segment, [&](std::size_t cube, double, double) {
    for (std::size_t i = first_[cube]; i < first_[cube + 1]; ++i) {
      const Meeting met = meeting(p, q, triangles_[in_cubes_[i]]);
      settled = settled && met != Meeting::open;
      if (met == Meeting::passes) passed.push_back(in_cubes_[i]);
    }
  });
  if (!settled) return false;
  std::sort(passed.begin(), passed.end());
  passed.erase(std::unique(passed.begin(), passed.end()), passed.end());
  for (const std::uint32_t t : passed) {
    const scantet::Point corner = from_cgal(triangles_[t][0]);
    const Vec normal = cross(from_cgal(triangles_[t][1]) - corner, from_cgal(triangles_[t][2]) - corner);
    const double place = dot(corner - segment.source, normal) / dot(segment.target - segment.source, normal);
    if (!std::isfinite(place)) return false;
    places.push_back(std::clamp(place, 0.0, 1.0));
  }
  std::sort(places.begin(), places.end());
  return true;
}

}  // namespace polyhedron
