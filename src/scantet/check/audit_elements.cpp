// Checks of single tets and vertices.
#include <algorithm>
#include <atomic>
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

// Points are sorted; equal ones are neighbours then.
void check_points(const TetMesh& mesh, AuditReport& report) {
  std::vector<VertexId> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), VertexId{0});
  parallel_sort(order, [&](VertexId a, VertexId b) {
    if (mesh.vertices[a] == mesh.vertices[b]) return a < b;
    return lexicographically_less(mesh.vertices[a], mesh.vertices[b]);
  });
  const auto same = [&](std::size_t begin, std::size_t end, Tally& tally) {
    for (std::size_t i = std::max<std::size_t>(begin, 1); i < end; ++i) {
      const Point& p = mesh.vertices[order[i]];
      if (!(p == mesh.vertices[order[i - 1]])) continue;
      tally.hit(p,
                [&] { return named("vertex", order[i]) + " at the place of vertex " + std::to_string(order[i - 1]); });
    }
  };
  record(parallel_tally("audit.same_point", order.size(), same), report);
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

  const auto not_finite = [&](std::size_t begin, std::size_t end, Tally& tally) {
    for (std::size_t v = begin; v < end; ++v) {
      if (is_finite(mesh.vertices[v])) continue;
      tally.hit({}, [&] { return named("vertex", v) + " at " + text(mesh.vertices[v]); });
    }
  };
  record(parallel_tally("audit.not_finite", mesh.vertices.size(), not_finite), report);

  const auto exists = [&](const Tet& t) { return std::max({t[0], t[1], t[2], t[3]}) < mesh.vertices.size(); };
  const auto bad_index = [&](std::size_t begin, std::size_t end, Tally& tally) {
    for (std::size_t i = begin; i < end; ++i) {
      const Tet& t = mesh.tets[i];
      if (exists(t)) continue;
      const VertexId largest = std::max({t[0], t[1], t[2], t[3]});
      tally.hit({}, [&] { return named("tet", i) + " with vertex " + std::to_string(largest); });
    }
  };
  const auto repeated = [&](std::size_t begin, std::size_t end, Tally& tally) {
    for (std::size_t i = begin; i < end; ++i) {
      const Tet& t = mesh.tets[i];
      if (!exists(t) || !uses_twice(t)) continue;
      tally.hit(centroid(mesh, static_cast<std::uint32_t>(i)), [&] { return named("tet", i); });
    }
  };
  record(parallel_tally("audit.bad_index", mesh.tets.size(), bad_index), report);
  record(parallel_tally("audit.repeated_vertex", mesh.tets.size(), repeated), report);
  return report.findings.empty();
}

ElementCounts check_elements(const TetMesh& mesh, AuditReport& report) {
  std::vector<std::uint8_t> used(mesh.vertices.size(), 0);
  const auto look_at = [&](std::size_t begin, std::size_t end, Tally& tally) {
    for (std::size_t i = begin; i < end; ++i) {
      const Tet& t = mesh.tets[i];
      for (const VertexId v : t) std::atomic_ref<std::uint8_t>(used[v]).store(1, std::memory_order_relaxed);
      const int sign =
          orientation_sign(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]);
      if (sign > 0) continue;
      tally.hit(centroid(mesh, static_cast<std::uint32_t>(i)),
                [&] { return named("tet", i) + (sign < 0 ? " (negative)" : " (flat)"); });
    }
  };
  const Tally orientation = parallel_tally("audit.orientation", mesh.tets.size(), look_at);
  record(orientation, report);
  const auto outside = [&](std::size_t begin, std::size_t end, Tally& tally) {
    for (std::size_t i = begin; i < end; ++i) {
      if (mesh.tet_regions[i] != kOutside) continue;
      tally.hit(centroid(mesh, static_cast<std::uint32_t>(i)), [&] { return named("tet", i); });
    }
  };
  record(parallel_tally("audit.outside_region", mesh.tets.size(), outside), report);

  Tally unused{"audit.unused_vertex"};
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v] == 0) unused.hit(mesh.vertices[v], [&] { return named("vertex", v); });
  }
  record(unused, report);
  check_points(mesh, report);
  return {used.size() - unused.count, orientation.count == 0};
}

}  // namespace scantet::auditing
