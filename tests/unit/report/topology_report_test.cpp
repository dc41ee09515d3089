// What reports say of surfaces, handles and cavities.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "boundary_flags.h"
#include "unit/quality/grid_mesh.h"
#include "unit/report/report_test_support.h"

namespace scantet {
namespace {

using Json = nlohmann::ordered_json;

// A ring of cubes, and a cube with a hole in its middle.
TEST(TopologyReport, HandlesAndCavitiesAreToldWithTheirPlaces) {
  const TetMesh mesh = test::grid_mesh(7, [](int i, int j, int k) -> Region {
    if (i < 3 && j < 3) return k == 0 && (i != 1 || j != 1) ? 1 : kOutside;
    if (i < 4 || j < 4 || k < 4) return kOutside;
    return i == 5 && j == 5 && k == 5 ? kOutside : 1;
  });
  const Report report = plain_report(mesh, "a.vtu");
  const Json topology = Json::parse(json_report(report))["topology"];
  EXPECT_EQ(topology["handles"], 1);
  ASSERT_EQ(topology["surface_list"].size(), 3u);
  std::vector<int> handles;
  for (const Json& s : topology["surface_list"]) handles.push_back(s["handles"].get<int>());
  EXPECT_EQ(handles, (std::vector<int>{1, 0, 0}));
  EXPECT_EQ(topology["surface_list"][1]["component"], 1);
  EXPECT_NEAR(topology["surface_list"][1]["volume_mm3"].get<double>(), 27, 1e-9);
  EXPECT_NEAR(topology["surface_list"][2]["volume_mm3"].get<double>(), -1, 1e-9) << "the component is around it";
  ASSERT_EQ(topology["cavity_list"].size(), 1u);
  EXPECT_NEAR(topology["cavity_list"][0]["volume_mm3"].get<double>(), 1, 1e-9);
  EXPECT_EQ(topology["cavity_list"][0]["box_mm"], Json::parse(R"({"min": [5.0, 5.0, 5.0], "max": [6.0, 6.0, 6.0]})"));
  EXPECT_NE(text_report(report, {200, true}).find("Euler number 4 (1 handle), manifold"), std::string::npos);
  Report pinched = report;
  pinched.audit->non_manifold_vertices = 1;
  EXPECT_TRUE(Json::parse(json_report(pinched))["topology"]["handles"].is_null());
}

TEST(TopologyReport, BoundaryVerticesAreThoseOfBoundaryFacets) {
  TetMesh mesh = make_cube(3);
  const std::vector<std::uint8_t> flags = test::boundary_flags(mesh);
  const auto inside = static_cast<std::size_t>(std::find(flags.begin(), flags.end(), 0) - flags.begin());
  ASSERT_LT(inside, flags.size());
  mesh.strata[inside].dimension = 2;  // on the level, but no corner of a facet
  const Report report = plain_report(mesh, "a.vtu");
  EXPECT_EQ(report.mesh->boundary_vertices, 56u);
  EXPECT_EQ(report.mesh->boundary_vertices, report.audit->boundary_vertices);
}

}  // namespace
}  // namespace scantet
