// `scantet diff`: what counts as the same, what is told of a difference, and the forms of the report.
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "read_json.h"
#include "run_process.h"

namespace scantet {
namespace {

using nlohmann::json;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// A cube of 2 mm in two regions, as a Medit file.
struct Cube {
  std::vector<std::array<double, 3>> vertices{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0},
                                              {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}};
  // Six tets around the diagonal from the first to the seventh corner; three of each region.
  std::vector<std::array<int, 5>> tets{{1, 2, 3, 7, 1}, {1, 3, 4, 7, 1}, {1, 4, 8, 7, 1},
                                       {1, 8, 5, 7, 2}, {1, 5, 6, 7, 2}, {1, 6, 2, 7, 2}};

  std::string text() const {
    std::string text = "MeshVersionFormatted 2\nDimension 3\nVertices\n" + std::to_string(vertices.size()) + "\n";
    for (const auto& v : vertices) {
      for (const double x : v) text += std::to_string(x) + " ";
      text += "0\n";
    }
    text += "Tetrahedra\n" + std::to_string(tets.size()) + "\n";
    for (const auto& t : tets) {
      for (const int i : t) text += std::to_string(i) + " ";
      text += "\n";
    }
    return text + "End\n";
  }
};

class Diff : public testing::Test {
 protected:
  RunResult compare(const Cube& a, const Cube& b, const std::vector<std::string>& more = {}) {
    write_bytes(folder_ / "a.mesh", a.text());
    write_bytes(folder_ / "b.mesh", b.text());
    std::vector<std::string> words{"diff", folder_ / "a.mesh", folder_ / "b.mesh"};
    words.insert(words.end(), more.begin(), more.end());
    return run_scantet(words);
  }
  TestFolder folder_;
};

TEST_F(Diff, TheSameBytesAreSaidAtOnce) {
  const RunResult run = compare({}, {});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, "the same: the files have the same bytes\n");
}

TEST_F(Diff, AnotherFormatIsTheSameMesh) {
  write_bytes(folder_ / "a.mesh", Cube().text());
  ASSERT_EQ(run_scantet({"convert", folder_ / "a.mesh", folder_ / "a.vtu", "--space", "ras"}).status, 0);
  const RunResult run = run_scantet({"diff", folder_ / "a.mesh", folder_ / "a.vtu"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(contains(run.out, "the same: the same vertices and tets, in the same order\n")) << run.out;
  EXPECT_TRUE(contains(run.out, "made by")) << run.out;
  EXPECT_TRUE(contains(run.out, "the file does not say")) << run.out;
}

TEST_F(Diff, OtherNumbersOfVerticesAreTheSameGeometry) {
  Cube other;
  std::swap(other.vertices[1], other.vertices[4]);
  for (auto& tet : other.tets) {
    for (std::size_t k = 0; k < 4; ++k) tet[k] = tet[k] == 2 ? 5 : tet[k] == 5 ? 2 : tet[k];
  }
  std::swap(other.tets[0], other.tets[3]);
  const RunResult run = compare({}, other);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_TRUE(contains(run.out, "the same: the same tets at the same places, numbered in another order\n")) << run.out;
}

TEST_F(Diff, AMovedVertexIsADifferenceOfThatLength) {
  Cube other;
  other.vertices[6] = {2.25, 2.25, 2.25};
  const RunResult run = compare({}, other, {"--report", folder_ / "d.json"});
  EXPECT_EQ(run.status, 4) << run.err;
  EXPECT_TRUE(contains(run.out, "different: 6 tets of A are not in B, 6 of B not in A\n")) << run.out;
  const json report = read_json(folder_ / "d.json");
  EXPECT_EQ(report["same"], false);
  EXPECT_EQ(report["sameness"], "none");
  EXPECT_NEAR(report["to_first"]["lower_mm"].get<double>(), 0.25 * std::sqrt(3.0), 1e-9);
  EXPECT_GE(report["to_first"]["upper_mm"], report["to_first"]["lower_mm"]);
  EXPECT_EQ(report["to_first"]["worst"][0]["place_mm"], json({2.25, 2.25, 2.25}));
  EXPECT_EQ(report["meshes"].size(), 2u);
  const RunResult near = compare({}, other, {"--tolerance", "0.5"});
  EXPECT_EQ(near.status, 0) << near.out;
  EXPECT_TRUE(contains(near.out, "the same within 0.5 mm")) << near.out;
  EXPECT_EQ(compare({}, other, {"--tolerance", "0.4"}).status, 4);
}

TEST_F(Diff, ALostRegionIsNamed) {
  Cube other;
  other.tets.resize(3);
  const RunResult run = compare({}, other, {"--tolerance", "10"});
  EXPECT_EQ(run.status, 4) << run.err;
  EXPECT_TRUE(contains(run.out, "region 2 is in A alone")) << run.out;
}

TEST_F(Diff, OtherTagsOfTheSameTetsAreADifference) {
  Cube other;
  for (auto& tet : other.tets) tet[4] = tet[4] == 2 ? 5 : tet[4];
  const RunResult run = compare({}, other);
  EXPECT_EQ(run.status, 4) << run.err;
  EXPECT_TRUE(contains(run.out, "different: the same tets at the same places, but of other regions")) << run.out;
  EXPECT_TRUE(contains(run.out, "region 2 is in A alone")) << run.out;
  EXPECT_TRUE(contains(run.out, "region 5 is in B alone")) << run.out;
  EXPECT_TRUE(contains(run.out, "0 to 0 mm")) << "the boundary is the same" << run.out;
}

TEST_F(Diff, WhatCannotBeReadIsAnErrorOfTheInput) {
  write_bytes(folder_ / "a.mesh", Cube().text());
  write_bytes(folder_ / "broken.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n9\n");
  for (const std::string name : {"broken.mesh", "missing.vtu"}) {
    const RunResult run = run_scantet({"diff", folder_ / "a.mesh", folder_ / name});
    EXPECT_EQ(run.status, 3) << name;
    EXPECT_TRUE(contains(run.err, name)) << run.err;
    EXPECT_EQ(run.out, "");
  }
  EXPECT_EQ(run_scantet({"diff", folder_ / "broken.mesh", folder_ / "broken.mesh"}).status, 3);
  EXPECT_EQ(run_scantet({"diff", folder_ / "a.mesh"}).status, 2);
  EXPECT_EQ(run_scantet({"diff", folder_ / "a.mesh", folder_ / "a.mesh", "--report", folder_ / "a.mesh"}).status, 2);
}

TEST_F(Diff, OptionsThatDifferAreToldOfTwoRuns) {
  for (const std::string size : {"5", "6"}) {
    ASSERT_EQ(run_scantet({"mesh", sample("sphere.nrrd"), "--level", "127.5", "--size", size, "-o",
                           folder_ / (size + ".vtu"), "-o", folder_ / (size + ".msh")})
                  .status,
              0);
  }
  const RunResult run = run_scantet({"diff", folder_ / "5.vtu", folder_ / "6.msh", "--report", folder_ / "d.html",
                                     "--report", folder_ / "d.svg", "--report", folder_ / "d.json"});
  EXPECT_EQ(run.status, 4) << run.err;
  EXPECT_TRUE(contains(run.out, "--size 5                --size 6")) << run.out;
  EXPECT_TRUE(contains(run.out, "wrote " + (folder_ / "d.html"))) << run.out;
  EXPECT_TRUE(contains(read_bytes(folder_ / "d.html"), "\"key\":\"distance_mm\""));
  EXPECT_EQ(read_json(folder_ / "d.json")["provenance"], json({"--size 5", "--size 6"}));
}

}  // namespace
}  // namespace scantet
