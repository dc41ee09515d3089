// A node lies in a cavity if the row to it crosses the cavity's wall an odd number of times. A row that meets an edge
// or a vertex of the wall is taken to pass beside it: by an infinitely small step along j, and by a far smaller one
// along k. With exact signs the facets at an edge then agree on which of them is crossed.
#include <algorithm>
#include <cmath>
#include <functional>

#include "scantet/check/mesh_cavities_impl.h"
#include "scantet/quality/orientation.h"

namespace scantet::auditing {
namespace {

int sign_of(double value) {
  return (value > 0) - (value < 0);
}

/// Which side of the line from a to b a row passes; by j and k alone.
int side_of(const Point& a, const Point& b, int j, int k) {
  const int side = orientation_sign({a.y, a.z, 0}, {b.y, b.z, 0}, {double(j), double(k), 0}, {0, 0, 1});
  if (side != 0) return side;
  return a.z != b.z ? sign_of(a.z - b.z) : sign_of(b.y - a.y);
}

/// Where the row crosses the plane of a triangle; somewhere within it if they are parallel but for rounding.
double crossing_of(const std::array<Point, 3>& p, int j, int k) {
  const Vec normal = cross(p[1] - p[0], p[2] - p[0]);
  const double i = p[0].x - (normal.y * (j - p[0].y) + normal.z * (k - p[0].z)) / normal.x;
  const auto [least, most] = std::minmax({p[0].x, p[1].x, p[2].x});
  return std::isfinite(i) ? std::clamp(i, least, most) : 0.5 * (least + most);
}

}  // namespace

MeshCavities::MeshCavities(const TetMesh& mesh, const FaceMatch& match, const OutsideSurfaces& outside,
                           const Frame& frame, const AuditReport& report) {
  for (const MeshSurface& wall : report.cavity_walls) volumes_mm3_.push_back(wall.volume_mm3);
  if (volumes_mm3_.empty()) return;
  for (std::size_t f = 0; f < match.boundary.size(); ++f) {
    const std::uint32_t surface = outside.of_face[f];
    if (surface != kNone && outside.cavity[surface] != kNone) {
      add_face(mesh, match.boundary[f].vertices, outside.cavity[surface], frame);
    }
  }
  parallel_sort(crossings_, std::less<>());
}

void MeshCavities::add_face(const TetMesh& mesh, const Triangle& face, std::uint32_t cavity, const Frame& frame) {
  std::array<Point, 3> p;
  Box box;
  for (std::size_t n = 0; n < 3; ++n) {
    p[n] = frame.to_index(mesh.vertices[face[n]]);
    box.extend(p[n]);
  }
  for (int k = static_cast<int>(std::ceil(box.min.z)); k <= box.max.z; ++k) {
    for (int j = static_cast<int>(std::ceil(box.min.y)); j <= box.max.y; ++j) {
      // The corners ascend, so that both facets at an edge ask for its side in one way.
      const int side = side_of(p[0], p[1], j, k);
      if (side == 0 || side != side_of(p[1], p[2], j, k) || side != -side_of(p[0], p[2], j, k)) continue;
      crossings_.push_back({k, j, cavity, crossing_of(p, j, k)});
    }
  }
}

std::uint32_t MeshCavities::at(int i, int j, int k) const {
  std::uint32_t innermost = kNone;
  const auto row = std::lower_bound(
      crossings_.begin(), crossings_.end(), std::pair(k, j),
      [](const Crossing& c, const std::pair<int, int>& wanted) { return std::pair(c.k, c.j) < wanted; });
  for (auto first = row; first != crossings_.end() && first->k == k && first->j == j;) {
    bool inside = false;
    auto next = first;
    for (; next != crossings_.end() && next->k == k && next->j == j && next->cavity == first->cavity; ++next) {
      if (next->i < i) inside = !inside;
    }
    const bool is_nearer = innermost == kNone || volumes_mm3_[first->cavity] < volumes_mm3_[innermost];
    if (inside && is_nearer) innermost = first->cavity;
    first = next;
  }
  return innermost;
}

}  // namespace scantet::auditing
