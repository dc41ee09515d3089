#include <gtest/gtest.h>

#include "scantet/base/error.h"
#include "scantet/places/place.h"

namespace scantet {
namespace {

std::string message(const std::string& text) {
  try {
    read_named_place("--set", text);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "usage.place");
    EXPECT_EQ(error.fault(), Fault::usage);
    return error.what();
  }
  return "none";
}

TEST(PlaceText, ShapesHaveTheirNumbers) {
  const Place box = read_place("--set", "box(1, 2, 3, -1, 5, 6)");
  EXPECT_EQ(box.kind, Place::Kind::box);
  EXPECT_EQ(box.numbers, (std::vector<double>{-1, 2, 3, 1, 5, 6}));  // corners in either order
  EXPECT_EQ(read_place("--set", " cylinder( 0,0,0, 0,0,1e1 ,+2 ) ").numbers.size(), 7U);
  const Place normal = read_place("--set", "normal(0, 0, -1, 30)");
  EXPECT_EQ(normal.kind, Place::Kind::normal);
}

TEST(PlaceText, HalfSpacesAreWrittenAsCuts) {
  const Place slab = read_place("--set", "-10 < x + 2z < 4");
  ASSERT_EQ(slab.planes.size(), 2U);
  const Place half = read_place("--set", "z < -40");
  ASSERT_EQ(half.planes.size(), 1U);
  EXPECT_NEAR(half.planes[0].beyond_mm({0, 0, -41}), -1, 1e-12);
}

TEST(PlaceText, JoinsBindAsTheyAreRead) {
  const Place place = read_place("--set", "z < 1 and not ball(0,0,0,2) or x > 3 minus patch(\"a or b\")");
  ASSERT_EQ(place.kind, Place::Kind::any_of);
  ASSERT_EQ(place.parts.size(), 2U);
  EXPECT_EQ(place.parts[0].kind, Place::Kind::all_of);
  EXPECT_EQ(place.parts[0].parts[1].kind, Place::Kind::not_in);
  EXPECT_EQ(place.parts[1].parts[1].parts[0].name, "a or b");
  const Place grouped = read_place("--set", "z < 1 & (x > 3 | y > 3)");
  EXPECT_EQ(grouped.kind, Place::Kind::all_of);
  EXPECT_EQ(grouped.parts[1].kind, Place::Kind::any_of);
}

TEST(PlaceText, NamesAndItems) {
  const NamedPlace foot = read_named_place("--set", "foot=facets: border(inferior)");
  EXPECT_EQ(foot.name, "foot");
  EXPECT_EQ(foot.items, PlaceItems::facets);
  EXPECT_EQ(foot.place.kind, Place::Kind::border);
  EXPECT_EQ(read_named_place("--set", "a_1=all").items, PlaceItems::all);
}

// Readers take such names for what follows from regions.
TEST(PlaceText, NamesOfTheMeshesOwnGroupsAreTaken) {
  for (const char* name : {"corners", "Corners", "boundary_12", "BOUNDARY_1_0", "curve_1", "Curve_0_1_2", "region_7"}) {
    EXPECT_NE(message(name + std::string("=all")).find("files use the name " + std::string(name) + " for "),
              std::string::npos)
        << name;
  }
  for (const char* name : {"corner", "corners_2", "boundary_a", "boundary_1a", "curve_", "curved_1", "regions_7"}) {
    EXPECT_EQ(read_named_place("--set", name + std::string("=all")).name, name);
  }
}

TEST(PlaceText, ThresholdsOfScansAreFound) {
  const Place place = read_place("--set", "scan(\"pet.nrrd\") > 3 and scan(ct.nrrd) <= -5 and not scan(ct.nrrd) < -9");
  EXPECT_EQ(scans_of(place), (std::vector<std::string>{"pet.nrrd", "ct.nrrd"}));
  EXPECT_TRUE(is_of_points(place));
  EXPECT_FALSE(is_of_points(read_place("--set", "x < 3 or patch(wall)")));
}

TEST(PlaceText, MistakesAreToldWithTheirColumn) {
  EXPECT_NE(message("a=ball(1, 2, 3)").find("column 3: 3 numbers instead of 4"), std::string::npos);
  EXPECT_NE(message("a=z < 3 and bal(1,2,3,4)").find("column 13: \"bal\" is no place; did you mean ball?"),
            std::string::npos);
  EXPECT_NE(message("a=(z < 3").find("column 9: a closing parenthesis is missing"), std::string::npos);
  EXPECT_NE(message("a=ball(1, x, 3, 4)").find("column 11: a number is missing"), std::string::npos);
  EXPECT_NE(message("a=z < 3 and").find("column 12: a place is missing at the end"), std::string::npos);
  EXPECT_NE(message("a=z < three").find("column 3"), std::string::npos);
  EXPECT_NE(message("a=all) or all").find("column 6: this parenthesis was not opened"), std::string::npos);
  EXPECT_NE(message("a=region()").find("a name is missing"), std::string::npos);
  EXPECT_NE(message("a=border(top)").find("is no side"), std::string::npos);
  EXPECT_NE(message("a=scan(x) = 3").find("< or > and a value are missing"), std::string::npos);
  for (const char* text : {"all", "=all", "1a=all", "a b=all", "a=", "a=ball(0,0,0,-1)", "nodes_a=all", "BOUNDARY=all",
                           "a=normal(0,0,0,3)", "a=cylinder(1,1,1,1,1,1,2)", "a=nearest(0.5,0,0,0)", "a=box(1,2)"}) {
    EXPECT_NE(message(text), "none") << text;
  }
  EXPECT_NE(message("a=" + std::string(100000, '(')), "none");
  EXPECT_NE(message("a=" + std::string(100000, '!')), "none");
}

}  // namespace
}  // namespace scantet
