#include "scantet/places/place_items.h"

#include <gtest/gtest.h>

#include "scantet/base/error.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/field/scan_from_memory.h"

namespace scantet {
namespace {

/// A cube of n³ cells of 1 mm, six tets each; the upper half is region 2.
TetMesh make_halves(int n) {
  TetMesh mesh;
  const auto id = [n](int i, int j, int k) { return static_cast<VertexId>(i + (n + 1) * (j + (n + 1) * k)); };
  for (int k = 0; k <= n; ++k) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) mesh.vertices.push_back({double(i), double(j), double(k)});
    }
  }
  constexpr int kPaths[6][2] = {{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}};
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const auto corner = [&](int c) { return id(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1)); };
        for (const auto& path : kPaths) {
          mesh.tets.push_back({corner(0), corner(path[0]), corner(path[1]), corner(7)});
          mesh.tet_regions.push_back(k < n / 2 ? 1 : 2);
        }
      }
    }
  }
  build_boundary(mesh);
  mesh.region_names = {{2, "lid"}};
  return mesh;
}

MeshSet items(const TetMesh& mesh, const std::string& text, const ScanTable& scans = {}) {
  return items_in_place(mesh, read_named_place("--set", text), scans);
}

std::string refusal(const TetMesh& mesh, const std::string& text, const char* code) {
  try {
    items(mesh, text);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  return "none";
}

TEST(PlaceItems, ASetHoldsNodesFacetsAndElements) {
  const TetMesh mesh = make_halves(4);
  const MeshSet low = items(mesh, "low=z < 1");
  EXPECT_EQ(low.vertices.size(), 50U);
  EXPECT_EQ(low.tets.size(), 96U);
  EXPECT_EQ(low.facets.size(), 32U + 4 * 8U);
  const MeshSet nodes = items(mesh, "low=nodes: z < 1");
  EXPECT_EQ(nodes.vertices, low.vertices);
  EXPECT_TRUE(nodes.facets.empty() && nodes.tets.empty());
  EXPECT_TRUE(items(mesh, "low=elements: z < 1").vertices.empty());
}

TEST(PlaceItems, AComplementHoldsWhatIsLeft) {
  const TetMesh mesh = make_halves(4);
  for (const std::string place : {"ball(0,0,0,2.5)", "cylinder(0,0,0,0,0,4,1.5)", "box(1,1,1,3,3,3)", "x + 2y - z > 1",
                                  "region(lid)", "normal(0,0,1,10)", "nearest(7,4,4,4)"}) {
    const MeshSet in = items(mesh, "a=" + place);
    const MeshSet out = items(mesh, "a=not " + place);
    const MeshSet also_out = items(mesh, "a=all minus (" + place + ")");
    EXPECT_EQ(in.vertices.size() + out.vertices.size(), mesh.vertices.size()) << place;
    EXPECT_EQ(in.tets.size() + out.tets.size(), mesh.tets.size()) << place;
    EXPECT_EQ(in.facets.size() + out.facets.size(), mesh.boundary_facets.size()) << place;
    EXPECT_EQ(also_out.tets, out.tets) << place;
    const MeshSet both = items(mesh, "a=" + place + " or not " + place);
    EXPECT_EQ(both.vertices.size(), mesh.vertices.size()) << place;
  }
}

TEST(PlaceItems, NamesAreThoseOfTheMesh) {
  const TetMesh mesh = make_halves(4);
  EXPECT_EQ(items(mesh, "a=region(lid)").tets.size(), 192U);
  EXPECT_EQ(items(mesh, "a=label(2)").vertices.size(), 75U);
  EXPECT_EQ(items(mesh, "a=patch(boundary_1_2)").facets.size(), 32U);
  EXPECT_EQ(items(mesh, "a=patch(boundary_1_2)").vertices.size(), 25U);
  EXPECT_EQ(items(mesh, "a=curve()").vertices.size(), 16U);  // where the two halves meet outside
  EXPECT_NE(refusal(mesh, "a=region(lib)", "usage.place").find("did you mean lid?"), std::string::npos);
  EXPECT_NE(refusal(mesh, "a=patch(boundary_1_3)", "usage.place").find("did you mean"), std::string::npos);
  EXPECT_NE(refusal(mesh, "a=border(left)", "usage.place").find("--border cap"), std::string::npos);
  refusal(mesh, "a=set(b)", "usage.place");
  refusal(mesh, "a=curve(b)", "usage.place");
}

TEST(PlaceItems, NormalsPointOutOfTheRegionBehind) {
  const TetMesh mesh = make_halves(4);
  const MeshSet top = items(mesh, "a=facets: normal(0, 0, 1, 5) and z > 3.9");
  EXPECT_EQ(top.facets.size(), 32U);
  for (const std::uint32_t f : top.facets) EXPECT_EQ(mesh.facet_regions[f], (std::array<Region, 2>{2, 0}));
  EXPECT_EQ(items(mesh, "a=nodes: normal(0, 0, 1, 5) and z > 3.9").vertices.size(), 25U);
  EXPECT_EQ(items(mesh, "a=elements: normal(0, 0, 1, 5) and z > 3").tets.size(), 32U);
}

TEST(PlaceItems, SetsBeforeAreKnown) {
  TetMesh mesh = make_halves(4);
  mesh.sets.push_back(items(mesh, "low=z < 1"));
  EXPECT_EQ(items(mesh, "edge=set(low) and x < 0").vertices.size(), 10U);
}

TEST(PlaceItems, NearestGivesSoMany) {
  const TetMesh mesh = make_halves(4);
  EXPECT_EQ(items(mesh, "a=nodes: nearest(1, 4.1, 4.2, 4)").vertices, (std::vector<VertexId>{124}));
  EXPECT_EQ(items(mesh, "a=nodes: nearest(4, 0, 0, 0)").vertices.size(), 4U);
  EXPECT_EQ(items(mesh, "a=nodes: nearest(1000, 0, 0, 0)").vertices.size(), 125U);
}

TEST(PlaceItems, ScansAreTrilinear) {
  const TetMesh mesh = make_halves(4);
  std::vector<float> voxels;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) voxels.push_back(static_cast<float>(2 * i));  // x mm, 2 mm apart
    }
  }
  const Frame frame({Vec{2, 0, 0}, Vec{0, 2, 0}, Vec{0, 0, 2}}, {0, 0, 0});
  const ScanValues values(make_scan(std::vector<float>(voxels), {3, 3, 3}, frame));
  EXPECT_NEAR(values.at({1.3, 0.2, 3.9}), 1.3, 1e-12);
  EXPECT_EQ(values.at({-5, 0, 0}), 0);
  EXPECT_EQ(values.at({9, 0, 0}), 4);
  const ScanTable scans{{"x.nrrd", values}};
  EXPECT_EQ(items(mesh, "a=nodes: scan(\"x.nrrd\") > 2.5", scans).vertices, items(mesh, "a=nodes: x > 2.5").vertices);
  EXPECT_EQ(items(mesh, "a=elements: scan(\"x.nrrd\") < 2.1", scans).tets, items(mesh, "a=elements: x < 2.1").tets);
}

TEST(PlaceItems, AnEmptySetIsRefusedWithTheNearestMiss) {
  const TetMesh mesh = make_halves(4);
  const std::string ball = refusal(mesh, "a=nodes: ball(0, 0, -3, 1)", "usage.empty_set");
  EXPECT_NE(ball.find("the nearest, node 1 at (0, 0, 0), is 2 mm away"), std::string::npos) << ball;
  const std::string plane = refusal(mesh, "a=elements: z > 5", "usage.empty_set");
  EXPECT_NE(plane.find("1.25 mm away"), std::string::npos) << plane;
  const std::string normal = refusal(mesh, "a=facets: normal(1, 1, 1, 20)", "usage.empty_set");
  EXPECT_NE(normal.find("34.74 degrees away"), std::string::npos) << normal;
  const std::string names = refusal(mesh, "a=elements: region(1) and region(2)", "usage.empty_set");
  EXPECT_NE(names.find("none would be"), std::string::npos) << names;
}

}  // namespace
}  // namespace scantet
