// A mesh with what it is said to be of, and ways to spoil it.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "scantet/base/mesh_topology.h"
#include "scantet/verify/verify.h"

namespace scantet {

struct Mutant {
  TetMesh mesh;
  Scan scan;
  VerifyOptions options;
};

inline std::size_t any_of(std::size_t count, std::mt19937& random) {
  return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

inline void keep_tets(TetMesh& mesh, const std::function<bool(const Tet&)>& keep) {
  std::vector<Tet> kept;
  for (const Tet& tet : mesh.tets) {
    if (keep(tet)) kept.push_back(tet);
  }
  mesh.tets = kept;
  mesh.tet_regions.assign(kept.size(), 1);
}

inline Point center_of(const TetMesh& mesh, const Tet& tet) {
  return 0.25 * ((mesh.vertices[tet[0]] + mesh.vertices[tet[1]]) + (mesh.vertices[tet[2]] + mesh.vertices[tet[3]]));
}

/// Moves a boundary vertex along the normal of one of its facets.
inline void push_vertex(Mutant& m, std::mt19937& random, double by) {
  build_boundary(m.mesh);
  const Triangle& t = m.mesh.boundary_facets[any_of(m.mesh.boundary_facets.size(), random)];
  const Vec n = cross(m.mesh.vertices[t[1]] - m.mesh.vertices[t[0]], m.mesh.vertices[t[2]] - m.mesh.vertices[t[0]]);
  m.mesh.vertices[t[0]] = m.mesh.vertices[t[0]] + ((random() % 2 == 0 ? by : -by) / length(n)) * n;
}

inline void map_vertices(Mutant& m, const std::function<Point(const Point&)>& to) {
  for (Point& p : m.mesh.vertices) p = to(p);
}

/// Tets joined through vertices to the one that is nearest to a corner of the image.
inline std::vector<char> island_of(const TetMesh& mesh, const Point& near) {
  std::size_t first = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (distance(center_of(mesh, mesh.tets[t]), near) < distance(center_of(mesh, mesh.tets[first]), near)) first = t;
  }
  std::vector<char> in(mesh.vertices.size());
  in[mesh.tets[first][0]] = 1;
  for (bool grows = true; grows;) {
    grows = false;
    for (const Tet& tet : mesh.tets) {
      const auto count = in[tet[0]] + in[tet[1]] + in[tet[2]] + in[tet[3]];
      if (count == 0 || count == 4) continue;
      for (const VertexId v : tet) in[v] = 1;
      grows = true;
    }
  }
  return in;
}

/// A cone over all facets of the boundary that are within `radius` of a place: it fills what they enclose.
inline void fill_from(TetMesh& mesh, const Point& apex, double radius) {
  build_boundary(mesh);
  const auto tip = static_cast<VertexId>(mesh.vertices.size());
  mesh.vertices.push_back(apex);
  for (const Triangle& t : mesh.boundary_facets) {
    if (distance(mesh.vertices[t[0]], apex) < radius) mesh.tets.push_back({tip, t[0], t[1], t[2]});
  }
  mesh.tet_regions.assign(mesh.tets.size(), 1);
}

inline Frame changed_frame(const Scan& scan, int axis, double factor) {
  std::array<Vec, 3> columns{scan.frame.column(0), scan.frame.column(1), scan.frame.column(2)};
  columns[static_cast<std::size_t>(axis)] = factor * columns[static_cast<std::size_t>(axis)];
  return Frame(columns, scan.frame.origin());
}

}  // namespace scantet
