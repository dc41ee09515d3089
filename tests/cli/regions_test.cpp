// Several levels: regions inside each other, from the command line to the files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "read_json.h"
#include "run_process.h"

namespace scantet {
namespace {

using nlohmann::json;

std::vector<std::string> torus_arguments(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"mesh", sample("torus.nrrd"), "--size", "2"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(Regions, AreMeshedAndReported) {
  const TestFolder folder;
  const RunResult run =
      run_scantet(torus_arguments({"--level", "450", "--level", "300.5", "--report", folder / "a.json"}));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("regions    1: "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("interfaces 1/0: "), std::string::npos) << run.out;
  const json report = read_json(folder / "a.json");
  EXPECT_EQ(report["options"]["level"], json::parse("[450, 300.5]"));
  const json& regions = report["mesh"]["regions"];
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[0]["region"], 1);
  EXPECT_NEAR(regions[0]["volume_mm3"].get<double>(), 4200, 100);
  EXPECT_NEAR(regions[1]["volume_mm3"].get<double>(), 2663, 200) << "within the higher level";
  const json& interfaces = report["topology"]["interfaces"];
  ASSERT_EQ(interfaces.size(), 2U);
  EXPECT_EQ(interfaces[0]["regions"], json::parse("[1, 0]"));
  EXPECT_EQ(interfaces[1]["regions"], json::parse("[1, 2]"));
  for (const json& interface : interfaces) {
    EXPECT_EQ(interface["surfaces"], 1);
    EXPECT_EQ(interface["euler"], 0);
  }
  EXPECT_EQ(report["topology"]["expected"]["components"], 2);
  EXPECT_EQ(report["audit"]["passed"], true);
}

TEST(Regions, AreTaggedInEveryFormat) {
  const TestFolder folder;
  std::vector<std::string> arguments =
      torus_arguments({"--level", "300.5", "--level", "450", "--report", folder / "a.json"});
  const std::vector<std::string> names{"a.vtu", "a.vtk", "a.msh", "a.msh2", "a.mesh", "a.inp",
                                       "a.feb", "a.bdf", "a.e",   "a.med",  "a.stl",  "a.ply"};
  for (const std::string& name : names) arguments.insert(arguments.end(), {"-o", folder / name});
  ASSERT_EQ(run_scantet(arguments).status, 0);
  const auto says = [&](const std::string& name, const std::vector<std::string>& parts) {
    const std::string bytes = read_bytes(folder / name);
    for (const std::string& part : parts) EXPECT_NE(bytes.find(part), std::string::npos) << name << ": " << part;
  };
  says("a.msh", {"\"region_1\"", "\"region_2\"", "\"boundary_1_0\"", "\"boundary_1_2\""});
  says("a.msh2", {"\"region_1\"", "\"region_2\"", "\"boundary_1_0\"", "\"boundary_1_2\""});
  says("a.mesh", {"between regions 1 (behind) and 0 (in front)", "between regions 1 (behind) and 2 (in front)"});
  says("a.inp", {"ELSET=REGION_1", "ELSET=REGION_2", "NAME=BOUNDARY_1_0", "NAME=BOUNDARY_1_2"});
  says("a.feb", {"<Elements type=\"tet4\" name=\"region_2\">", "<Surface name=\"boundary_1_2\">"});
  says("a.bdf", {"$ property 1: region_1", "$ property 2: region_2", ": boundary_1_0", ": boundary_1_2"});
  says("a.med", {"region_1", "region_2", "boundary_1_0", "boundary_1_2"});
  says("a.e", {"region_1", "region_2", "boundary_1_0", "boundary_1_2"});
  const json original = read_json(folder / "a.json");
  for (const char* name : {"a.vtu", "a.vtk", "a.msh", "a.msh2", "a.mesh"}) {
    ASSERT_EQ(run_scantet({"report", folder / name, "--report", folder / "b.json"}).status, 0) << name;
    const json read = read_json(folder / "b.json");
    EXPECT_EQ(read["mesh"]["regions"], original["mesh"]["regions"]) << name;
    EXPECT_EQ(read["topology"]["interfaces"], original["topology"]["interfaces"]) << name;
  }
  const auto triangles = original["mesh"]["boundary_facets"].get<std::size_t>();
  EXPECT_EQ(read_bytes(folder / "a.stl").size(), 84 + 50 * triangles) << "all interfaces";
  says("a.ply", {"element face " + std::to_string(triangles)});
}

TEST(Regions, LevelsMayStandInAConfigurationInAnyOrder) {
  const TestFolder folder;
  const auto regions_with = [&](const std::string& levels) {
    write_bytes(folder / "job.json", "{\"level\": " + levels + ", \"report\": \"a.json\"}");
    const RunResult run = run_scantet(torus_arguments({"--config", "job.json"}), {folder.path()});
    EXPECT_EQ(run.status, 0) << run.err;
    return read_json(folder / "a.json")["mesh"]["regions"];
  };
  EXPECT_EQ(regions_with("[300.5, 450]"), regions_with("[450, 300.5]"));
  EXPECT_EQ(regions_with("[300.5]"), regions_with("300.5"));
  EXPECT_EQ(read_json(folder / "a.json")["options"]["level"], 300.5);
}

TEST(Regions, BadLevelsAreRefusedByName) {
  const auto expect = [](std::vector<std::string> options, int status, const std::string& part) {
    const TestFolder folder;
    options.insert(options.end(), {"-o", folder / "a.vtu"});
    const RunResult run = run_scantet(torus_arguments(options));
    EXPECT_EQ(run.status, status) << run.err;
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
    EXPECT_TRUE(folder.names().empty());
  };
  expect({"--level", "300.5", "--level", "300.5"}, 2, "level 300.5 is given twice");
  expect({"--level", "300.5", "--level", "300.50001"}, 2, "too near each other");
  expect({"--level", "300.5", "--level", "nan"}, 2, "--level: nan is not a level");
  expect({"--level", "300.5", "--level", "1e5"}, 3, "level 1e+05 leaves nothing inside");
  expect({"--level", "300.5", "--level", "450", "--outside", "400"}, 2, "inside of level 300.5");
}

TEST(Regions, InfoDescribesEachLevelAndRegion) {
  const std::vector<std::string> arguments{"info", sample("torus.nrrd"), "--level", "450", "--level", "300.5"};
  const RunResult text = run_scantet(arguments);
  ASSERT_EQ(text.status, 0) << text.err;
  for (const char* part : {"level 300.5", "level 450", "Components of region 1", "Components of region 2"}) {
    EXPECT_NE(text.out.find(part), std::string::npos) << text.out;
  }
  std::vector<std::string> for_programs = arguments;
  for_programs.push_back("--json");
  const json info = json::parse(run_scantet(for_programs).out);
  EXPECT_EQ(info["border_1"]["level"], 300.5);
  EXPECT_EQ(info["border_2"]["level"], 450);
  EXPECT_EQ(info["components_1"]["components"], 1);
  EXPECT_EQ(info["components_1"]["cavities"], 0);
  EXPECT_EQ(info["components_2"]["components"], 1);
  EXPECT_FALSE(info.contains("components"));
}

}  // namespace
}  // namespace scantet
