// Tets of ten nodes, from the command line to files and back.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "meshed.h"

namespace scantet {
namespace {

using nlohmann::json;

TEST(SecondOrder, IsWrittenReadConvertedComparedAndVerified) {
  const TestFolder folder;
  const std::string sphere = sample("sphere.nrrd");
  const RunResult made = run_scantet({"mesh", sphere, "--level", "100.5", "--size", "4", "--order", "2", "-o", "a.vtu",
                                      "-o", "a.inp", "-o", "a.msh", "--report", "a.json"},
                                     {folder.path()});
  ASSERT_EQ(made.status, 0) << made.err;
  const json report = read_json(folder / "a.json");
  const double curved_mm3 = report["second_order"]["volume_mm3"];
  EXPECT_EQ(report["second_order"]["unproved"], 0);
  EXPECT_GT(curved_mm3, report["mesh"]["volume_mm3"].get<double>()) << "a ball's curved elements bulge";
  for (const std::string file : {"a.vtu", "a.inp", "a.msh"}) {
    const RunResult read = run_scantet({"report", file, "--report", "b.json"}, {folder.path()});
    ASSERT_EQ(read.status, 0) << file << read.err;
    const json again = read_json(folder / "b.json");
    EXPECT_EQ(again["mesh"]["tets"], report["mesh"]["tets"]) << file;
    EXPECT_EQ(again["second_order"]["edges"], report["second_order"]["edges"]) << file;
    EXPECT_EQ(again["second_order"]["boundary_edges"], report["second_order"]["boundary_edges"]) << file;
    EXPECT_NEAR(again["second_order"]["volume_mm3"].get<double>(), curved_mm3, 1e-9 * curved_mm3) << file;
    EXPECT_EQ(again["second_order"]["unproved"], 0) << file;
    EXPECT_FALSE(again["second_order"].contains("eased_tets")) << "a file does not say";
  }
  for (const std::string file : {"b.vtk", "b.msh2", "b.inp", "b.elmer", "b.vtm", "b.feb", "b.mesh"}) {
    const RunResult converted = run_scantet({"convert", "a.vtu", file}, {folder.path()});
    EXPECT_EQ(converted.status, 0) << file << converted.err;
  }
  for (const std::string file : {"b.msh2", "b.mesh"}) {
    EXPECT_EQ(run_scantet({"diff", "a.vtu", file}, {folder.path()}).status, 0) << file;
  }

  const RunResult verified = run_scantet({"verify", "a.vtu", "--against", sphere, "--level", "100.5"}, {folder.path()});
  EXPECT_EQ(verified.status, 4) << verified.err;
  EXPECT_NE(verified.out.find("grade         undecided"), std::string::npos) << verified.out;
  EXPECT_NE(verified.out.find("[mesh.second_order]"), std::string::npos) << verified.out;
}

TEST(SecondOrder, SetsOfCurvesHaveTheNodesOnTheirEdges) {
  const TestFolder folder;
  const RunResult made =
      run_scantet({"mesh", sample("bar.mha"), "--level", "0.5", "--size", "4", "--cut", "clamp: x > -5", "--set",
                   "rim=nodes: curve()", "--set", "same=nodes: curve(curve_0_1)", "--order", "2", "-o", "a.inp"},
                  {folder.path()});
  ASSERT_NE(made.status, 1) << made.err;
  std::istringstream deck(read_bytes(folder / "a.inp"));
  std::map<std::string, std::size_t> nodes;
  std::string set;
  for (std::string line; std::getline(deck, line);) {
    if (line.starts_with("*")) {
      set = line.starts_with("*NSET, NSET=") ? line.substr(12) : "";
    } else if (!set.empty()) {
      nodes[set] += static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + (line.ends_with(",") ? 0 : 1);
    }
  }
  EXPECT_GT(nodes["CURVE_0_1"], 4U);
  EXPECT_EQ(nodes["RIM"], nodes["CURVE_0_1"]);
  EXPECT_EQ(nodes["SAME"], nodes["RIM"]);
}

TEST(SecondOrder, DiffTellsOrdersApart) {
  const TestFolder folder;
  const std::string sphere = sample("sphere.nrrd");
  for (const std::string order : {"1", "2"}) {
    ASSERT_EQ(run_scantet({"mesh", sphere, "--level", "100.5", "--size", "4", "--order", order, "-o", order + ".vtu"},
                          {folder.path()})
                  .status,
              0);
  }
  const RunResult differ = run_scantet({"diff", "1.vtu", "2.vtu"}, {folder.path()});
  EXPECT_EQ(differ.status, 4);
  EXPECT_NE(differ.out.find("the tetrahedra of B have ten nodes"), std::string::npos) << differ.out;
}

}  // namespace
}  // namespace scantet
