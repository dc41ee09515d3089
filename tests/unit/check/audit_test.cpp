// Each kind of finding is provoked by one fault in a good mesh, and nothing else may be found.
#include "scantet/check/audit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <set>

#include "unit/quality/grid_mesh.h"

namespace scantet {
namespace {

using test::grid_mesh;
using test::tet_in_cube;

constexpr int kN = 4;

struct Fault {
  const char* name;
  std::set<std::string> codes;
  std::uint64_t count;  ///< of each
  std::function<TetMesh()> make;
};

std::ostream& operator<<(std::ostream& out, const Fault& fault) {
  return out << fault.name;
}

// The full grid with something done to it.
std::function<TetMesh()> changed(void (*change)(TetMesh&)) {
  return [change] {
    TetMesh mesh = grid_mesh(kN);
    change(mesh);
    return mesh;
  };
}

std::size_t inner_tet() {
  return tet_in_cube(kN, 1, 1, 1);
}

void add_tet(TetMesh& mesh, const Tet& tet) {
  mesh.tets.push_back(tet);
  mesh.tet_regions.push_back(1);
}

void remove_tet(TetMesh& mesh, std::size_t tet) {
  mesh.tets.erase(mesh.tets.begin() + static_cast<std::ptrdiff_t>(tet));
  mesh.tet_regions.erase(mesh.tet_regions.begin() + static_cast<std::ptrdiff_t>(tet));
}

TetMesh two_grids_that_touch_at_a_point() {
  TetMesh mesh = grid_mesh(1);
  const TetMesh other = mesh;
  const auto shift = static_cast<VertexId>(mesh.vertices.size());
  for (const Point& p : other.vertices) mesh.vertices.push_back(p + Vec{1, 1, 1});
  for (const Tet& t : other.tets) add_tet(mesh, {t[0] + shift, t[1] + shift, t[2] + shift, t[3] + shift});
  build_boundary(mesh);
  return mesh;
}

TetMesh two_tets_on_one_side() {
  TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.2, 0.2, 2}};
  add_tet(mesh, {0, 1, 2, 3});
  add_tet(mesh, {0, 1, 2, 4});
  build_boundary(mesh);
  return mesh;
}

TetMesh two_tets_through_each_other() {
  TetMesh mesh;
  mesh.vertices = {{0, 0, 0},      {1, 0, 0},      {0, 1, 0},      {0, 0, 1},
                   {0.2, 0.2, -1}, {0.3, 0.2, -1}, {0.2, 0.3, -1}, {0.2, 0.2, 3}};
  add_tet(mesh, {0, 1, 2, 3});
  add_tet(mesh, {4, 5, 6, 7});
  build_boundary(mesh);
  return mesh;
}

std::vector<Fault> faults_of_elements() {
  return {
      {"Arrays", {"audit.arrays"}, 2, changed([](TetMesh& m) {
         m.tet_regions.pop_back();
         m.strata.push_back({});
       })},
      {"NotFinite", {"audit.not_finite"}, 1, changed([](TetMesh& m) {
         m.vertices[3].y = std::numeric_limits<double>::quiet_NaN();
       })},
      {"BadIndex", {"audit.bad_index"}, 1, changed([](TetMesh& m) {
         m.tets[5][2] = static_cast<VertexId>(m.vertices.size());
       })},
      {"RepeatedVertex", {"audit.repeated_vertex"}, 1, changed([](TetMesh& m) { m.tets[5][2] = m.tets[5][0]; })},
      {"NegativeTet", {"audit.orientation"}, 1, changed([](TetMesh& m) {
         std::swap(m.tets[inner_tet()][1], m.tets[inner_tet()][2]);
       })},
      {"NegativeTetAtTheBoundary", {"audit.orientation"}, 1, changed([](TetMesh& m) {
         std::swap(m.tets[0][1], m.tets[0][2]);
       })},
      {"FlatTet", {"audit.orientation"}, 1, changed([](TetMesh& m) {
         m.vertices.push_back({-1, 0, 0});  // in the plane z = 0 of the bottom of the grid
         const auto facet = std::find_if(m.boundary_facets.begin(), m.boundary_facets.end(), [&](const Triangle& f) {
           return m.vertices[f[0]].z + m.vertices[f[1]].z + m.vertices[f[2]].z == 0;
         });
         add_tet(m, {(*facet)[0], (*facet)[1], (*facet)[2], static_cast<VertexId>(m.vertices.size() - 1)});
         build_boundary(m);
       })},
      {"OutsideRegion", {"audit.outside_region"}, 1, changed([](TetMesh& m) {
         m.tet_regions[inner_tet()] = kOutside;
         build_boundary(m);
       })},
      {"UnusedVertex", {"audit.unused_vertex"}, 1, changed([](TetMesh& m) {
         m.vertices.push_back({9, 9, 9});
         m.strata.push_back({});
       })},
      {"SamePoint", {"audit.same_point"}, 1, two_grids_that_touch_at_a_point},
      {"SameTet", {"audit.same_tet"}, 1, changed([](TetMesh& m) {
         const Tet t = m.tets[inner_tet()];
         add_tet(m, {t[1], t[2], t[0], t[3]});
       })},
      {"SameTetAtTheBoundary", {"audit.same_tet"}, 1, changed([](TetMesh& m) { add_tet(m, m.tets[0]); })},
      {"CrowdedFace", {"audit.crowded_face"}, 1, changed([](TetMesh& m) {
         const Tet t = m.tets[inner_tet()];
         const Point center = 0.25 * (m.vertices[t[0]] + m.vertices[t[1]] + m.vertices[t[2]] + m.vertices[t[3]]);
         m.vertices.push_back(center);
         add_tet(m, {t[0], t[1], t[2], static_cast<VertexId>(m.vertices.size() - 1)});
         build_boundary(m);
       })},
      {"FoldedFace", {"audit.folded_face"}, 1, two_tets_on_one_side},
      {"Crossing", {"audit.crossing"}, 5, two_tets_through_each_other},
  };
}

std::vector<Fault> faults_of_the_boundary() {
  return {
      {"FacetMissing", {"audit.facet_missing"}, 1, changed([](TetMesh& m) {
         m.boundary_facets.erase(m.boundary_facets.begin() + 4);
         m.facet_regions.erase(m.facet_regions.begin() + 4);
       })},
      {"FacetExtra", {"audit.facet_extra"}, 1, changed([](TetMesh& m) {
         const Tet t = m.tets[inner_tet()];
         m.boundary_facets.push_back({t[0], t[1], t[2]});
         m.facet_regions.push_back({1, kOutside});
       })},
      {"FacetOfNoVertices", {"audit.facet_extra"}, 1, changed([](TetMesh& m) {
         m.boundary_facets.push_back({0, 1, 0xffffffff});
         m.facet_regions.push_back({1, kOutside});
       })},
      {"FacetTwice", {"audit.facet_twice"}, 1, changed([](TetMesh& m) {
         m.boundary_facets.push_back(m.boundary_facets[7]);
         m.facet_regions.push_back(m.facet_regions[7]);
       })},
      {"FacetWithTheWrongRegion", {"audit.facet_regions"}, 1, changed([](TetMesh& m) {
         m.facet_regions[9] = {2, kOutside};
       })},
      {"FacetWithTheOutsideBehind", {"audit.facet_regions"}, 1, changed([](TetMesh& m) {
         m.facet_regions[9] = {kOutside, 1};
       })},
      {"FacetOrientation", {"audit.facet_orientation"}, 1, changed([](TetMesh& m) {
         std::swap(m.boundary_facets[9][0], m.boundary_facets[9][1]);
       })},
      {"BoundaryFlag", {"audit.boundary_flag"}, 1, changed([](TetMesh& m) {
         m.strata[m.boundary_facets[0][0]].dimension = 3;
       })},
      {"BoundaryEdge",
       {"audit.boundary_edge"},
       1,
       [] { return grid_mesh(2, [](int i, int j, int k) { return i == j && k == 0 ? 1 : kOutside; }); }},
      {"BoundaryEdgeOfTheOutside",
       {"audit.boundary_edge"},
       1,
       [] { return grid_mesh(2, [](int i, int j, int k) { return i == j && k == 0 ? 1 + i : kOutside; }); }},
      {"BoundaryVertex",
       {"audit.boundary_vertex"},
       1,
       [] { return grid_mesh(2, [](int i, int j, int k) { return i == j && j == k ? 1 : kOutside; }); }},
      {"HoleThatIsNotListed", {"audit.facet_missing", "audit.boundary_flag"}, 4, changed([](TetMesh& m) {
         remove_tet(m, inner_tet());
       })},
      {"RegionThatIsNotListed", {"audit.facet_missing", "audit.boundary_flag"}, 4, changed([](TetMesh& m) {
         m.tet_regions[inner_tet()] = 2;
       })},
  };
}

std::vector<Fault> faults() {
  std::vector<Fault> all = faults_of_elements();
  for (Fault& fault : faults_of_the_boundary()) all.push_back(std::move(fault));
  return all;
}

class AuditFault : public ::testing::TestWithParam<Fault> {};

TEST_P(AuditFault, IsFoundAndNothingElse) {
  const AuditReport report = audit(GetParam().make(), nullptr);
  EXPECT_FALSE(report.passed());
  std::set<std::string> found;
  for (const Finding& finding : report.findings) {
    found.insert(finding.code);
    EXPECT_EQ(finding.count, GetParam().count) << finding.message;
    EXPECT_FALSE(finding.remedy.empty());
    EXPECT_NE(finding.message.find(std::to_string(finding.count)), std::string::npos) << finding.message;
    EXPECT_TRUE(is_finite(finding.where));
  }
  EXPECT_EQ(found, GetParam().codes);
}

INSTANTIATE_TEST_SUITE_P(All, AuditFault, ::testing::ValuesIn(faults()),
                         [](const auto& fault) { return fault.param.name; });

// Those that need a domain are in audit_domain_test.cpp, audit_handles_test.cpp, or audit_regions_test.cpp, or
// broken_ways_test.cpp.
TEST(Audit, EveryKindOfFindingHasATest) {
  std::set<std::string> tested{"audit.off_boundary",   "audit.circumcentre",     "audit.component_missing",
                               "audit.cavity_missing", "audit.component_count",  "audit.cavity_count",
                               "audit.curve",          "audit.handles",          "audit.lost_part",
                               "audit.lost_label",     "audit.joined_label",     "audit.split_label",
                               "audit.broken_label",   "audit.component_joined", "audit.cavity_joined",
                               "audit.shrunk_label",   "audit.component_split"};
  for (const Fault& fault : faults()) tested.insert(fault.codes.begin(), fault.codes.end());
  std::set<std::string> kinds;
  for (const FindingKind& kind : finding_kinds()) EXPECT_TRUE(kinds.insert(kind.code).second) << kind.code;
  EXPECT_EQ(tested, kinds);
}

TEST(Audit, FullGridPasses) {
  const AuditReport report = audit(grid_mesh(kN), nullptr);
  EXPECT_TRUE(report.passed()) << (report.findings.empty() ? "" : report.findings.front().message);
  EXPECT_TRUE(report.complete);
  ASSERT_EQ(report.components.size(), 1u);
  EXPECT_EQ(report.components[0].tets, 6u * kN * kN * kN);
  EXPECT_NEAR(report.components[0].volume_mm3, kN * kN * kN, 1e-9);
  EXPECT_EQ(report.components[0].box_mm.max, (Point{kN, kN, kN}));
  EXPECT_EQ(report.components[0].surfaces, 1u);
  EXPECT_EQ(report.components[0].boundary_euler, 2);
  EXPECT_EQ(report.vertex_components, 1u);
  EXPECT_EQ(report.boundary_components, 1u);
  EXPECT_EQ(report.boundary_euler, 2);
  EXPECT_EQ(report.mesh_euler, 1);
  EXPECT_EQ(report.cavities, 0u);
  EXPECT_TRUE(report.manifold());
  EXPECT_FALSE(report.max_residual.has_value());
  EXPECT_FALSE(report.ledger.has_value());
}

TEST(Audit, EmptyMeshPassesWithNothingInIt) {
  const AuditReport report = audit({}, nullptr);
  EXPECT_TRUE(report.passed());
  EXPECT_TRUE(report.components.empty());
  EXPECT_EQ(report.mesh_euler, 0);
}

// Which faces and edges start at a vertex depends on the numbers; how many there are does not.
TEST(Audit, EulerNumbersDoNotDependOnTheNumbersOfVertices) {
  const TetMesh mesh = grid_mesh(kN);
  std::mt19937 random(11);
  std::vector<VertexId> number(mesh.vertices.size());
  std::iota(number.begin(), number.end(), VertexId{0});
  for (int round = 0; round < 5; ++round) {
    std::shuffle(number.begin(), number.end(), random);
    TetMesh renumbered = mesh;
    for (std::size_t v = 0; v < number.size(); ++v) renumbered.vertices[number[v]] = mesh.vertices[v];
    for (Tet& tet : renumbered.tets) {
      for (VertexId& v : tet) v = number[v];
    }
    build_boundary(renumbered);
    const AuditReport report = audit(renumbered, nullptr);
    EXPECT_TRUE(report.passed());
    EXPECT_EQ(report.mesh_euler, 1);
    EXPECT_EQ(report.boundary_euler, 2);
  }
}

TEST(Audit, RingHasEulerNumberZero) {
  const AuditReport report =
      audit(grid_mesh(3, [](int i, int j, int k) { return k == 1 && !(i == 1 && j == 1) ? 1 : kOutside; }), nullptr);
  EXPECT_TRUE(report.passed());
  EXPECT_EQ(report.boundary_euler, 0);
  EXPECT_EQ(report.mesh_euler, 0);
  ASSERT_EQ(report.components.size(), 1u);
  EXPECT_EQ(report.components[0].boundary_euler, 0);
}

TEST(Audit, CavityWithAnIslandInIt) {
  const AuditReport report =
      audit(grid_mesh(5,
                      [](int i, int j, int k) {
                        const int depth = std::max({std::abs(i - 2), std::abs(j - 2), std::abs(k - 2)});
                        return depth == 1 ? kOutside : 1;
                      }),
            nullptr);
  EXPECT_TRUE(report.passed());
  EXPECT_EQ(report.components.size(), 2u);
  EXPECT_EQ(report.boundary_components, 3u);
  EXPECT_EQ(report.cavities, 1u);
  EXPECT_EQ(report.boundary_euler, 6);
  EXPECT_EQ(report.components[0].surfaces, 2u);
  EXPECT_EQ(report.components[0].boundary_euler, 4);
  EXPECT_EQ(report.components[1].surfaces, 1u);
}

TEST(Audit, RegionsSideBySide) {
  const AuditReport report = audit(grid_mesh(kN, [](int i, int j, int) { return i < 2 ? 1 : j < 2 ? 3 : 2; }), nullptr);
  EXPECT_TRUE(report.passed());
  ASSERT_EQ(report.components.size(), 3u);
  EXPECT_EQ(report.boundary_components, 1u);
  EXPECT_EQ(report.cavities, 0u);
  for (const MeshComponent& component : report.components) EXPECT_EQ(component.boundary_euler, 2);
}

TEST(Audit, RegionInsideARegionIsNoCavity) {
  const AuditReport report =
      audit(grid_mesh(5, [](int i, int j, int k) { return i == 2 && j == 2 && k == 2 ? 2 : 1; }), nullptr);
  EXPECT_TRUE(report.passed());
  EXPECT_EQ(report.components.size(), 2u);
  EXPECT_EQ(report.boundary_components, 2u);
  EXPECT_EQ(report.cavities, 0u);
  EXPECT_EQ(report.components[0].surfaces, 2u);
}

TEST(Audit, PiecesThatTouchAtAVertexAreOneThroughVertices) {
  const AuditReport report =
      audit(grid_mesh(2, [](int i, int j, int k) { return i == j && j == k ? 1 : kOutside; }), nullptr);
  EXPECT_EQ(report.components.size(), 2u);
  EXPECT_EQ(report.vertex_components, 1u);
  EXPECT_EQ(report.non_manifold_vertices, 1u);
  EXPECT_EQ(report.non_manifold_edges, 0u);
  const AuditReport regions =
      audit(grid_mesh(2, [](int i, int j, int k) { return i == j && j == k ? 1 + i : kOutside; }), nullptr);
  EXPECT_EQ(regions.vertex_components, 2u);
}

// The answer is about the mesh, not about the order of its arrays.
TEST(Audit, OrderOfTetsDoesNotMatter) {
  TetMesh mesh = grid_mesh(3, [](int i, int j, int k) { return (i + j + k) % 2 == 0 ? 1 : kOutside; });
  const AuditReport before = audit(mesh, nullptr);
  std::reverse(mesh.tets.begin(), mesh.tets.end());
  std::reverse(mesh.boundary_facets.begin(), mesh.boundary_facets.end());
  const AuditReport after = audit(mesh, nullptr);
  EXPECT_GT(before.non_manifold_edges, 0u);
  EXPECT_EQ(before.non_manifold_edges, after.non_manifold_edges);
  EXPECT_EQ(before.non_manifold_vertices, after.non_manifold_vertices);
  EXPECT_EQ(before.boundary_euler, after.boundary_euler);
  EXPECT_EQ(before.components.size(), after.components.size());
  EXPECT_EQ(before.findings.size(), after.findings.size());
}

}  // namespace
}  // namespace scantet
