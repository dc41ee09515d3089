// Choosing among the components of a scan, from the command line to the report.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "read_json.h"
#include "run_process.h"

namespace scantet {
namespace {

using nlohmann::json;

// Two hundred islands of one to three voxels of 1 mm³.
std::vector<std::string> islands(const std::string& command, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{command, sample("islands.nii.gz"), "--level", "60"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(Components, LargestAreMeshedAndTheOthersListed) {
  const TestFolder folder;
  const RunResult run =
      run_scantet(islands("mesh", {"--size", "1", "--components", "5", "--report", "a.json", "--report", "a.html"}),
                  {folder.path()});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("dropped    195 of 200 components, the largest of them 3 mm"), std::string::npos) << run.out;
  const json report = read_json(folder / "a.json");
  EXPECT_EQ(report["topology"]["components"], 5);
  EXPECT_EQ(report["topology"]["expected"]["components"], 5) << "the audit knows of no others";
  EXPECT_EQ(report["audit"]["passed"], true);
  EXPECT_EQ(report["components"]["found"], 200);
  const json& dropped = report["components"]["dropped"];
  EXPECT_EQ(dropped["count"], 195);
  ASSERT_EQ(dropped["largest"].size(), 10U);
  EXPECT_EQ(dropped["largest"][0]["volume_mm3"], 3);
  EXPECT_EQ(dropped["largest"][0]["witness_mm"].size(), 3U);
  EXPECT_EQ(dropped["largest"][0]["region"], 1);
  EXPECT_GT(dropped["volume_mm3"].get<double>(), 195);
  EXPECT_EQ(report["options"]["components"], 5);
  EXPECT_NE(read_bytes(folder / "a.html").find("\"found\":200"), std::string::npos);
}

TEST(Components, OfALeastVolumeAreKept) {
  const json all = json::parse(run_scantet(islands("info", {"--json"})).out);
  EXPECT_FALSE(all.contains("dropped"));
  const json threes = json::parse(run_scantet(islands("info", {"--json", "--min-component", "3"})).out);
  const auto kept = threes["components"]["components"].get<int>();
  EXPECT_GT(kept, 20);
  EXPECT_LT(kept, 180);
  EXPECT_EQ(threes["dropped"]["found"], 200);
  EXPECT_EQ(threes["dropped"]["components"], 200 - kept);
  EXPECT_EQ(threes["dropped"]["largest_mm3"][0], 2);
  EXPECT_EQ(threes["values"], all["values"]) << "the values are those of the file";
  const json both =
      json::parse(run_scantet(islands("info", {"--json", "--min-component", "3", "--components", "7"})).out);
  EXPECT_EQ(both["components"]["components"], 7);
  const json none = json::parse(run_scantet(islands("info", {"--json", "--min-component", "1"})).out);
  EXPECT_EQ(none["components"], all["components"]);
  EXPECT_EQ(none["dropped"]["components"], 0);
}

// 12³ voxels of 0 around a block of 50, in which blocks of 4³ and 2³ voxels have these values.
std::string blocks(int larger, int smaller) {
  std::string file = "NRRD0004\ntype: unsigned char\ndimension: 3\nsizes: 12 12 12\nencoding: raw\nspacings: 1 1 1\n\n";
  for (int n = 0; n < 12 * 12 * 12; ++n) {
    const std::array<int, 3> p{n % 12, n / 12 % 12, n / 144};
    const auto all_in = [&](int low, int high) {
      return std::all_of(p.begin(), p.end(), [&](int x) { return x >= low && x <= high; });
    };
    file += static_cast<char>(all_in(2, 5) ? larger : all_in(8, 9) ? smaller : all_in(1, 10) ? 50 : 0);
  }
  return file;
}

TEST(Components, OfEachRegionAreChosen) {
  const TestFolder folder;
  write_bytes(folder / "a.nrrd", blocks(90, 90));
  const std::vector<std::string> levels{"a.nrrd", "--level", "30", "--level", "70", "--components", "largest"};
  std::vector<std::string> mesh{"mesh", "--size", "1", "--report", "a.json"};
  mesh.insert(mesh.end(), levels.begin(), levels.end());
  const RunResult run = run_scantet(mesh, {folder.path()});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("dropped    1 of 3 components (1 of region 2)"), std::string::npos) << run.out;
  const json report = read_json(folder / "a.json");
  EXPECT_EQ(report["topology"]["components"], 2) << "one of each region";
  EXPECT_EQ(report["components"]["dropped"]["largest"][0]["region"], 2);
  EXPECT_EQ(report["components"]["dropped"]["largest"][0]["volume_mm3"], 8);
  std::vector<std::string> about{"info", "--json"};
  about.insert(about.end(), levels.begin(), levels.end());
  const json info = json::parse(run_scantet(about, {folder.path()}).out);
  EXPECT_EQ(info["components_2"]["components"], 1);
  EXPECT_EQ(info["dropped"]["region_1"], 0);
  EXPECT_EQ(info["dropped"]["region_2"], 1);
}

TEST(Components, OfALeastVolumeLeaveCavitiesAndSaySo) {
  const TestFolder folder;
  write_bytes(folder / "a.nrrd", blocks(0, 0));
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"a.nrrd", "--level", "30", "--min-component", "20"});
    return run_scantet(more, {folder.path()});
  };
  const RunResult run = with({"mesh", "--size", "1"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("--min-component 20 leaves out components, not cavities: 1 cavity smaller than that stays, of "
                         "8 mm^3"),
            std::string::npos)
      << run.err;
  const json dropped = json::parse(with({"info", "--json"}).out)["dropped"];
  EXPECT_EQ(dropped["small_cavities"], 1) << "of two";
  EXPECT_EQ(dropped["smallest_cavity_mm3"], 8);
}

TEST(Components, CavitiesAreFilledWhereAsked) {
  const TestFolder folder;
  write_bytes(folder / "a.nrrd", blocks(0, 0));
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"a.nrrd", "--level", "30", "--fill-cavities", "20"});
    return run_scantet(more, {folder.path()});
  };
  const RunResult run = with({"mesh", "--size", "1", "--report", "a.json"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("--fill-cavities 20 fills 1 cavity, of 8 mm^3; it is not there for the audit either"),
            std::string::npos)
      << run.err;
  const json report = read_json(folder / "a.json");
  EXPECT_EQ(report["topology"]["cavities"], 1);
  EXPECT_EQ(report["topology"]["expected"]["cavities"], 1);
  EXPECT_EQ(report["options"]["fill-cavities"], 20);
  EXPECT_FALSE(report.contains("components")) << "nothing may be dropped";
  const json info = json::parse(with({"info", "--json"}).out);
  EXPECT_EQ(info["filled"]["cavities"], 1);
  EXPECT_EQ(info["filled"]["volume_mm3"], 8);
  EXPECT_EQ(info["components"]["cavities"], 1);
}

TEST(Components, AllIsTheDefaultAndAnyNumberOfThreadsGivesTheSameBytes) {
  const TestFolder folder;
  const auto mesh_with = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--size", "1", "--no-theory", "-o", "a.stl"});
    const RunResult run = run_scantet(islands("mesh", more), {folder.path()});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out.find("dropped") != std::string::npos, more[1] != "all");
    return read_bytes(folder / "a.stl");
  };
  const std::string all = mesh_with({"--components", "all"});
  EXPECT_EQ(mesh_with({"--components", "200"}), all) << "nothing is dropped";
  const std::string some = mesh_with({"--components", "40", "--threads", "1"});
  EXPECT_NE(some, all);
  EXPECT_EQ(mesh_with({"--components", "40", "--threads", "3"}), some);
}

TEST(Components, OptionsThatMakeNoSenseAreRefused) {
  const auto expect = [](const std::vector<std::string>& options, int status, const std::string& part) {
    const TestFolder folder;
    std::vector<std::string> arguments = islands("mesh", {"-o", folder / "a.vtu"});
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult run = run_scantet(arguments);
    EXPECT_EQ(run.status, status) << run.err;
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
    EXPECT_TRUE(folder.names().empty());
  };
  expect({"--components", "0"}, 2, "--components: 0 is not a number of components: it must be at least 1");
  expect({"--components", "2.5"}, 2, "--components: 2.5 is not a number of components: it must be a whole number");
  expect({"--components", "larges"}, 2, "did you mean largest?");
  expect({"--min-component", "-1"}, 2, "--min-component: -1 is not a volume in mm^3");
  expect({"--min-component", "0"}, 2, "--min-component: 0 is not a volume in mm^3: it must be greater than 0");
  expect({"--min-component", "3.5"}, 3, "--min-component 3.5: nothing is left, for the largest of the 200 components");
  expect({"--components", "1", "--level", "1e4"}, 3, "level 10000 leaves nothing inside");
}

TEST(Components, AreNoOptionOfOtherInputs) {
  const TestFolder folder;
  ASSERT_EQ(run_scantet({"convert", sample("islands.nii.gz"), folder / "a.vdb"}).status, 0);
  const RunResult run = run_scantet({"mesh", folder / "a.vdb", "--level", "60", "--components", "largest"});
  EXPECT_EQ(run.status, 2) << run.err;
  EXPECT_NE(run.err.find("--components"), std::string::npos) << run.err;
}

// A real scan, where there: Debian's mricron-data. 58 components, nearly all of them noise.
TEST(Components, LargestOfABrain) {
  const std::string brain = "/usr/share/mricron/templates/ch2bet.nii.gz";
  if (!std::filesystem::exists(brain)) GTEST_SKIP() << brain << " is not installed";
  const TestFolder folder;
  const RunResult run = run_scantet(
      {"mesh", brain, "--level", "20", "--size", "3", "--components", "largest", "--report", folder / "a.json"});
  const json report = read_json(folder / "a.json");
  const json& handles = report["topology"]["handle_check"];
  std::set<std::string> wrong;  // the brain has sheets that are much thinner than the size
  if (!handles["different"].empty()) wrong.insert("audit.handles");
  if (report["distance"]["to_mesh"]["lower_mm"].get<double>() > 2 * 3) wrong.insert("audit.lost_part");
  std::set<std::string> told;
  for (const json& finding : report["audit"]["findings"]) told.insert(finding["code"]);
  EXPECT_EQ(told, wrong);
  EXPECT_EQ(run.status, wrong.empty() ? 0 : 4) << run.err;  // nothing else is wrong
  EXPECT_EQ(report["topology"]["components"], 1);
  EXPECT_EQ(report["components"]["found"], 58);
  EXPECT_EQ(report["components"]["dropped"]["count"], 57);
  EXPECT_NEAR(report["mesh"]["volume_mm3"].get<double>(), 1.7555e6, 2e3);
}

}  // namespace
}  // namespace scantet
