// Formats that are folders, and sizes in places, from the command line.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "meshed.h"

namespace scantet {
namespace {

using nlohmann::json;

TEST(Folders, AreWrittenListedAndReplaced) {
  const TestFolder folder;
  const std::vector<std::string> words{
      "mesh", sample("torus.nrrd"), "--level", "0.5",   "--set", "half=x < 0", "-o",       "a.elmer",
      "-o",   "a.mesh-complete",    "-o",      "a.vtm", "-o",    "a.stls",     "--report", "a.json"};
  for (int times = 0; times < 2; ++times) {  // the second replaces the first
    const RunResult run = run_scantet(words, {folder.path()});
    ASSERT_EQ(run.status, 0) << run.err;
    const json files = read_json(folder / "a.json")["files"];
    std::size_t found = 0;
    for (const json& entry : files) {
      EXPECT_TRUE(std::filesystem::is_regular_file(folder / entry["path"].get<std::string>())) << entry;
      ++found;
    }
    EXPECT_GE(found, 5U + 4 + 5 + 2);
  }
  std::ofstream(folder / "a.elmer/case.sif") << "mine";
  const RunResult refused = run_scantet(words, {folder.path()});
  EXPECT_EQ(refused.status, 5);
  EXPECT_NE(refused.err.find("case.sif"), std::string::npos) << refused.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "a.elmer/case.sif"));
}

TEST(Folders, NothingIsWrittenIntoAnOutput) {
  const TestFolder folder;
  std::filesystem::create_directory(folder / "a.elmer");
  const RunResult run = run_scantet(
      {"mesh", sample("torus.nrrd"), "--level", "0.5", "-o", "a.elmer", "-o", "a.elmer/b.vtu"}, {folder.path()});
  EXPECT_EQ(run.status, 2) << run.err;
}

TEST(SizeWhere, MakesThePlaceFiner) {
  const Meshed coarse = mesh_torus_at("0.5", {"--size", "3"});
  const Meshed finer = mesh_torus_at("0.5", {"--size", "3", "--size-where", "x > 0=1"});
  ASSERT_EQ(finer.result.status, 0) << finer.result.err;
  EXPECT_GT(finer.report["mesh"]["tets"].get<int>(), 2 * coarse.report["mesh"]["tets"].get<int>());
  const Meshed wrong = mesh_torus_at("0.5", {"--size-where", "patch(wall)=1"});
  EXPECT_EQ(wrong.result.status, 2);
  EXPECT_NE(wrong.result.err.find("--size-where"), std::string::npos) << wrong.result.err;
}

}  // namespace
}  // namespace scantet
