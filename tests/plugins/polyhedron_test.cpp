// Surfaces that are refused, and segments through edges, vertices and along faces.
#include <gtest/gtest.h>

#include "contract/plugin_case.h"
#include "scantet/base/error.h"
#include "surface_files.h"

namespace scantet {
namespace {

std::unique_ptr<Domain> open(const std::string& name, const std::string& text) {
  const std::string file = write_surface(name, text);
  try {
    auto domain = open_with_plugin(SCANTET_POLYHEDRON_PLUGIN, file);
    std::filesystem::remove(file);
    return domain;
  } catch (...) {
    std::filesystem::remove(file);
    throw;
  }
}

void expect_refused(const std::string& name, const std::string& text, const std::string& says) {
  try {
    open(name, text);
    ADD_FAILURE() << name << " was opened";
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_EQ(error.code(), "input.surface") << what;
    EXPECT_EQ(error.fault(), Fault::input);
    EXPECT_NE(what.find(name), std::string::npos) << what;
    EXPECT_NE(what.find(says), std::string::npos) << what;
  }
}

TEST(PolyhedronPlugin, RefusesWhatEnclosesNothing) {
  Facets lid_off = cube(1);
  lid_off.polygons.pop_back();
  expect_refused("open.off", lid_off.off(), "4 edges have a facet on one side only");
  expect_refused("open.stl", lid_off.stl(), "not closed");
  Facets overlapping = cube(1);
  overlapping.add_cube({0.5, 0.25, 0.125}, 1);
  expect_refused("overlapping.off", overlapping.off(), "meets itself");
  Facets empty;
  expect_refused("empty.off", empty.off(), "no facet");
  expect_refused("rubbish.off", "OFF\nthree points", "");
  expect_refused("rubbish.stl", "solid\nfacet", "");
  Facets dangling = cube(1);
  dangling.polygons[0][0] = 99;
  expect_refused("dangling.off", dangling.off(), "");
  std::string nan = cube(1).off();
  nan.replace(nan.find("-1.000000"), 9, "nan      ");
  expect_refused("nan.off", nan, "");
}

TEST(PolyhedronPlugin, SafeRepairIsDone) {
  Facets facets = cube(1);
  std::reverse(facets.polygons[2].begin(), facets.polygons[2].end());
  facets.polygons.push_back(facets.polygons[0]);
  const auto domain = open("turned.obj", facets.obj());
  EXPECT_EQ(domain->region_at({0, 0, 0}), 1);
  EXPECT_EQ(domain->region_at({1.01, 0, 0}), kOutside);
}

struct Hard {
  Segment segment;
  std::size_t crossings;
};

TEST(PolyhedronPlugin, HardSegmentsAreAnswered) {
  const auto domain = open("hard.off", cubes().off());
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
  const auto domain = open("places.off", cube(1).off());
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
