// Checks of single tets and vertices.
#include <algorithm>
#include <numeric>

#include "scantet/base/options.h"
#include "scantet/check/audit_impl.h"
#include "scantet/quality/orientation.h"

namespace scantet::auditing {
namespace {

std::string text(const Point& p) {
  std::string text = number_text(p.x);
  for (const double coordinate : {p.y, p.z}) text += ", " + number_text(coordinate);
  return text;
}

void check_length(const char* array, std::size_t length, std::size_t expected, Tally& tally) {
  if (length == expected) return;
  tally.hit({}, [&] {
    return std::string(array) + " with " + std::to_string(length) + " entries instead of " + std::to_string(expected);
  });
}

bool uses_twice(const Tet& t) {
  return t[0] == t[1] || t[0] == t[2] || t[0] == t[3] || t[1] == t[2] || t[1] == t[3] || t[2] == t[3];
}

void check_points(const TetMesh& mesh, AuditReport& report) {
  std::vector<VertexId> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), VertexId{0});
  std::sort(order.begin(), order.end(), [&](VertexId a, VertexId b) {
    if (mesh.vertices[a] == mesh.vertices[b]) return a < b;
    return lexicographically_less(mesh.vertices[a], mesh.vertices[b]);
  });
  Tally same{"audit.same_point"};
  for (std::size_t i = 1; i < order.size(); ++i) {
    const Point& p = mesh.vertices[order[i]];
    if (!(p == mesh.vertices[order[i - 1]])) continue;
    same.hit(p, [&] { return named("vertex", order[i]) + " at the place of vertex " + std::to_string(order[i - 1]); });
  }
  record(same, report);
}

}  // namespace

Point centroid(const TetMesh& mesh, std::uint32_t tet) {
  const Tet& t = mesh.tets[tet];
  return 0.25 * (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]] + mesh.vertices[t[3]]);
}

Point centroid(const TetMesh& mesh, const Triangle& triangle) {
  return (1.0 / 3) * (mesh.vertices[triangle[0]] + mesh.vertices[triangle[1]] + mesh.vertices[triangle[2]]);
}

bool check_arrays(const TetMesh& mesh, AuditReport& report) {
  Tally arrays{"audit.arrays"};
  check_length("tet_regions", mesh.tet_regions.size(), mesh.tets.size(), arrays);
  check_length("facet_regions", mesh.facet_regions.size(), mesh.boundary_facets.size(), arrays);
  check_length("strata", mesh.strata.size(), mesh.vertices.size(), arrays);
  record(arrays, report);

  Tally not_finite{"audit.not_finite"};
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (is_finite(mesh.vertices[v])) continue;
    not_finite.hit({}, [&] { return named("vertex", v) + " at " + text(mesh.vertices[v]); });
  }
  record(not_finite, report);

  Tally bad_index{"audit.bad_index"};
  Tally repeated{"audit.repeated_vertex"};
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const Tet& t = mesh.tets[i];
    const VertexId largest = std::max({t[0], t[1], t[2], t[3]});
    if (largest >= mesh.vertices.size()) {
      bad_index.hit({}, [&] { return named("tet", i) + " with vertex " + std::to_string(largest); });
    } else if (uses_twice(t)) {
      repeated.hit(centroid(mesh, static_cast<std::uint32_t>(i)), [&] { return named("tet", i); });
    }
  }
  record(bad_index, report);
  record(repeated, report);
  return report.findings.empty();
}

std::uint64_t check_elements(const TetMesh& mesh, AuditReport& report) {
  Tally orientation{"audit.orientation"};
  Tally outside{"audit.outside_region"};
  std::vector<std::uint8_t> used(mesh.vertices.size(), 0);
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const Tet& t = mesh.tets[i];
    for (const VertexId v : t) used[v] = 1;
    const auto place = [&] { return centroid(mesh, static_cast<std::uint32_t>(i)); };
    const int sign =
        orientation_sign(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]);
    if (sign <= 0) {
      orientation.hit(place(), [&] { return named("tet", i) + (sign < 0 ? " (negative)" : " (flat)"); });
    }
    if (mesh.tet_regions[i] == kOutside) outside.hit(place(), [&] { return named("tet", i); });
  }
  record(orientation, report);
  record(outside, report);

  Tally unused{"audit.unused_vertex"};
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v] == 0) unused.hit(mesh.vertices[v], [&] { return named("vertex", v); });
  }
  record(unused, report);
  check_points(mesh, report);
  return used.size() - unused.count;
}

}  // namespace scantet::auditing
