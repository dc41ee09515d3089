// Meshes of cut domains: caps are flat, rims sharp, volumes right.
#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <set>

#include "scantet/check/audit.h"
#include "scantet/cuts/cut_domain.h"
#include "scantet/cuts/cut_text.h"
#include "scantet/domain/analytic.h"
#include "scantet/optimize/optimizer.h"
#include "scantet/quality/quality.h"
#include "scantet/refine/mesher.h"
#include "unit/cut_balls.h"
#include "unit/sharp_cube.h"

namespace scantet {
namespace {

struct CutMesh {
  std::unique_ptr<Domain> domain;
  std::vector<CutPlane> planes;
  TetMesh mesh;
};

double min_dihedral_deg(const TetMesh& mesh) {
  double least = 180;
  for (const Tet& t : mesh.tets) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        const Point& a = mesh.vertices[t[i]];
        const Point& b = mesh.vertices[t[j]];
        std::array<Vec, 2> across;
        std::size_t n = 0;
        for (std::size_t k = 0; k < 4; ++k) {
          if (k != i && k != j) across[n++] = cross(b - a, mesh.vertices[t[k]] - a);
        }
        const double angle = std::atan2(length(cross(across[0], across[1])), dot(across[0], across[1]));
        least = std::min(least, angle * 180 / std::numbers::pi);
      }
    }
  }
  return least;
}

double volume_mm3(const TetMesh& mesh) {
  double sum = 0;
  for (const Tet& t : mesh.tets) {
    sum += orientation_mm3(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]) / 6;
  }
  return sum;
}

/// Meshes, improves and audits.
CutMesh meshed(std::unique_ptr<Domain> domain, const std::vector<std::string>& cuts, double size_mm, double alpha) {
  CutMesh made;
  for (const std::string& text : cuts) read_cut("--cut", text, made.planes);
  made.domain = make_cut_domain(std::move(domain), made.planes, 0.25, 0.25);
  MesherOptions options;
  options.bounds.alpha = alpha;
  Progress progress;
  MeshResult result = mesh_domain(*made.domain, UniformSize(size_mm), options, progress);
  EXPECT_EQ(result.stop, Stop::converged);
  optimize_mesh(result.mesh, *made.domain, {Optimize::full, {.min_dihedral_deg = 10}}, progress);
  made.mesh = std::move(result.mesh);
  AuditOptions auditing;
  auditing.restricted_delaunay = false;
  const AuditReport report = audit(made.mesh, made.domain.get(), auditing);
  for (const Finding& finding : report.findings) ADD_FAILURE() << finding.code << ": " << finding.message;
  return made;
}

/// The area of the facets of a patch of that name, all of whose vertices are in the plane.
double expect_flat(const CutMesh& made, std::size_t plane) {
  double area = 0;
  double scale = made.domain->bounds().diagonal();
  for (std::size_t i = 0; i < made.mesh.boundary_facets.size(); ++i) {
    if (made.mesh.patches[made.mesh.facet_patches[i]].name != made.planes[plane].name) continue;
    const auto& [a, b, c] = made.mesh.boundary_facets[i];
    for (const VertexId v : {a, b, c}) {
      EXPECT_LE(std::abs(made.planes[plane].beyond_mm(made.mesh.vertices[v])), 1e-9 * scale);
    }
    area += 0.5 *
            length(cross(made.mesh.vertices[b] - made.mesh.vertices[a], made.mesh.vertices[c] - made.mesh.vertices[a]));
  }
  return area;
}

/// No edge between a cap and another facet that is not one of a sharp curve.
void expect_sharp_rims(const TetMesh& mesh) {
  std::map<std::array<VertexId, 2>, std::set<std::uint32_t>> patches_at;
  for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(mesh.boundary_facets[i][k], mesh.boundary_facets[i][(k + 1) % 3]);
      patches_at[{a, b}].insert(mesh.facet_patches[i]);
    }
  }
  std::set<std::array<VertexId, 2>> curve_edges;
  for (const auto& edge : mesh.curve_edges) {
    const auto [a, b] = std::minmax(edge[0], edge[1]);
    curve_edges.insert({a, b});
  }
  for (const auto& [edge, patches] : patches_at) {
    EXPECT_TRUE(patches.size() == 1 || curve_edges.count(edge) == 1);
  }
}

TEST(CutMesh, ABallCutOffCentre) {
  const double pi = std::numbers::pi;
  const CutMesh made = meshed(make_sphere({1, 2, 3}, 10), {"clamp: x < 5"}, 1, 0.3);
  const double cap_mm = 6;  // of height
  const double exact = 4.0 / 3 * pi * 1000 - pi * cap_mm * cap_mm * (30 - cap_mm) / 3;
  EXPECT_NEAR(volume_mm3(made.mesh), exact, 1e-3 * exact);
  EXPECT_NEAR(expect_flat(made, 0), pi * 84, 0.01 * pi * 84);
  EXPECT_GE(min_dihedral_deg(made.mesh), 10);
  expect_sharp_rims(made.mesh);
  ASSERT_EQ(made.mesh.curves.size(), 1U);
  EXPECT_TRUE(made.mesh.curves[0].is_sharp);
  ASSERT_EQ(made.mesh.patches.size(), 2U);
  EXPECT_EQ(made.mesh.patches[0].name, "");
  EXPECT_EQ(made.mesh.patches[1].name, "clamp");
}

TEST(CutMesh, ABallCutByTwoTiltedPlanesThatMeetInIt) {
  const CutMesh made = meshed(make_sphere({}, 10), {"x + 2y - 2z < 6", "2x - y + 2z < 3"}, 1.5, 0.5);
  EXPECT_GT(expect_flat(made, 0), 0);
  EXPECT_GT(expect_flat(made, 1), 0);
  EXPECT_GE(min_dihedral_deg(made.mesh), 10);
  expect_sharp_rims(made.mesh);
  EXPECT_EQ(made.mesh.corners.size(), 2U);
}

TEST(CutMesh, ABoxOutOfABallHasItsVolume) {
  const CutMesh made = meshed(make_sphere({}, 10), {"-3 < x < 3", "-2 < y + 0.2x < 2", "z > -1", "z < 5"}, 1, 1);
  EXPECT_NEAR(volume_mm3(made.mesh), 6 * 4 * 6, 1e-9 * 144);
  EXPECT_EQ(made.mesh.corners.size(), 8U);
  EXPECT_EQ(made.mesh.patches.size(), 6U);
  EXPECT_GE(min_dihedral_deg(made.mesh), 10);
}

TEST(CutMesh, SharpEdgesAndRegionsGoOnToTheCap) {
  const CutMesh cube = meshed(std::make_unique<test::SharpCube>(10), {"x + y + z < 3"}, 1.5, 1);
  EXPECT_EQ(cube.mesh.corners.size(), 10U);
  expect_sharp_rims(cube.mesh);
  const CutMesh wedges = meshed(std::make_unique<test::CutBall>(10, 3), {"end: z + 0.1x < 4"}, 1.5, 1);
  expect_sharp_rims(wedges.mesh);
  std::set<std::string> names;
  for (const MeshPatch& patch : wedges.mesh.patches) names.insert(patch.name);
  EXPECT_EQ(names, (std::set<std::string>{"", "end_region_1", "end_region_2", "end_region_3"}));
}

}  // namespace
}  // namespace scantet
