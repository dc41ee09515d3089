// `scantet report` and the report of `scantet mesh` say the same of a mesh; the speed of waves is an option of both.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "read_json.h"
#include "run_process.h"

namespace scantet {
namespace {

using nlohmann::json;

// A real scan, where there: Debian's mricron-data. Its mesh has vertices on the level that no boundary facet has.
TEST(ReportJob, MeshAndReportSayTheSameOfAMesh) {
  const std::string brain = "/usr/share/mricron/templates/ch2bet.nii.gz";
  if (!std::filesystem::exists(brain)) GTEST_SKIP() << "no " << brain;
  const TestFolder folder;
  const RunResult run = run_scantet({"mesh", brain, "--level", "20", "--size", "4", "--wave-speed", "4000", "-o",
                                     folder / "a.vtu", "--report", folder / "a.json"});
  ASSERT_TRUE(run.status == 0 || run.status == 4) << run.err;
  const RunResult again =
      run_scantet({"report", folder / "a.vtu", "--wave-speed", "2000", "--report", folder / "b.json"});
  ASSERT_EQ(again.status, 0) << again.err << "the mesh's handles cannot be held against those of the scan any more";
  json ours = read_json(folder / "a.json");
  const json theirs = read_json(folder / "b.json");
  EXPECT_EQ(ours["mesh"], theirs["mesh"]);
  EXPECT_EQ(ours["topology"]["surface_list"], theirs["topology"]["surface_list"]);
  ours["quality"]["worst"].erase("min_edge_size_ratio");  // a file does not say what size was asked for
  EXPECT_EQ(ours["quality"]["worst"], theirs["quality"]["worst"]);
  EXPECT_EQ(ours["options"]["wave-speed"], 4000);
  const double height = ours["quality"]["min_height_mm"].get<double>();
  EXPECT_DOUBLE_EQ(ours["quality"]["min_stable_time_step_us"].get<double>(), height / 4);
  EXPECT_DOUBLE_EQ(theirs["quality"]["min_stable_time_step_us"].get<double>(), height / 2);
}

TEST(ReportJob, HandlesAreThoseOfTheInputOrNotChecked) {
  const TestFolder folder;
  const RunResult info = run_scantet({"info", sample("torus.nrrd"), "--level", "127.5", "--json"});
  ASSERT_EQ(info.status, 0) << info.err;
  const json components = json::parse(info.out)["components"];
  EXPECT_EQ(components["handles"], 1);
  EXPECT_EQ(components["euler"], 0);
  const RunResult run = run_scantet({"mesh", sample("torus.nrrd"), "--level", "127.5", "--size", "3", "-o",
                                     folder / "a.vtu", "--report", folder / "a.json"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("handles    the input's, in 1 component"), std::string::npos) << run.out;
  const json check = read_json(folder / "a.json")["topology"]["handle_check"];
  EXPECT_EQ(check["compared"], 1);
  EXPECT_EQ(check["handles"], 1);
  EXPECT_EQ(check["expected_handles"], 1);
  EXPECT_EQ(check["domain_euler"], 0);
  EXPECT_TRUE(check["different"].empty());
  const RunResult formula = run_scantet({"mesh", "implicit:sphere", "--report", folder / "b.json"});
  ASSERT_EQ(formula.status, 0) << formula.err;
  EXPECT_NE(formula.out.find("handles    not checked"), std::string::npos) << formula.out;
  EXPECT_NE(formula.out.find("components not checked, nor cavities"), std::string::npos) << formula.out;
  const json unknown = read_json(folder / "b.json")["topology"];
  EXPECT_TRUE(unknown["handle_check"].is_null());
  EXPECT_TRUE(unknown["expected"].is_null());
}

// Reports alone depend on it.
TEST(ReportJob, WaveSpeedLeavesTheMeshFileAsItIs) {
  const TestFolder folder;
  for (const std::string speed : {"100", "5000"}) {
    const RunResult run = run_scantet({"mesh", sample("sphere.nrrd"), "--level", "127.5", "--size", "6", "--wave-speed",
                                       speed, "-o", folder / (speed + ".vtu")});
    ASSERT_EQ(run.status, 0) << run.err;
  }
  EXPECT_TRUE(read_bytes(folder / "100.vtu") == read_bytes(folder / "5000.vtu"));
}

}  // namespace
}  // namespace scantet
