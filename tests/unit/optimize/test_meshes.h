// Domains and meshes that the tests of this module share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "scantet/base/mesh_topology.h"
#include "scantet/domain/analytic.h"
#include "scantet/optimize/tet_complex_impl.h"
#include "scantet/quality/orientation.h"
#include "scantet/quality/quality.h"
#include "scantet/refine/mesher.h"

namespace scantet {

inline TetMesh refined(const Domain& domain, double size_mm) {
  Progress progress;
  return mesh_domain(domain, UniformSize(size_mm), {}, progress).mesh;
}

/// The tets that break a bound of the complex's judge.
inline std::vector<optimize::TetId> sharp_tets(const optimize::TetComplex& complex) {
  std::vector<optimize::TetId> sharp;
  for (optimize::TetId t = 0; t < complex.tet_slots(); ++t) {
    if (complex.sharpness(complex.tet(t)) > complex.judge().bound()) sharp.push_back(t);
  }
  return sharp;
}

/// What every improvement promises: no tet inverted, the facets those of the tets, no smaller smallest angle, and each
/// region's volume the same up to `volume_share` of it.
inline void expect_sound(const TetMesh& before, const TetMesh& after, double volume_share) {
  for (const Tet& t : after.tets) {
    const auto& v = after.vertices;
    EXPECT_EQ(orientation_sign(v[t[0]], v[t[1]], v[t[2]], v[t[3]]), 1);
  }
  TetMesh again = after;
  build_boundary(again);
  EXPECT_EQ(again.boundary_facets, after.boundary_facets);
  EXPECT_EQ(again.facet_regions, after.facet_regions);
  const QualitySummary old_quality = measure_quality(before);
  const QualitySummary quality = measure_quality(after);
  EXPECT_GE(quality.min_dihedral_deg(), old_quality.min_dihedral_deg());
  ASSERT_EQ(quality.regions.size(), old_quality.regions.size());
  for (std::size_t i = 0; i < quality.regions.size(); ++i) {
    const double volume_mm3 = old_quality.regions[i].volume_mm3;
    EXPECT_NEAR(quality.regions[i].volume_mm3, volume_mm3, volume_share * volume_mm3);
  }
}

/// The torus with the half of it where x < y as a region of its own: the mesh's, not the domain's.
inline TetMesh two_halves(TetMesh mesh) {
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    Point sum;
    for (const VertexId v : mesh.tets[t]) sum = sum + mesh.vertices[v];
    mesh.tet_regions[t] = sum.x < sum.y ? 1 : 2;
  }
  build_boundary(mesh);
  return mesh;
}

/// A ball of region 2 inside of a ball of region 1, both around the origin.
class Onion final : public Domain {
 public:
  static constexpr double kInner = 2;
  static constexpr double kOuter = 4;

  Box bounds() const override {
    constexpr double kHalf = kOuter + 0.5;
    return {{-kHalf, -kHalf, -kHalf}, {kHalf, kHalf, kHalf}};
  }
  Region region_at(const Point& p) const override { return length(p) < kInner ? 2 : length(p) < kOuter ? 1 : kOutside; }
  void crossings(const Segment& s, Crossings& out) const override {
    out.clear();
    std::vector<double> at;
    const Vec d = s.target - s.source;
    for (const double radius : {kInner, kOuter}) {
      const double half_b = dot(s.source, d) / squared_length(d);
      const double c = (squared_length(s.source) - radius * radius) / squared_length(d);
      const double root = std::sqrt(std::max(0.0, half_b * half_b - c));
      for (const double t : {-half_b - root, -half_b + root}) {
        if (half_b * half_b > c && t > 0 && t < 1) at.push_back(t);
      }
    }
    std::sort(at.begin(), at.end());
    at.push_back(1);
    Region from = region_at(s.source);
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
      const Region to = region_at(lerp(s.source, s.target, 0.5 * (at[i] + at[i + 1])));
      if (to != from) out.push_back({lerp(s.source, s.target, at[i]), from, to});
      from = to;
    }
  }
  std::optional<double> residual_at(const Point& p) const override {
    return std::min(std::abs(length(p) - kInner), std::abs(length(p) - kOuter)) / kOuter;
  }
};

/// An octahedron whose four vertices near z = 0 make a sliver; joined to the two others by two tets above and two
/// below.
inline TetMesh octahedron_with_sliver(Region of_sliver) {
  constexpr double kHalfHeight = 0.01;
  TetMesh mesh;
  mesh.vertices = {{1, 0, kHalfHeight},   {0, 1, -kHalfHeight}, {-1, 0, kHalfHeight},
                   {0, -1, -kHalfHeight}, {0, 0, 1.2},          {0, 0, -1.2}};
  mesh.tets = {{0, 1, 2, 3}, {4, 0, 1, 2}, {4, 0, 2, 3}, {5, 0, 1, 3}, {5, 1, 2, 3}};
  mesh.tet_regions = {of_sliver, 1, 1, 1, 1};
  for (Tet& t : mesh.tets) {
    const auto& v = mesh.vertices;
    if (orientation_sign(v[t[0]], v[t[1]], v[t[2]], v[t[3]]) < 0) std::swap(t[2], t[3]);
  }
  build_boundary(mesh);
  return mesh;
}

}  // namespace scantet
