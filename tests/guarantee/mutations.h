// Faults that a mesh may have, one by one, and of what a mesh is said to be. reason: one table, longer for its codes.
#pragma once

#include <string>

#include "mutant.h"

namespace scantet {

struct Mutation {
  std::string name;
  bool is_wrong;                   ///< no grade but "not the scan" will do
  std::vector<std::string> codes;  ///< one of these is among the findings
  std::function<void(Mutant&, std::mt19937&)> apply;
};

/// The middle of the scene in certificate_test.cpp: 30 voxels of 1 mm a side.
inline constexpr Point kMiddle{14.63, 14.39, 14.47};

/// One vertex or one tet is not as it was.
inline std::vector<Mutation> single_mutations() {
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
  };
}

/// A part of the mesh is not as it was.
inline std::vector<Mutation> part_mutations() {
  const Point island = kMiddle + Point{6, -9, -8};
  const Point cavity = kMiddle + Point{4, 6, 7};
  const Point ring = kMiddle + Point{-2, 0, 0};
  return {
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
  };
}

/// All of the mesh is elsewhere, or what it is said to be of; or there is more of it.
inline std::vector<Mutation> other_mutations() {
  return {
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
         map_vertices(m, [&](const Point& p) { return kMiddle + by * (p - kMiddle); });
       }},
      {"mesh mirrored",
       false,
       {"facet.far"},
       [=](Mutant& m, std::mt19937&) {
         map_vertices(m, [&](const Point& p) { return Point{2 * kMiddle.x - p.x, p.y, p.z}; });
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

/// All of them.
inline std::vector<Mutation> mutations() {
  std::vector<Mutation> all = single_mutations();
  for (const auto& more : {part_mutations(), other_mutations()}) all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace scantet
