// Faults that a mesh may have, one by one, and of what a mesh is said to be. reason: one table, longer for its codes.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "scantet/base/mesh_topology.h"
#include "scantet/verify/verify.h"

namespace scantet {

struct Mutant {
  TetMesh mesh;
  Scan scan;
  VerifyOptions options;
};

struct Mutation {
  std::string name;
  bool is_wrong;                   ///< no grade but "not the scan" will do
  std::vector<std::string> codes;  ///< one of these is among the findings
  std::function<void(Mutant&, std::mt19937&)> apply;
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

/// Of the scene in certificate_test.cpp: 30 voxels of 1 mm a side.
inline std::vector<Mutation> mutations() {
  const Point middle{14.63, 14.39, 14.47};
  const Point island = middle + Point{6, -9, -8};
  const Point cavity = middle + Point{4, 6, 7};
  const Point ring = middle + Point{-2, 0, 0};
  return {
      {"vertex moved by 0.1 voxels",
       false,
       {"vertex.off_level"},
       [](Mutant& m, std::mt19937& r) { push_vertex(m, r, 0.1); }},
      {"vertex moved by 0.5 voxels",
       false,
       {"vertex.off_level"},
       [](Mutant& m, std::mt19937& r) { push_vertex(m, r, 0.5); }},
      {"vertex moved by 2 voxels",
       false,
       {"vertex.off_level"},
       [](Mutant& m, std::mt19937& r) { push_vertex(m, r, 2); }},
      {"tet turned",
       true,
       {"tet.not_positive"},
       [](Mutant& m, std::mt19937& r) {
         Tet& tet = m.mesh.tets[any_of(m.mesh.tets.size(), r)];
         std::swap(tet[0], tet[1]);
       }},
      {"tet removed",
       false,
       {"cavity.extra", "vertex.off_level", "facet.undecided", "boundary.edge", "boundary.vertex"},
       [](Mutant& m, std::mt19937& r) {
         const Tet gone = m.mesh.tets[any_of(m.mesh.tets.size(), r)];
         keep_tets(m.mesh, [&](const Tet& tet) { return tet != gone; });
       }},
      {"tet twice",
       true,
       {"face.shared", "face.same_side"},
       [](Mutant& m, std::mt19937& r) {
         m.mesh.tets.push_back(m.mesh.tets[any_of(m.mesh.tets.size(), r)]);
         m.mesh.tet_regions.push_back(1);
       }},
      {"two vertices swapped",
       true,
       {"tet.not_positive"},
       [](Mutant& m, std::mt19937& r) {
         const std::size_t a = any_of(m.mesh.vertices.size(), r);
         std::swap(m.mesh.vertices[a],
                   m.mesh.vertices[(a + 1 + any_of(m.mesh.vertices.size() - 1, r)) % m.mesh.vertices.size()]);
       }},
      {"island removed",
       true,
       {"component.missing"},
       [=](Mutant& m, std::mt19937&) {
         const std::vector<char> in = island_of(m.mesh, island);
         keep_tets(m.mesh, [&](const Tet& tet) { return !in[tet[0]]; });
       }},
      {"handle cut",
       true,
       {"handles.differ", "topology.counts", "boundary.edge", "boundary.vertex"},
       [=](Mutant& m, std::mt19937& r) {
         const double turn = 0.3 * static_cast<double>(r() % 20);
         const TetMesh& mesh = m.mesh;
         keep_tets(m.mesh, [&](const Tet& tet) {
           const Point p = center_of(mesh, tet) - ring;
           const double along = std::cos(turn) * p.x + std::sin(turn) * p.y;
           const double aside = std::cos(turn) * p.y - std::sin(turn) * p.x;
           return !(along > 0 && std::abs(aside) < 0.8 && length(p) < 10);
         });
       }},
      {"cavity filled", true, {"cavity.missing"}, [=](Mutant& m, std::mt19937&) { fill_from(m.mesh, cavity, 3); }},
      {"hollow made",
       false,
       {"cavity.extra", "vertex.off_level"},
       [=](Mutant& m, std::mt19937& r) {
         const Point where = center_of(m.mesh, m.mesh.tets[any_of(m.mesh.tets.size(), r)]);
         const TetMesh& mesh = m.mesh;
         keep_tets(m.mesh, [&](const Tet& tet) { return distance(center_of(mesh, tet), where) > 0.8; });
       }},
      {"regions changed",
       true,
       {"mesh.regions"},
       [](Mutant& m, std::mt19937& r) { m.mesh.tet_regions[any_of(m.mesh.tets.size(), r)] = 2; }},
      {"mesh shifted by half a voxel",
       false,
       {"vertex.off_level"},
       [](Mutant& m, std::mt19937& r) {
         Vec by;
         by[static_cast<int>(r() % 3)] = r() % 2 == 0 ? 0.5 : -0.5;
         map_vertices(m, [&](const Point& p) { return p + by; });
       }},
      {"spacing changed",
       false,
       {"vertex.off_level"},
       [](Mutant& m, std::mt19937& r) { m.scan.frame = changed_frame(m.scan, static_cast<int>(r() % 3), 1.02); }},
      {"axis reversed",
       false,
       {"facet.far", "topology.counts"},
       [](Mutant& m, std::mt19937& r) {
         const int axis = static_cast<int>(r() % 3);
         const Frame turned = changed_frame(m.scan, axis, -1);
         m.scan.frame = Frame({turned.column(0), turned.column(1), turned.column(2)},
                              turned.origin() + 29.0 * m.scan.frame.column(axis));
       }},
      {"level changed",
       false,
       {"vertex.off_level"},
       [](Mutant& m, std::mt19937& r) {
         m.options.level.level = (r() % 2 == 0 ? 1 : -1) * (0.05 + 0.1 * static_cast<double>(r() % 10));
       }},
      {"LPS taken for RAS",
       false,
       {"facet.far"},
       [](Mutant& m, std::mt19937&) { map_vertices(m, [](const Point& p) {
                                        return Point{-p.x, -p.y, p.z};
                                      }); }},
      {"mesh scaled",
       false,
       {"vertex.off_level"},
       [=](Mutant& m, std::mt19937& r) {
         const double by = 1.01 + 0.01 * static_cast<double>(r() % 10);
         map_vertices(m, [&](const Point& p) { return middle + by * (p - middle); });
       }},
      {"mesh mirrored",
       false,
       {"facet.far"},
       [=](Mutant& m, std::mt19937&) {
         map_vertices(m, [&](const Point& p) { return Point{2 * middle.x - p.x, p.y, p.z}; });
       }},
      {"other side of the level",
       true,
       {"topology.counts"},
       [](Mutant& m, std::mt19937&) { m.options.level.inside = InsideSide::below; }},
      {"island added",
       true,
       {"component.extra"},
       [](Mutant& m, std::mt19937& r) {
         const auto v = static_cast<VertexId>(m.mesh.vertices.size());
         const Point p{1 + 0.1 * static_cast<double>(r() % 10), 1, 28};
         for (const Vec& by : {Vec{0, 0, 0}, Vec{0.5, 0, 0}, Vec{0, 0.5, 0}, Vec{0, 0, 0.5}})
           m.mesh.vertices.push_back(p + by);
         m.mesh.tets.push_back({v, v + 1, v + 2, v + 3});
         m.mesh.tet_regions.push_back(1);
       }},
      {"vertices moved at random",
       false,
       {"vertex.off_level"},
       [](Mutant& m, std::mt19937& r) {
         std::uniform_real_distribution<double> any(-0.1, 0.1);
         map_vertices(m, [&](const Point& p) { return p + Vec{any(r), any(r), any(r)}; });
       }},
  };
}

}  // namespace scantet
