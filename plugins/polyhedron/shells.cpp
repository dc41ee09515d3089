// A point just within a shell is half way from the middle of one of its triangles to the next crossing inwards. The
// shells that enclose it are those that a line from there to infinity crosses an odd number of times.
#include "shells.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>

#include "triangle_grid.h"

namespace polyhedron {
namespace {

using scantet::Point;
using scantet::Vec;

using Triangle = std::array<Point, 3>;

struct Shell {
  std::vector<Triangle> triangles;
  scantet::Box box;
  double signed_volume_mm3 = 0;           // greater than 0 if the triangles face outwards
  std::int64_t euler = 0;                 // vertices less edges plus faces
  Point within;                           // between it and the shells in it
  std::set<scantet::ComponentId> around;  // the shells around that point, itself among them
};

Vec normal_of(const Triangle& t) {
  return cross(t[1] - t[0], t[2] - t[0]);
}

std::vector<Shell> split(const Surface& surface, const std::vector<std::size_t>& shell_of, std::size_t count) {
  std::vector<Shell> shells(count);
  for (const Surface::Face_index face : surface.faces()) {
    Shell& shell = shells[shell_of[face]];
    auto h = surface.halfedge(face);
    Triangle triangle;
    for (Point& corner : triangle) {
      corner = from_cgal(surface.point(surface.source(h)));
      shell.box.extend(corner);
      h = surface.next(h);
    }
    shell.triangles.push_back(triangle);
    ++shell.euler;
  }
  for (const Surface::Edge_index edge : surface.edges()) {
    --shells[shell_of[surface.face(surface.halfedge(edge))]].euler;
  }
  for (const Surface::Vertex_index vertex : surface.vertices()) {
    if (surface.is_isolated(vertex)) continue;
    ++shells[shell_of[surface.face(surface.halfedge(vertex))]].euler;
  }
  for (Shell& shell : shells) {
    const Point apex = shell.box.center();
    for (const Triangle& t : shell.triangles) shell.signed_volume_mm3 += dot(normal_of(t), t[0] - apex) / 6;
  }
  return shells;
}

/// The shells that a line from p to infinity crosses an odd number of times.
std::set<scantet::ComponentId> shells_around(const scantet::Domain& domain, const Point& p) {
  const double length = 2 * domain.bounds().diagonal();
  scantet::Crossings crossings;
  domain.crossings({p, p + length * Vec{0.48, 0.6, 0.64}}, crossings);
  std::set<scantet::ComponentId> odd;
  for (const scantet::Crossing& crossing : crossings) {
    const scantet::ComponentId id = crossing.components[1];
    if (!odd.insert(id).second) odd.erase(id);
  }
  return odd;
}

/// Fills `within` and `around`, from the triangle given; false if it is too thin there.
bool look_within(const scantet::Domain& domain, const Triangle& t, scantet::ComponentId id, Shell& shell) {
  constexpr double kNear = 1e-9;  // of the box: the triangle itself
  const double diagonal = domain.bounds().diagonal();
  const Point middle = (1.0 / 3) * (t[0] + t[1] + t[2]);
  const Vec normal = normal_of(t);
  const Vec inwards = ((shell.signed_volume_mm3 > 0 ? -1 : 1) / length(normal)) * normal;
  scantet::Crossings crossings;
  domain.crossings({middle, middle + diagonal * inwards}, crossings);
  const auto next = std::find_if(crossings.begin(), crossings.end(),
                                 [&](const auto& c) { return distance(c.point, middle) > kNear * diagonal; });
  if (next == crossings.end()) return false;
  shell.within = lerp(middle, next->point, 0.5);
  shell.around = shells_around(domain, shell.within);
  const bool odd = shell.around.size() % 2 == 1;
  return shell.around.count(id) == 1 && odd == (domain.region_at(shell.within) != scantet::kOutside);
}

bool look_within(const scantet::Domain& domain, scantet::ComponentId id, Shell& shell) {
  constexpr std::size_t kTries = 20;
  const auto tried = shell.triangles.begin() + static_cast<std::ptrdiff_t>(std::min(kTries, shell.triangles.size()));
  std::partial_sort(shell.triangles.begin(), tried, shell.triangles.end(), [](const Triangle& a, const Triangle& b) {
    return squared_length(normal_of(a)) > squared_length(normal_of(b));
  });
  return std::any_of(shell.triangles.begin(), tried,
                     [&](const Triangle& t) { return look_within(domain, t, id, shell); });
}

}  // namespace

std::vector<scantet::Component> find_components(const scantet::Domain& domain, const Surface& surface,
                                                const std::vector<std::size_t>& shell_of, std::size_t shells) {
  std::vector<Shell> all = split(surface, shell_of, shells);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!look_within(domain, static_cast<scantet::ComponentId>(i), all[i])) return {};
  }
  std::vector<scantet::Component> components(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Shell& shell = all[i];
    components[i].region = shell.around.size() % 2 == 1 ? 1 : scantet::kOutside;
    components[i].witness = shell.within;
    components[i].box_mm = shell.box;
    components[i].volume_mm3 += std::abs(shell.signed_volume_mm3);
    components[i].euler = components[i].euler.value_or(0) + shell.euler;
    components[i].surfaces = components[i].surfaces.value_or(0) + 1;
    for (const scantet::ComponentId parent : shell.around) {
      if (all[parent].around.size() + 1 != shell.around.size()) continue;
      components[parent].volume_mm3 -= std::abs(shell.signed_volume_mm3);
      components[parent].euler = components[parent].euler.value_or(0) + shell.euler;
      components[parent].surfaces = components[parent].surfaces.value_or(0) + 1;
    }
  }
  return components;
}

}  // namespace polyhedron
