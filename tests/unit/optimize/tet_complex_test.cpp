#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "scantet/base/parallel.h"
#include "scantet/optimize/tet_complex_impl.h"
#include "unit/optimize/test_meshes.h"

namespace scantet::optimize {
namespace {

TetMesh torus_of_two_halves() {
  return two_halves(refined(*make_torus({1, 2, 3}, 5, 2), 1));
}

Tet with_replaced(Tet tet, VertexId from, VertexId to) {
  std::replace(tet.begin(), tet.end(), from, to);
  return tet;
}

bool positive(const TetComplex& complex, const Tet& t) {
  return orientation_sign(complex.point(t[0]), complex.point(t[1]), complex.point(t[2]), complex.point(t[3])) > 0;
}

/// Replaces the two tets at a face by the three at the edge through it. Returns false if that cannot be.
bool flip_face(TetComplex& complex, TetId t, int k) {
  const TetId other = complex.across(t, k);
  if (other == kNoTet || complex.region(other) != complex.region(t)) return false;
  const Tet tet = complex.tet(t);
  const Tet beyond = complex.tet(other);
  const VertexId apex = *std::find_if(beyond.begin(), beyond.end(), [&](VertexId v) { return !has_vertex(tet, v); });
  std::vector<NewTet> added;
  for (const VertexId v : tet) {
    if (v != tet[static_cast<std::size_t>(k)]) added.push_back({with_replaced(tet, v, apex), complex.region(t)});
    if (!added.empty() && !positive(complex, added.back().vertex)) return false;
  }
  const std::array<TetId, 2> removed{t, other};
  complex.replace(removed, added);
  return true;
}

/// Replaces the tets at the edge between corners i and j of t by two, if they are three of one region.
bool flip_edge(TetComplex& complex, TetId t, std::size_t i, std::size_t j) {
  const VertexId a = complex.tet(t)[i];
  const VertexId b = complex.tet(t)[j];
  std::vector<TetId> removed;
  for (const TetId s : complex.star(a)) {
    if (has_vertex(complex.tet(s), b)) removed.push_back(s);
    if (!removed.empty() && complex.region(removed.back()) != complex.region(t)) return false;
  }
  if (removed.size() != 3) return false;
  std::vector<VertexId> others;  // than those of t
  for (const TetId s : removed) {
    for (const VertexId v : complex.tet(s)) {
      if (!has_vertex(complex.tet(t), v)) others.push_back(v);
    }
  }
  if (others.size() != 2 || others[0] != others[1]) return false;  // at the boundary the ring is open
  const VertexId third = others[0];
  const std::array<NewTet, 2> added{NewTet{with_replaced(complex.tet(t), a, third), complex.region(t)},
                                    NewTet{with_replaced(complex.tet(t), b, third), complex.region(t)}};
  if (!positive(complex, added[0].vertex) || !positive(complex, added[1].vertex)) return false;
  complex.replace(removed, added);
  return true;
}

/// Every vertex number stands for the position that it had.
void expect_same_boundary(const TetMesh& mesh) {
  TetMesh expected = mesh;
  build_boundary(expected);
  EXPECT_EQ(mesh.boundary_facets, expected.boundary_facets);
  EXPECT_EQ(mesh.facet_regions, expected.facet_regions);
}

void expect_stars(const TetComplex& complex) {
  std::vector<std::vector<TetId>> stars(complex.vertex_slots());
  for (TetId t = 0; t < complex.tet_slots(); ++t) {
    if (!complex.is_tet(t)) continue;
    for (const VertexId v : complex.tet(t)) stars[v].push_back(t);
  }
  for (VertexId v = 0; v < complex.vertex_slots(); ++v) {
    std::vector<TetId> star(complex.star(v).begin(), complex.star(v).end());
    std::sort(star.begin(), star.end());
    ASSERT_EQ(star, stars[v]) << "vertex " << v;
  }
}

TEST(TetComplex, GivesBackWhatItWasGiven) {
  const TetMesh mesh = torus_of_two_halves();
  TetComplex complex(mesh);
  expect_stars(complex);
  const TetMesh same = complex.release();
  EXPECT_EQ(same.vertices, mesh.vertices);
  EXPECT_EQ(same.tets, mesh.tets);
  EXPECT_EQ(same.tet_regions, mesh.tet_regions);
  EXPECT_EQ(same.boundary_facets, mesh.boundary_facets);
  EXPECT_EQ(same.facet_regions, mesh.facet_regions);
  EXPECT_EQ(same.strata, mesh.strata);
  EXPECT_EQ(complex.tet_slots(), 0U);
  EXPECT_EQ(complex.vertex_slots(), 0U);
}

TEST(TetComplex, AcrossFindsTheNeighbours) {
  const TetMesh mesh = torus_of_two_halves();
  const TetComplex complex(mesh);
  std::size_t boundary_faces = 0;
  for (TetId t = 0; t < complex.tet_slots(); ++t) {
    for (int k = 0; k < 4; ++k) {
      const TetId other = complex.across(t, k);
      boundary_faces += complex.is_boundary_face(t, k) ? (other == kNoTet ? 2 : 1) : 0;
      if (other == kNoTet) continue;
      int back = 0;
      for (int j = 0; j < 4; ++j) back += complex.across(other, j) == t ? 1 : 0;
      EXPECT_EQ(back, 1);
    }
  }
  EXPECT_EQ(boundary_faces, 2 * mesh.boundary_facets.size());
}

TEST(TetComplex, RandomFlipsKeepStarsAndBoundary) {
  const TetMesh mesh = torus_of_two_halves();
  TetComplex complex(mesh);
  std::mt19937 random(1);
  int face_flips = 0;
  int edge_flips = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto t = static_cast<TetId>(random() % complex.tet_slots());
    if (!complex.is_tet(t)) continue;
    face_flips += flip_face(complex, t, static_cast<int>(random() % 4)) ? 1 : 0;
    const std::size_t corner = random() % 4;
    if (complex.is_tet(t)) edge_flips += flip_edge(complex, t, corner, (corner + 1 + random() % 3) % 4) ? 1 : 0;
  }
  EXPECT_GT(face_flips, 1000);
  EXPECT_GT(edge_flips, 1000);
  expect_stars(complex);
  const TetMesh flipped = complex.release();
  EXPECT_EQ(flipped.tets.size(), mesh.tets.size() + static_cast<std::size_t>(face_flips - edge_flips));
  EXPECT_EQ(flipped.boundary_facets, mesh.boundary_facets);
  EXPECT_EQ(flipped.facet_regions, mesh.facet_regions);
  expect_same_boundary(flipped);
}

TEST(TetComplex, BoundaryFollowsTetsThatGoAndChangeSides) {
  const TetMesh mesh = torus_of_two_halves();
  TetComplex complex(mesh);
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const auto t = static_cast<TetId>(random() % complex.tet_slots());
    const Tet& tet = mesh.tets[t];
    if (!complex.is_tet(t) ||
        !std::all_of(tet.begin(), tet.end(), [&](VertexId v) { return complex.on_boundary(v); })) {
      continue;
    }
    std::vector<NewTet> added;
    if (i % 2 == 0) added.push_back({tet, 3 - mesh.tet_regions[t]});
    complex.replace(std::array{t}, added);
  }
  const TetMesh changed = complex.release();
  EXPECT_LT(changed.tets.size(), mesh.tets.size());
  EXPECT_NE(changed.boundary_facets, mesh.boundary_facets);
  expect_same_boundary(changed);
}

TEST(TetComplex, DropsVerticesWithoutTetsAndKeepsTheOrder) {
  const TetMesh mesh = torus_of_two_halves();
  const auto inner = static_cast<VertexId>(
      std::find_if(mesh.strata.begin(), mesh.strata.end(), [](const Stratum& s) { return !s.on_boundary(); }) -
      mesh.strata.begin());
  TetComplex complex(mesh);
  const VertexId added = complex.add_vertex(complex.point(inner), false);
  const std::vector<TetId> star(complex.star(inner).begin(), complex.star(inner).end());
  std::vector<NewTet> tets;
  for (const TetId t : star) tets.push_back({with_replaced(complex.tet(t), inner, added), complex.region(t)});
  complex.replace(star, tets);
  expect_stars(complex);

  const TetMesh renumbered = complex.release();
  std::vector<Point> vertices = mesh.vertices;
  vertices.erase(vertices.begin() + inner);
  vertices.push_back(mesh.vertices[inner]);
  EXPECT_EQ(renumbered.vertices, vertices);
  EXPECT_EQ(renumbered.tets.size(), mesh.tets.size());
  EXPECT_FALSE(renumbered.on_boundary(static_cast<VertexId>(renumbered.vertices.size() - 1)));
  expect_same_boundary(renumbered);
}

TEST(TetComplex, DoesNotDependOnTheNumberOfThreads) {
  const TetMesh mesh = torus_of_two_halves();
  std::vector<std::vector<TetId>> stars;
  for (const std::size_t threads : {1, 2, 3}) {
    with_threads(threads, [&] {
      const TetComplex complex(mesh);
      std::vector<TetId> all;
      for (VertexId v = 0; v < complex.vertex_slots(); ++v) {
        all.insert(all.end(), complex.star(v).begin(), complex.star(v).end());
      }
      stars.push_back(all);
    });
  }
  EXPECT_EQ(stars[0], stars[1]);
  EXPECT_EQ(stars[0], stars[2]);
}

}  // namespace
}  // namespace scantet::optimize
