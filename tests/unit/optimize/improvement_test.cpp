// What improvement promises, for meshes of several domains and bounds.
#include <gtest/gtest.h>

#include <functional>

#include "scantet/base/parallel.h"
#include "scantet/check/audit.h"
#include "scantet/optimize/improvement_impl.h"
#include "scantet/optimize/surface_guard_impl.h"
#include "scantet/quality/quality.h"
#include "unit/optimize/test_meshes.h"

namespace scantet::optimize {
namespace {

struct Improved {
  TetMesh mesh;
  std::uint64_t changes;
};

Improved improved(const TetMesh& mesh, const Domain& domain, double min_dihedral_deg) {
  TetComplex complex(mesh, TetJudge({.min_dihedral_deg = min_dihedral_deg}));
  Progress progress;
  const std::uint64_t changes = improve(complex, domain, nullptr, sharp_tets(complex), Persistence::deep, progress);
  return {complex.release(), changes};
}

void expect_same_topology(const TetMesh& before, const TetMesh& after, const Domain& domain) {
  AuditOptions options;
  options.restricted_delaunay = false;
  const AuditReport old_report = audit(before, &domain, options);
  const AuditReport report = audit(after, &domain, options);
  EXPECT_TRUE(report.passed()) << report.findings.front().message;
  EXPECT_TRUE(report.manifold());
  EXPECT_EQ(report.components.size(), old_report.components.size());
  EXPECT_EQ(report.boundary_components, old_report.boundary_components);
  EXPECT_EQ(report.cavities, old_report.cavities);
  EXPECT_EQ(report.boundary_euler, old_report.boundary_euler);
  EXPECT_EQ(report.mesh_euler, old_report.mesh_euler);
  ASSERT_TRUE(report.max_residual);
  EXPECT_LT(*report.max_residual, 1e-6);
}

class ImprovementOf : public testing::TestWithParam<double> {
 protected:
  void expect_improved(const Domain& domain, double size_mm) {
    const TetMesh before = refined(domain, size_mm);
    ASSERT_LT(measure_quality(before).min_dihedral_deg(), GetParam());
    const Improved after = improved(before, domain, GetParam());
    EXPECT_GT(after.changes, 0U);
    expect_sound(before, after.mesh, 2e-3);
    expect_same_topology(before, after.mesh, domain);
    EXPECT_GE(measure_quality(after.mesh).min_dihedral_deg(), std::min(GetParam(), kReached));
  }
  static constexpr double kReached = 20 * (1 - 1e-12);
};

TEST_P(ImprovementOf, Sphere) {
  expect_improved(*make_sphere({0, 0, 0}, 4), 0.5);
}
TEST_P(ImprovementOf, Shell) {
  expect_improved(*make_shell({0, 0, 0}, 2, 4), 0.5);
}
TEST_P(ImprovementOf, Torus) {
  expect_improved(*make_torus({1, 2, 3}, 4, 1.5), 0.4);
}
TEST_P(ImprovementOf, Tanglecube) {
  expect_improved(*make_tanglecube(), 0.2);
}
TEST_P(ImprovementOf, TwoSpheres) {
  expect_improved(*make_two_spheres(2, 0.3), 0.4);
}
TEST_P(ImprovementOf, TwoRegions) {
  expect_improved(Onion(), 0.5);
}

// Here three regions meet along curves, which the domain knows nothing of.
TEST_P(ImprovementOf, RegionsThatMeetAtTheSurface) {
  const auto torus = make_torus({0, 0, 0}, 3, 1.2);
  const TetMesh before = two_halves(refined(*torus, 0.3));
  const TetMesh after = improved(before, *torus, GetParam()).mesh;
  for (const Tet& t : after.tets) {
    const auto& v = after.vertices;
    EXPECT_EQ(orientation_sign(v[t[0]], v[t[1]], v[t[2]], v[t[3]]), 1);
  }
  const auto interface = [](const TetMesh& mesh) {
    std::vector<std::array<Point, 3>> facets;
    for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
      const Triangle& f = mesh.boundary_facets[i];
      if (mesh.facet_regions[i][1] != kOutside) {
        facets.push_back({mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]});
      }
    }
    return facets;
  };
  EXPECT_EQ(interface(after), interface(before));
  EXPECT_GE(measure_quality(after).min_dihedral_deg(), measure_quality(before).min_dihedral_deg());
}

TEST_P(ImprovementOf, SameForAnyNumberOfThreads) {
  const auto torus = make_torus({0, 0, 0}, 4, 1.5);
  const TetMesh before = refined(*torus, 0.4);
  const Improved first = improved(before, *torus, GetParam());
  for (const std::size_t threads : {1, 2, 3}) {
    with_threads(threads, [&] {
      const Improved again = improved(before, *torus, GetParam());
      EXPECT_EQ(again.changes, first.changes);
      EXPECT_EQ(again.mesh.vertices, first.mesh.vertices);
      EXPECT_EQ(again.mesh.tets, first.mesh.tets);
      EXPECT_EQ(again.mesh.boundary_facets, first.mesh.boundary_facets);
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Bounds, ImprovementOf, testing::Values(10, 20, 30));

double squared_distance_to(const Point& p, const Corners& c) {
  const Vec normal = facet_normal(c);
  bool above = true;
  double nearest = squared_distance(p, c[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Point& a = c[i];
    const Vec edge = c[(i + 1) % 3] - a;
    above &= dot(cross(edge, p - a), normal) >= 0;
    const double t = std::clamp(dot(p - a, edge) / squared_length(edge), 0.0, 1.0);
    nearest = std::min(nearest, squared_distance(p, a + t * edge));
  }
  if (!above) return nearest;
  const double height = dot(p - c[0], normal);
  return height * height / squared_length(normal);
}

/// How far the torus around the z axis and the mesh's boundary are apart, from either to the other.
struct Distances {
  double most_mm = 0;
  double mean_mm = 0;
};

Distances from_mesh(const TetMesh& mesh, const std::function<double(const Point&)>& distance_to_torus) {
  constexpr int kSteps = 6;
  Distances d;
  std::size_t count = 0;
  for (const Triangle& f : mesh.boundary_facets) {
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; i + j <= kSteps; ++j, ++count) {
        const double distance = distance_to_torus((1.0 / kSteps) * (i * mesh.vertices[f[0]] + j * mesh.vertices[f[1]] +
                                                                    (kSteps - i - j) * mesh.vertices[f[2]]));
        d.most_mm = std::max(d.most_mm, distance);
        d.mean_mm += distance;
      }
    }
  }
  d.mean_mm /= static_cast<double>(count);
  return d;
}

Distances from_torus(const TetMesh& mesh, double ring, double tube) {
  constexpr int kRound = 90;
  constexpr double kTurn = 2 * 3.14159265358979323846;
  Distances d;
  for (int i = 0; i < kRound; ++i) {
    for (int j = 0; j < kRound / 2; ++j) {
      const double u = kTurn * i / kRound;
      const double v = kTurn * j / (kRound / 2);
      const double radius = ring + tube * std::cos(v);
      const Point p{radius * std::cos(u), radius * std::sin(u), tube * std::sin(v)};
      double nearest = std::numeric_limits<double>::infinity();
      for (const Triangle& f : mesh.boundary_facets) {
        nearest =
            std::min(nearest, squared_distance_to(p, {mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]}));
      }
      d.most_mm = std::max(d.most_mm, std::sqrt(nearest));
      d.mean_mm += std::sqrt(nearest) / (kRound * (kRound / 2));
    }
  }
  return d;
}

TEST(Improvement, LeavesTheBoundaryAsNearToTheSurface) {
  constexpr double kRing = 4;
  constexpr double kTube = 1.5;
  constexpr double kMost = 1.05;
  const auto torus = make_torus({0, 0, 0}, kRing, kTube);
  const TetMesh before = refined(*torus, 0.5);
  const auto distance_to_torus = [](const Point& p) {
    return std::abs(std::hypot(std::hypot(p.x, p.y) - kRing, p.z) - kTube);
  };
  for (const double bound : {10, 20, 30}) {
    const TetMesh after = improved(before, *torus, bound).mesh;
    EXPECT_LE(from_mesh(after, distance_to_torus).most_mm, kMost * from_mesh(before, distance_to_torus).most_mm);
    EXPECT_LE(from_mesh(after, distance_to_torus).mean_mm, kMost * from_mesh(before, distance_to_torus).mean_mm);
    EXPECT_LE(from_torus(after, kRing, kTube).most_mm, kMost * from_torus(before, kRing, kTube).most_mm);
    EXPECT_LE(from_torus(after, kRing, kTube).mean_mm, kMost * from_torus(before, kRing, kTube).mean_mm);
  }
}

}  // namespace
}  // namespace scantet::optimize
