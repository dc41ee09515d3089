// Surfaces that are refused, and segments through edges, vertices and along faces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "cancelled_after.h"
#include "contract/plugin_case.h"
#include "guarantee/surface_distance.h"
#include "scantet/base/error.h"
#include "scantet/check/audit.h"
#include "scantet/refine/mesher.h"
#include "surface_files.h"
#include "temporary_file.h"

namespace scantet {
namespace {

using Options = std::vector<std::pair<std::string, std::string>>;
const Options kRepair{{"repair", "true"}};

std::unique_ptr<Domain> open_surface(const std::string& name, const std::string& text, const Options& options = {}) {
  const test::TemporaryFile file(name, text);
  return open_with_plugin(SCANTET_POLYHEDRON_PLUGIN, file.path(), options);
}

void expect_refused(const std::string& name, const std::string& text, const std::string& says,
                    const Options& options = {}) {
  try {
    open_surface(name, text, options);
    ADD_FAILURE() << name << " was opened";
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_EQ(error.code(), "input.surface") << what;
    EXPECT_EQ(error.fault(), Fault::input);
    EXPECT_NE(what.find(name), std::string::npos) << what;
    EXPECT_NE(what.find(says), std::string::npos) << what;
  }
}

Facets open_cube() {
  Facets facets = cube(1);
  facets.polygons.pop_back();
  return facets;
}

Facets overlapping_cubes() {
  Facets facets = cube(1);
  facets.add_cube({0.5, 0.25, 0.125}, 1);
  return facets;
}

/// A fine cube with one vertex of the side z = 1 pulled out of the opposite side.
Facets pierced_cube() {
  Facets facets;
  facets.add_fine_cube({0, 0, 0}, 1, 8);
  for (auto& p : facets.points) {
    if (p[0] == 0.25 && p[1] == 0.25 && p[2] == 1) p[2] = -1.5;
  }
  return facets;
}

TEST(PolyhedronPlugin, RefusesWhatEnclosesNothing) {
  expect_refused("open.off", open_cube().off(), "4 edges have a facet on one side only");
  expect_refused("open.stl", open_cube().stl(), "not closed");
  expect_refused("overlapping.off", overlapping_cubes().off(), "meets itself");
  expect_refused("pierced.off", pierced_cube().off(), "--repair");
  Facets scrap = cube(1);
  scrap.points.insert(scrap.points.end(), {{3, 0, 0}, {4, 0, 0}, {3, 1, 0}});
  scrap.polygons.push_back({8, 9, 10});
  expect_refused("scrap.off", scrap.off(), "3 edges");
}

TEST(PolyhedronPlugin, RefusesWhatIsNoSurface) {
  for (const Options& options : {Options{}, kRepair}) {
    expect_refused("empty.off", Facets{}.off(), "no facet", options);
    expect_refused("rubbish.off", "OFF\nthree points", "", options);
    expect_refused("rubbish.stl", "solid\nfacet", "", options);
    const std::string whole = cubes().off();
    expect_refused("truncated.off", whole.substr(0, whole.size() / 2), "", options);
    const std::string ply = cubes().ply();
    expect_refused("truncated.ply", ply.substr(0, 3 * ply.size() / 4), "", options);
    for (const char* type : {"int32", "list uchar float"}) {  // CGAL's reader would crash
      std::string odd = ply;
      const std::size_t at = odd.find(" z\n");
      const std::size_t before = odd.rfind("property ", at) + 9;
      odd.replace(before, at - before, type);
      expect_refused("odd.ply", odd, "property z of its vertices", options);
    }
    Facets dangling = cube(1);
    dangling.polygons[0][0] = 99;
    expect_refused("dangling.off", dangling.off(), "", options);
    std::string nan = cube(1).off();
    nan.replace(nan.find("-1.000000"), 9, "nan      ");
    expect_refused("nan.off", nan, "", options);
    for (const double scale : {1e300, 1e-300}) {
      std::string text = "OFF\n8 6 0\n";
      const Facets unit = cube(1);
      std::ostringstream numbers;
      for (const auto& p : unit.points) numbers << scale * p[0] << " " << scale * p[1] << " " << scale * p[2] << "\n";
      const std::string facets = unit.off();
      text += numbers.str() + facets.substr(facets.find("\n4 ") + 1);
      expect_refused("scale.off", text, "scale it", options);
    }
    Facets far;
    far.add_cube({1e15, 0, 0}, 1);
    expect_refused("far.off", far.off(), "move it", options);
    std::string count = cube(1).off();
    count.replace(count.find("8 6 0"), 5, "999999999 6 0");
    expect_refused("count.off", count, "", options);
    Facets flat;
    flat.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    flat.polygons = {{0, 1, 2}};
    expect_refused("flat.off", flat.off(), options.empty() ? "not closed" : "encloses", options);
  }
}

TEST(PolyhedronPlugin, FacetsOfVerticesThatAreNotThereAreNamed) {
  const std::string good = cube(1).obj();  // 8 vertices, 6 facets
  for (const std::string vertex : {"0", "9", "-9", "99999999999", "x", "/3", "1.5"}) {
    expect_refused("index.obj", good + "f 1 2 " + vertex + "\n", "line 15: a facet names vertex " + vertex);
    expect_refused("first.obj", "f 1 2 " + vertex + "\n" + good, "line 1: a facet names vertex " + vertex);
  }
  Facets facets = cube(1);
  facets.polygons.push_back({0, 1, 8});
  expect_refused("index.ply", facets.ply(), "facet 7 names vertex 8");
  facets.polygons.back()[2] = -1;
  expect_refused("negative.ply", facets.ply(), "facet 7 names vertex -1");
  expect_refused("negative.off", facets.off(), "");
}

TEST(PolyhedronPlugin, CornersAreReadHoweverTheyAreWritten) {
  std::string text = "vt 0 0\nvn 0 0 1\n";
  const Facets facets = cube(1);
  for (const auto& p : facets.points) {
    text += "v " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
  }
  const std::array<std::string, 6> ends{"", "/1", "//1", "/1/1", "/", " "};
  for (std::size_t n = 0; n < ends.size(); ++n) {
    text += "f";
    for (const int vertex : facets.polygons[n])
      text += "\t" + std::to_string(n % 2 == 0 ? vertex + 1 : vertex - 8) + ends[n];
    text += n == 0 ? " # the first\r\n" : "\n";
  }
  EXPECT_EQ(open_surface("corners.obj", text)->components().size(), 1u);
}

TEST(PolyhedronPlugin, RepairClosesAndParts) {
  const auto lid = open_surface("open.off", open_cube().off(), kRepair);
  EXPECT_EQ(lid->region_at({0, 0, 0}), 1);
  EXPECT_EQ(lid->components().size(), 1u);
  EXPECT_NEAR(lid->components()[0].volume_mm3, 8, 1e-12) << "the hole of a cube's side is filled flat";
  Facets scrap = cubes();
  scrap.points.push_back({30, 0, 0});
  scrap.points.push_back({31, 0, 0});
  scrap.points.push_back({30, 1, 0});
  const int last = static_cast<int>(scrap.points.size()) - 1;
  scrap.polygons.push_back({last - 2, last - 1, last});
  EXPECT_EQ(open_surface("scrap.off", scrap.off(), kRepair)->components().size(), 3u);
  const auto parted = open_surface("pierced.off", pierced_cube().off(), kRepair);
  EXPECT_EQ(parted->region_at({-0.5, -0.5, 0}), 1);
  EXPECT_EQ(parted->region_at({0.25, 0.25, -1.2}), kOutside) << "the spike is gone";
}

TEST(PolyhedronPlugin, WhatEndsTheReaderIsRefused) {
  std::string crowded = cube(2).off();
  crowded.replace(crowded.rfind("\n", crowded.size() - 2) + 1, 1, "2147483647");
  expect_refused("crowded.off", crowded, "cannot be read as a surface");
  const std::string denormal =
      "OFF\n8 12 0\n0 0 0\n8 0 0\n0 8 0\n8 8 0\n0 0 -1e-308\n8 0 8\n0 8 8\n8 8 8\n3 0 2 3\n3 0 3 1\n3 4 5 7\n3 4 7 6\n"
      "3 0 1 5\n3 0 5 4\n3 2 6 7\n3 2 7 3\n3 0 4 6\n3 0 6 2\n3 1 3 7\n3 1 7 5\n";
  expect_refused("denormal.off", denormal, "in a process of its own, crashes", kRepair);
}

TEST(PolyhedronPlugin, OpeningCanBeCancelled) {
  const test::TemporaryFile file("cancelled.off", cubes().off());
  PluginRegistry registry;
  load_plugin(SCANTET_POLYHEDRON_PLUGIN, registry);
  test::CancelledAfter progress(0);
  const auto plugin = registry.create_for(file.path());
  EXPECT_EQ(plugin->open(file.path(), progress).domain, nullptr);
  EXPECT_TRUE(plugin->info(file.path(), progress).empty());
}

TEST(PolyhedronPlugin, RepairChangesNothingThatIsGood) {
  const auto plain = open_surface("good.off", cubes().off());
  const auto repaired = open_surface("good.off", cubes().off(), kRepair);
  Crossings expected;
  Crossings found;
  const Segment line{{-3, 0.3, 0.2}, {9, 0.4, 0.1}};
  plain->crossings(line, expected);
  repaired->crossings(line, found);
  ASSERT_EQ(found.size(), 6u);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_TRUE(found[i].point == expected[i].point);
}

TEST(PolyhedronPlugin, SafeRepairIsDone) {
  Facets facets = cube(1);
  std::reverse(facets.polygons[2].begin(), facets.polygons[2].end());
  facets.polygons.push_back(facets.polygons[0]);
  const auto domain = open_surface("turned.obj", facets.obj());
  EXPECT_EQ(domain->region_at({0, 0, 0}), 1);
  EXPECT_EQ(domain->region_at({1.01, 0, 0}), kOutside);
}

// A cube within the cavity of another, and one beside them: two levels of nesting.
TEST(PolyhedronPlugin, ComponentsAndCavitiesFollowFromNesting) {
  Facets facets = cubes();
  facets.add_cube({0.1, 0.1, 0}, 0.5);
  const auto domain = open_surface("nested.off", facets.off());
  std::vector<double> volumes[2];
  for (const Component& component : domain->components()) {
    volumes[component.region == kOutside ? 0 : 1].push_back(component.volume_mm3);
    EXPECT_EQ(domain->region_at(component.witness), component.region);
    EXPECT_TRUE(component.box_mm.contains(component.witness));
    const bool between = component.region == kOutside || std::abs(component.volume_mm3 - 56) < 1;
    EXPECT_EQ(component.surfaces, between ? 2u : 1u);
    EXPECT_EQ(component.euler, between ? 4 : 2);
    EXPECT_EQ(component.handles(), 0);
  }
  ASSERT_EQ(volumes[0].size(), 1u);
  EXPECT_NEAR(volumes[0][0], 8 - 1, 1e-12);
  std::sort(volumes[1].begin(), volumes[1].end());
  ASSERT_EQ(volumes[1].size(), 3u);
  EXPECT_NEAR(volumes[1][0], 1, 1e-12);
  EXPECT_NEAR(volumes[1][1], 27, 1e-12);
  EXPECT_NEAR(volumes[1][2], 64 - 8, 1e-12);
  const Patch outer = domain->patch_at({-2, 0.3, 0.4});
  EXPECT_EQ(outer, domain->patch_at({0.3, 2, 0.4}));
  EXPECT_NE(outer, domain->patch_at({1.1, 0.3, 0.4}));
  EXPECT_NE(outer, domain->patch_at({7.5, 1, 0}));
}

// A torus, and a cube with a cavity in its hole. The mesh has the same pieces and the same Euler
// number.
TEST(PolyhedronPlugin, TheMeshHasTheTopologyOfTheSurface) {
  Facets ring;
  ring.add_ring(3, 1);
  ring.add_cube({0, 0, 0}, 1);
  ring.add_cube({0, 0, 0}, 0.4);
  const auto domain = open_surface("ring.off", ring.off());
  Progress progress;
  const double size_mm = 0.35;
  const MeshResult result = mesh_domain(*domain, UniformSize(size_mm), {}, progress);
  const AuditReport report = audit(result.mesh, domain.get());
  for (const Finding& finding : report.findings) ADD_FAILURE() << finding.message;
  EXPECT_TRUE(report.manifold());
  EXPECT_EQ(report.components.size(), 2u);
  EXPECT_EQ(report.cavities, 1u);
  EXPECT_EQ(report.boundary_euler, 0 + 2 + 2);
  const SurfaceDistance apart = surface_distance(result.mesh, *domain, size_mm, 2 * size_mm);
  EXPECT_LT(apart.from_mesh_mm, size_mm);
  EXPECT_LT(apart.from_domain_mm, size_mm);
}

// The grid's answers and those of all triangles are the same: a segment so long that the grid is not asked is met where
// its parts are.
TEST(PolyhedronPlugin, LongSegmentsAgreeWithTheirParts) {
  const auto domain = open_surface("parts.off", cubes().off());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  Crossings whole;
  Crossings part;
  for (int i = 0; i < 300; ++i) {
    const Point through{3 + 5 * unit(random), 2 * unit(random), 2 * unit(random)};
    const Vec direction{unit(random), unit(random), unit(random)};
    domain->crossings({through - 1e5 * direction, through + 1e5 * direction}, whole);
    std::size_t met = 0;
    for (int k = -40; k < 40; ++k) {
      domain->crossings({through + 0.5 * k * direction, through + 0.5 * (k + 1) * direction}, part);
      met += part.size();
    }
    if (length(direction) > 0.6) {
      EXPECT_EQ(met, whole.size()) << "segment " << i;
    }
  }
}

struct Hard {
  Segment segment;
  std::size_t crossings;
};

TEST(PolyhedronPlugin, HardSegmentsAreAnswered) {
  const auto domain = open_surface("hard.off", cubes().off());
  Crossings crossings;
  for (const Hard& hard : std::vector<Hard>{
           {{{-3, -3, -3}, {-1.5, -1.5, -1.5}}, 1},  // in through a vertex
           {{{-3, 0.5, -3}, {-1.5, 0.5, -1.5}}, 1},  // in through an edge
           {{{-3, 0, 0}, {3, 0, 0}}, 4},             // through the edges that cut the squares, and the cavity
           {{{-3, -2, 0}, {3, -2, 0}}, 0},           // along a face, which is outside
           {{{-3, -2, -2}, {3, -2, -2}}, 0},         // along an edge
           {{{-2, 0, 0}, {-1.5, 0, 0}}, 1},          // from a face inwards
           {{{-2, 0, 0}, {-3, 0, 0}}, 0},            // from a face outwards
           {{{-1.5, 0.3, 0.2}, {-1.5, 0.4, 0.1}}, 0},
           {{{-1.5, 0, 0}, {-2, 0, 0}}, 1},  // from inside onto a face
           {{{-3, 1, 1}, {3, 1, 1}}, 4},     // along an edge of the cavity, which is outside
           {{{-100, 0.3, 0.2}, {100, 0.3, 0.2}}, 6},
       }) {
    domain->crossings(hard.segment, crossings);
    const Point& p = hard.segment.source;
    const Point& q = hard.segment.target;
    Region region = domain->region_at(p);
    for (const Crossing& crossing : crossings) {
      EXPECT_EQ(crossing.from, region);
      EXPECT_NE(crossing.to, region);
      region = crossing.to;
    }
    EXPECT_EQ(region, domain->region_at(q));
    EXPECT_EQ(crossings.size(), hard.crossings)
        << p.x << " " << p.y << " " << p.z << " to " << q.x << " " << q.y << " " << q.z;
  }
}

TEST(PolyhedronPlugin, CrossingsLieOnTheSurface) {
  const auto domain = open_surface("places.off", cube(1).off());
  Crossings crossings;
  domain->crossings({{-3, 0.25, 0.125}, {2, 0.25, 0.125}}, crossings);
  ASSERT_EQ(crossings.size(), 2u);
  EXPECT_NEAR(crossings[0].point.x, -1, 1e-14);
  EXPECT_NEAR(crossings[1].point.x, 1, 1e-14);
  EXPECT_NEAR(*domain->residual_at(crossings[0].point), 0, 1e-14);
  EXPECT_GT(*domain->residual_at({0, 0, 0}), 0.2);
}

}  // namespace
}  // namespace scantet
