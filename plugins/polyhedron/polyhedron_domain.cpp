// Nearly every question is answered by the triangles in the cubes of a grid around it (triangle_grid.cpp), exactly.
// What these leave open goes to CGAL's tree over all triangles. Which triangles a segment meets, and whether it passes
// through their insides, is decided exactly there, too; where is rounded. A segment that passes through the insides of
// all it meets crosses the surface at each of them. One through an edge or a vertex, along a triangle, or with an end
// on the surface is cut into gaps by the places where it meets triangles, and region_at is asked in the middle of each:
// that needs no further cases.
#include "polyhedron_domain.h"

#include <CGAL/Polygon_mesh_processing/connected_components.h>

#include <algorithm>
#include <boost/property_map/function_property_map.hpp>

#include "shells.h"

namespace polyhedron {
namespace {

constexpr double kApart = 1e-9;    // of the segment's length
constexpr double kMargin = 0.01;   // of the surface's diagonal
constexpr double kMostMargin = 1;  // of its extent along an axis: a long spike leaves the box thin
constexpr double kLongest = 1000;  // segment that the grid is asked about, in boxes

scantet::Box tight_box(const Surface& surface) {
  scantet::Box box;
  for (const Kernel::Point_3& p : surface.points()) box.extend(from_cgal(p));
  return box;
}

scantet::Box with_margin(const scantet::Box& box) {
  const double usual = kMargin * box.diagonal();
  scantet::Vec margin;
  for (int axis = 0; axis < 3; ++axis) margin[axis] = std::min(usual, kMostMargin * box.extent()[axis]);
  return {box.min - margin, box.max + margin};
}

}  // namespace

PolyhedronDomain::PolyhedronDomain(Surface surface, SharpEdges sharp_edges)
    : surface_(std::move(surface)),
      tree_(surface_.faces().begin(), surface_.faces().end(), surface_),
      side_((tree_.build(), tree_.accelerate_distance_queries(), tree_)),
      box_(with_margin(tight_box(surface_))),
      shortest_edge_mm_([&] {
        const scantet::Vec extent = tight_box(surface_).extent();
        return std::min({extent.x, extent.y, extent.z});
      }()),
      grid_(surface_, box_, [&](const Kernel::Point_3& p) { return side_(p) == CGAL::ON_BOUNDED_SIDE; }) {
  shell_of_.resize(surface_.number_of_faces());
  auto shells = boost::make_function_property_map<Surface::Face_index>(
      [&](Surface::Face_index face) -> std::size_t& { return shell_of_[face]; });
  shell_count_ = CGAL::Polygon_mesh_processing::connected_components(surface_, shells);
  components_ = find_components(*this, surface_, shell_of_, shell_count_);
  sharp_edges_ = std::move(sharp_edges);
}

scantet::Region PolyhedronDomain::region_at(const scantet::Point& p) const {
  if (!box_.contains(p)) return scantet::kOutside;
  const std::optional<bool> inside = grid_.is_inside(p);
  if (inside) return *inside ? 1 : scantet::kOutside;
  return side_(to_cgal(p)) == CGAL::ON_BOUNDED_SIDE ? 1 : scantet::kOutside;
}

scantet::Patch PolyhedronDomain::patch_at(const scantet::Point& p) const {
  return {{scantet::kOutside, 1}, {0, shell_at(p)}};
}

scantet::ComponentId PolyhedronDomain::shell_at(const scantet::Point& p) const {
  if (shell_count_ == 1) return 0;
  const std::optional<std::size_t> near = grid_.nearest_triangle(p);
  const std::size_t face = near ? *near : std::size_t{tree_.closest_point_and_primitive(to_cgal(p)).second};
  return static_cast<scantet::ComponentId>(shell_of_[face]);
}

PolyhedronDomain::Meetings PolyhedronDomain::meetings_with(const scantet::Segment& segment) const {
  const Kernel::Point_3 p = to_cgal(segment.source);
  const Kernel::Point_3 q = to_cgal(segment.target);
  std::vector<Tree::Primitive_id> faces;
  tree_.all_intersected_primitives(Kernel::Segment_3(p, q), std::back_inserter(faces));
  Meetings meetings;
  for (const Tree::Primitive_id face : faces) {
    const auto h = surface_.halfedge(face);
    const Kernel::Point_3& a = surface_.point(surface_.source(h));
    const Kernel::Point_3& b = surface_.point(surface_.target(h));
    const Kernel::Point_3& c = surface_.point(surface_.target(surface_.next(h)));
    const auto turn = CGAL::orientation(p, q, a, b);
    meetings.all_inside = meetings.all_inside && turn != CGAL::COPLANAR && CGAL::orientation(p, q, b, c) == turn &&
                          CGAL::orientation(p, q, c, a) == turn && CGAL::orientation(a, b, c, p) != CGAL::COPLANAR &&
                          CGAL::orientation(a, b, c, q) != CGAL::COPLANAR;
    const scantet::Point corner = from_cgal(a);
    const scantet::Vec normal = cross(from_cgal(b) - corner, from_cgal(c) - corner);
    const double t = dot(corner - segment.source, normal) / dot(segment.target - segment.source, normal);
    // A segment in the plane of a triangle enters and leaves it through its neighbours, which give the places.
    if (std::isfinite(t)) meetings.places.push_back(std::clamp(t, 0.0, 1.0));
  }
  std::sort(meetings.places.begin(), meetings.places.end());
  return meetings;
}

void PolyhedronDomain::crossings(const scantet::Segment& segment, scantet::Crossings& out) const {
  out.clear();
  Meetings meetings;
  const bool short_enough =
      squared_distance(segment.source, segment.target) <= kLongest * kLongest * squared_length(box_.extent());
  if (!short_enough || !grid_.find_passages(segment, meetings.places)) meetings = meetings_with(segment);
  if (meetings.all_inside && meetings.places.empty()) return;
  scantet::Region region = region_at(segment.source);
  const auto enter = [&](scantet::Region next, double place) {
    if (next == region) return;
    const scantet::Point p = lerp(segment.source, segment.target, place);
    out.push_back({p, region, next, {0, shell_at(p)}});
    region = next;
  };
  if (meetings.all_inside) {
    for (const double place : meetings.places) enter(1 - region, place);
    return;
  }
  double begin = 0;  // of a gap
  const auto pass_gap = [&](double end) {
    if (end - begin > kApart) enter(region_at(lerp(segment.source, segment.target, 0.5 * (begin + end))), begin);
    begin = end;
  };
  for (const double place : meetings.places) pass_gap(place);
  const double last_place = begin;
  pass_gap(1);
  enter(region_at(segment.target), 1 - last_place > kApart ? 1 : last_place);
}

std::optional<double> PolyhedronDomain::residual_at(const scantet::Point& p) const {
  return std::sqrt(tree_.squared_distance(to_cgal(p))) / box_.diagonal();
}

}  // namespace polyhedron
