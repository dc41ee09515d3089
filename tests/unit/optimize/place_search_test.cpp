#include <gtest/gtest.h>

#include "scantet/base/mesh_topology.h"
#include "scantet/optimize/place_search_impl.h"
#include "unit/optimize/test_meshes.h"

namespace scantet::optimize {
namespace {

/// A vertex in a regular octahedron, whose best place is in the middle.
class PlaceSearchIn : public testing::Test {
 protected:
  void add_octahedron(PlaceSearch& search) const {
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        for (const double z : {-1.0, 1.0}) {
          const Point a{x, 0, 0};
          const Point b{0, y, 0};
          const Point c{0, 0, z};
          if (x * y * z > 0) {
            search.add_face(a, b, c);
          } else {
            search.add_face(a, c, b);
          }
        }
      }
    }
  }
  static std::optional<Point> step(const Point& from, const Vec& direction, double length_mm) {
    return from + length_mm * direction;
  }
  static double no_facets(const Point&, double) { return kNoFacets; }

  const Point start_{0.3, -0.2, 0.25};
  TetJudge judge_{{.min_dihedral_deg = 60}};
};

TEST_F(PlaceSearchIn, AnOctahedronFindsTheMiddle) {
  double last = kInverted;
  for (const Depth depth : {Depth::usual, Depth::deep}) {
    PlaceSearch search(judge_, depth);
    add_octahedron(search);
    const Place place = search.run(start_, kNoFacets, step, no_facets);
    EXPECT_LT(length(place.point), 0.3 * length(start_));
    EXPECT_LE(place.sharpest, last) << "deep finds no worse than usual";
    last = place.sharpest;
  }
}

TEST_F(PlaceSearchIn, AnOctahedronStopsWhereItIsGoodEnough) {
  const TetJudge easy{{.min_dihedral_deg = 5}};
  PlaceSearch search(easy);
  add_octahedron(search);
  const Place place = search.run(start_, kNoFacets, step, no_facets);
  EXPECT_EQ(place.point, start_);
  EXPECT_EQ(place.sharpest, easy.bound());
}

TEST_F(PlaceSearchIn, AnOctahedronStaysWhereNoStepCanBeMade) {
  PlaceSearch search(judge_);
  add_octahedron(search);
  const auto stuck = [](const Point&, const Vec&, double) -> std::optional<Point> { return std::nullopt; };
  EXPECT_EQ(search.run(start_, kNoFacets, stuck, no_facets).point, start_);
  EXPECT_EQ(search.run(start_, kNoFacets, step, [](const Point&, double) { return kInverted; }).point, start_);
}

TEST_F(PlaceSearchIn, AnOctahedronCountsFacetsToo) {
  PlaceSearch search(judge_);
  add_octahedron(search);
  const auto away_from_left = [](const Point& p, double) { return p.x < 0.2 ? 0.99 : kNoFacets; };
  const Place place = search.run(start_, kNoFacets, step, away_from_left);
  EXPECT_GE(place.point.x, 0.2);
  EXPECT_NE(place.point, start_);
}

}  // namespace
}  // namespace scantet::optimize
