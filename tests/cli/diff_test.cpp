// `scantet diff`: what counts as the same, what is told of a difference, and the forms of the report.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>

#include "read_json.h"
#include "run_process.h"

namespace scantet {
namespace {

using nlohmann::json;

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

// The same tets with other sets and fields are other meshes, of whatever formats.
TEST_F(Diff, SetsAndFieldsAreComparedByTheirMembersAndValues) {
  const std::string sphere = sample("sphere.nrrd");
  for (const auto& [name, side, what] : {std::array<std::string, 3>{"a", "z < -8", "mean"}, {"b", "z > 8", "max"}}) {
    ASSERT_EQ(
        run_scantet({"mesh", sphere, "--level", "127.5", "--size", "5", "--set", "foot=" + side, "--field",
                     "hu=" + sphere + ":" + what, "-o", folder_ / (name + ".vtu"), "-o", folder_ / (name + ".msh")})
            .status,
        0);
  }
  for (const std::string extension : {".vtu", ".msh"}) {
    const RunResult run =
        run_scantet({"diff", folder_ / "a.vtu", folder_ / ("b" + extension), "--report", folder_ / "d.json"});
    EXPECT_EQ(run.status, 4) << run.out;
    EXPECT_TRUE(contains(run.out, "different: the set \"foot\" has other vertices: ")) << run.out;
    EXPECT_TRUE(contains(run.out, "the set \"foot\" has other tets: ")) << run.out;
    EXPECT_TRUE(contains(run.out, "values of the field \"hu\" differ by up to ")) << run.out;
    const json attached = read_json(folder_ / "d.json")["attached"];
    EXPECT_EQ(attached["paired"], true);
    ASSERT_EQ(attached["sets"].size(), 2u);
    EXPECT_EQ(attached["sets"][0]["of"], "vertices");
    EXPECT_EQ(attached["sets"][0]["alone"], attached["sets"][0]["members"]) << "nothing in common";
    EXPECT_EQ(attached["sets"][1]["of"], "tets");
    const json& field = attached["fields"][0];
    EXPECT_NEAR(field["largest"].get<double>(), field["values"][1].get<double>() - field["values"][0].get<double>(),
                1e-9);
    EXPECT_GT(field["largest"].get<double>(), 0);
  }
  const RunResult facets = run_scantet({"diff", folder_ / "a.msh", folder_ / "b.msh"});
  EXPECT_TRUE(contains(facets.out, "the set \"foot\" has other facets: ")) << facets.out;
  const RunResult same = run_scantet({"diff", folder_ / "a.vtu", folder_ / "a.msh"});
  EXPECT_EQ(same.status, 0) << same.out;
  EXPECT_TRUE(contains(same.out, "facets of sets, which .vtu does not hold")) << same.out;
}

// A .msh of 2.2 with a field, of the cube.
std::string with_field(double value) {
  const Cube cube;
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n";
  for (std::size_t v = 0; v < 8; ++v) {
    text += std::to_string(v + 1);
    for (const double x : cube.vertices[v]) text += " " + std::to_string(x);
    text += "\n";
  }
  text += "$EndNodes\n$Elements\n6\n";
  for (std::size_t t = 0; t < 6; ++t) {
    const auto& tet = cube.tets[t];
    text += std::to_string(t + 1) + " 4 2 1 1";
    for (std::size_t k = 0; k < 4; ++k) text += " " + std::to_string(tet[k]);
    text += "\n";
  }
  text += "$EndElements\n$ElementData\n1\n\"hu\"\n1\n0\n3\n0\n1\n6\n";
  for (std::size_t t = 0; t < 6; ++t) text += std::to_string(t + 1) + " " + std::to_string(t == 4 ? value : -50) + "\n";
  return text + "$EndElementData\n";
}

TEST_F(Diff, ValuesOfFieldsHaveATolerance) {
  write_bytes(folder_ / "a.msh", with_field(40));
  write_bytes(folder_ / "b.msh", with_field(40.5));
  const std::vector<std::string> words{"diff", folder_ / "a.msh", folder_ / "b.msh"};
  const auto compare_within = [&](const std::string& share) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--field-tolerance", share});
    return run_scantet(all);
  };
  const RunResult exact = run_scantet(words);
  EXPECT_EQ(exact.status, 4) << exact.err;
  EXPECT_TRUE(contains(exact.out, "values of the field \"hu\" differ by up to 0.5: 40 in A and 40.5 in B"))
      << exact.out;
  EXPECT_EQ(compare_within("0.009").status, 4) << "0.5 is 0.01 of the greatest, which is 50";
  const RunResult near = compare_within("0.011");
  EXPECT_EQ(near.status, 0) << near.out;
  EXPECT_TRUE(contains(near.out, "values of fields within 0.011 of the greatest")) << near.out;
}

// Where tets are others, sets have no members in common that could be told.
TEST_F(Diff, SetsOfOtherTetsAreCounted) {
  const std::string sphere = sample("sphere.nrrd");
  for (const std::string size : {"5", "6"}) {
    ASSERT_EQ(run_scantet({"mesh", sphere, "--level", "127.5", "--size", size, "--set", "foot=z < -8", "--field",
                           "hu=" + sphere + ":mean", "-o", folder_ / (size + ".vtu")})
                  .status,
              0);
  }
  const RunResult run = run_scantet({"diff", folder_ / "5.vtu", folder_ / "6.vtu", "--tolerance", "20"});
  EXPECT_EQ(run.status, 4) << run.out;
  EXPECT_TRUE(contains(run.out, " vertices in A and ")) << run.out;
  EXPECT_TRUE(contains(run.out,
                       "members of sets but for their numbers, for the tets are others; values of fields, for "
                       "the tets are others"))
      << run.out;
}

// The cube with names of regions that few formats take as they are, sets of all kinds, a set of facets alone, and a
// field.
std::string with_names(const std::string& region = "left lung", const std::string& set = "foot") {
  std::string text = with_field(40);
  text.insert(text.find("$Nodes"),
              "$PhysicalNames\n3\n2 3 \"wall\"\n3 1 \"" + region + "\"\n3 2 \"right.lung\"\n$EndPhysicalNames\n");
  text.replace(text.find("$Elements\n6\n"), 12, "$Elements\n7\n7 2 2 3 3 1 2 3\n");
  text.replace(text.find(" 4 2 1 1"), 8, " 4 2 2 2");
  for (const auto& [kind, count] : {std::pair{"Node", 8}, {"Element", 6}}) {
    text += std::string("$") + kind + "Data\n1\n\"set_" + set + "\"\n1\n0\n3\n0\n1\n" + std::to_string(count) + "\n";
    for (int i = 1; i <= count; ++i) text += std::to_string(i) + (i < 4 ? " 1\n" : " 0\n");
    text += std::string("$End") + kind + "Data\n";
  }
  return text;
}

// Every format that is read has what it can of one mesh, under the names that it can have.
TEST_F(Diff, OneMeshIsTheSameInAllFormats) {
  write_bytes(folder_ / "a.msh", with_names());
  const std::array<std::string, 6> files{"k.vtu", "k.vtk", "k.msh", "k.msh2", "k.inp", "k.mesh"};
  for (const std::string& file : files) {
    ASSERT_EQ(run_scantet({"convert", folder_ / "a.msh", folder_ / file}).status, 0);
  }
  for (const std::string& a : files) {
    for (const std::string& b : files) {
      const RunResult run = run_scantet({"diff", folder_ / a, folder_ / b});
      EXPECT_EQ(run.status, 0) << a << " " << b << "\n" << run.out << run.err;
    }
  }
  const auto report_on = [&](const std::string& a, const std::string& b) {
    EXPECT_EQ(run_scantet({"diff", folder_ / a, folder_ / b, "--report", folder_ / "d.json"}).status, 0);
    return read_json(folder_ / "d.json");
  };
  EXPECT_EQ(report_on("k.vtk", "k.vtu")["not_compared"], json({"", "names of regions, which .vtk does not hold"}));
  EXPECT_EQ(
      report_on("k.vtu", "k.mesh")["not_compared"],
      json({"names of regions, which .mesh does not hold; sets, which .mesh does not hold; fields, which .mesh does "
            "not hold",
            ""}));
  const json with_inp = report_on("k.vtu", "k.inp");
  EXPECT_EQ(with_inp["not_compared"],
            json({"fields, which .inp does not hold", "facets of sets, which .vtu does not hold"}));
  ASSERT_EQ(with_inp["attached"]["sets"].size(), 2u);
  EXPECT_EQ(with_inp["attached"]["sets"][0]["name"], "foot") << "it is FOOT in the other";
  EXPECT_EQ(with_inp["attached"]["sets"][0]["alone"], json({0, 0}));
  EXPECT_EQ(with_inp["regions"][0]["sides"][1]["name"], "LEFT_LUNG") << "the name as it is";
}

TEST_F(Diff, OtherNamesAreDifferencesInTwoFormatsToo) {
  write_bytes(folder_ / "a.msh", with_names());
  write_bytes(folder_ / "b.msh", with_names("left_lung", "toe"));
  const auto differences = [&](const std::string& a, const std::string& b) {
    const RunResult run = run_scantet({"diff", folder_ / a, folder_ / b});
    EXPECT_EQ(run.status, 4) << run.out << run.err;
    return run.out.substr(0, run.out.find("\n\n"));
  };
  const std::string strict = differences("a.msh", "b.msh");
  EXPECT_TRUE(contains(strict, "region 1 is called \"left lung\" in A and \"left_lung\" in B")) << strict;
  for (const std::string file : {"b.vtu", "b.inp"}) {
    ASSERT_EQ(run_scantet({"convert", folder_ / "b.msh", folder_ / file}).status, 0);
    const std::string found = differences("a.msh", file);
    EXPECT_FALSE(contains(found, "is called")) << found;
    EXPECT_TRUE(contains(found, "the set \"foot\" is in A alone")) << found;
    EXPECT_TRUE(contains(found, file == "b.inp" ? "the set \"TOE\" is in B alone" : "the set \"toe\" is in B alone"))
        << found;
  }
  write_bytes(folder_ / "c.msh", with_names("left kidney"));
  EXPECT_TRUE(
      contains(differences("c.msh", "b.inp"), "region 1 is called \"left kidney\" in A and \"LEFT_LUNG\" in B"));
}

// The cube in tets of ten nodes. The node on the diagonal inside is moved, which changes no volume and no boundary.
std::string curved(double moved_mm) {
  constexpr std::array<std::array<std::size_t, 2>, 6> kEdges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
  const Cube cube;
  std::vector<std::array<double, 3>> vertices = cube.vertices;
  std::map<std::array<int, 2>, std::size_t> nodes;
  std::string tets;
  for (const auto& tet : cube.tets) {
    for (std::size_t k = 0; k < 4; ++k) tets += std::to_string(tet[k]) + " ";
    for (const auto& [from, to] : kEdges) {
      const auto [a, b] = std::minmax(tet[from], tet[to]);
      const auto [node, is_new] = nodes.try_emplace({a, b}, vertices.size() + 1);
      if (is_new) {
        std::array<double, 3>& middle = vertices.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
          middle[axis] =
              (vertices[static_cast<std::size_t>(a) - 1][axis] + vertices[static_cast<std::size_t>(b) - 1][axis]) / 2;
        }
        if (a == 1 && b == 7) middle[0] += moved_mm;
      }
      tets += std::to_string(node->second) + " ";
    }
    tets += std::to_string(tet[4]) + "\n";
  }
  std::string text = "MeshVersionFormatted 2\nDimension 3\nVertices\n" + std::to_string(vertices.size()) + "\n";
  for (const auto& v : vertices) {
    for (const double x : v) text += std::to_string(x) + " ";
    text += "0\n";
  }
  return text + "TetrahedraP2\n6\n" + tets + "End\n";
}

TEST_F(Diff, NodesOnEdgesAreComparedEdgeByEdge) {
  write_bytes(folder_ / "a.mesh", curved(0));
  write_bytes(folder_ / "b.mesh", curved(0.36));
  const auto compare_within = [&](const std::string& tolerance_mm) {
    return run_scantet(
        {"diff", folder_ / "a.mesh", folder_ / "b.mesh", "--tolerance", tolerance_mm, "--report", folder_ / "d.json"});
  };
  const RunResult exact = compare_within("0");
  EXPECT_EQ(exact.status, 4) << exact.out << exact.err;
  EXPECT_TRUE(contains(exact.out, "different: nodes on edges are up to 0.36 mm from the other's, so at (1, 1, 1) mm"))
      << exact.out;
  const json nodes = read_json(folder_ / "d.json")["attached"]["edge_nodes"];
  EXPECT_NEAR(nodes["largest_mm"].get<double>(), 0.36, 1e-12);
  EXPECT_EQ(nodes["places_mm"], json({{1.0, 1.0, 1.0}, {1.36, 1.0, 1.0}}));
  EXPECT_EQ(compare_within("0.35").status, 4);
  const RunResult near = compare_within("0.37");
  EXPECT_EQ(near.status, 0) << near.out;
  EXPECT_TRUE(contains(near.out, "nodes on edges within 0.36 mm")) << near.out;
}

// A vertex that tets do not share is a gap that coordinates do not show.
TEST_F(Diff, ADoubledVertexIsADifference) {
  Cube other;
  other.vertices.push_back(other.vertices[0]);
  other.tets[0][0] = 9;
  const RunResult run = compare({}, other);
  EXPECT_EQ(run.status, 4) << run.out;
  EXPECT_TRUE(contains(run.out, "in one mesh several vertices are where the other has one")) << run.out;
}

TEST_F(Diff, WhatIsNotReadIsTold) {
  ASSERT_EQ(compare({}, {}).status, 0);
  ASSERT_EQ(run_scantet({"convert", folder_ / "a.mesh", folder_ / "a.inp"}).status, 0);
  write_bytes(folder_ / "b.inp", read_bytes(folder_ / "a.inp") + "*MATERIAL, NAME=BONE\n*ELASTIC\n17000., 0.3\n");
  const RunResult run = run_scantet({"diff", folder_ / "a.inp", folder_ / "b.inp", "--report", folder_ / "d.json"});
  EXPECT_EQ(run.status, 0) << run.out;
  EXPECT_EQ(read_json(folder_ / "d.json")["not_compared"], json({"", "what is not read: *MATERIAL, *ELASTIC"}));
  EXPECT_TRUE(contains(run.out, "B: what is not read: *MATERIAL, *ELASTIC")) << run.out;
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
