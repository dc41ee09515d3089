// Scans as sparse grids, from the command line: convert, info, mesh.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "read_json.h"
#include "run_process.h"

namespace scantet {
namespace {

using nlohmann::json;

TEST(Vdb, AScanAndItsGridGiveTheSameMesh) {
  const TestFolder folder;
  const std::vector<std::pair<std::string, std::vector<std::string>>> jobs{
      {"ellipsoid_oblique.nrrd", {"--level", "60"}},
      {"bar.mha", {"--level", "0.5"}},
      {"sphere.nrrd", {"--level", "60", "--level", "160"}}};
  for (const auto& [name, levels] : jobs) {
    const RunResult converted = run_scantet({"convert", sample(name), folder / "a.vdb"});
    ASSERT_EQ(converted.status, 0) << converted.err;
    json reports[2];
    std::string surfaces[2];
    for (const std::size_t n : {0, 1}) {
      std::vector<std::string> words{"mesh",      n == 0 ? sample(name) : folder / "a.vdb",
                                     "-o",        folder / "a.stl",
                                     "--report",  folder / "a.json",
                                     "--size",    "2",
                                     "--threads", n == 0 ? "1" : "2"};
      words.insert(words.end(), levels.begin(), levels.end());
      const RunResult run = run_scantet(words);
      ASSERT_EQ(run.status, 0) << name << run.err;
      reports[n] = read_json(folder / "a.json");
      surfaces[n] = read_bytes(folder / "a.stl").substr(80);  // behind the header, which names the job
    }
    const double volume = reports[0]["mesh"]["volume_mm3"];
    EXPECT_NEAR(reports[1]["mesh"]["volume_mm3"], volume, 1e-6 * volume) << name;
    EXPECT_EQ(reports[1]["mesh"]["regions"].size(), levels.size() / 2) << name;
    for (const char* key : {"components", "cavities", "euler", "manifold"}) {
      EXPECT_EQ(reports[0]["topology"][key], reports[1]["topology"][key]) << name << key;
    }
    EXPECT_TRUE(surfaces[0] == surfaces[1]) << name;
  }
}

TEST(Vdb, InfoTellsOfTheGrid) {
  const TestFolder folder;
  ASSERT_EQ(run_scantet({"convert", sample("bar.mha"), folder / "bar.vdb", "--outside", "-3"}).status, 0);
  const RunResult run = run_scantet({"info", folder / "bar.vdb", "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const json scan = json::parse(run_scantet({"info", sample("bar.mha"), "--json"}).out);
  const json grid = json::parse(run.out)["density"];
  EXPECT_EQ(grid["type"], "float");
  EXPECT_EQ(grid["background"], -3.0);
  EXPECT_EQ(grid["max"], scan["values"]["max"]);
  EXPECT_EQ(grid["size"], scan["image"]["size"]);
  EXPECT_EQ(grid["origin_mm"], scan["image"]["origin_mm"]);
  EXPECT_EQ(grid["column_k_mm"], scan["image"]["column_k_mm"]);
}

void expect_error(const std::vector<std::string>& arguments, int status, const std::vector<std::string>& says,
                  const TestFolder& folder) {
  const RunResult run = run_scantet(arguments, {folder.path()});
  EXPECT_EQ(run.status, status) << run.err;
  for (const std::string& part : says) EXPECT_NE(run.err.find(part), std::string::npos) << part << ": " << run.err;
}

TEST(Vdb, MistakesAreNamed) {
  const TestFolder folder;
  ASSERT_EQ(run_scantet({"convert", sample("sphere.nrrd"), folder / "a.vdb"}).status, 0);
  expect_error({"mesh", "a.vdb", "-o", "a.vtu"}, 2, {"--level is missing", "density"}, folder);
  expect_error({"mesh", "a.vdb", "--level", "60", "--grid", "heat", "-o", "a.vtu"}, 2, {"heat", "density"}, folder);
  expect_error({"info", "a.vdb", "--grid", "heat"}, 2, {"heat", "density"}, folder);
  expect_error({"mesh", "a.vdb", "--level", "60", "--inside", "below", "-o", "a.vtu"}, 3, {"background"}, folder);
  expect_error({"mesh", "a.vdb", "--level", "60", "--outside", "0", "-o", "a.vtu"}, 2, {"--outside"}, folder);
  expect_error({"convert", sample("sphere.nrrd"), "b.vdb", "--space", "ras"}, 2, {"--space"}, folder);
  expect_error({"convert", sample("sphere.nrrd"), "b.vdb", "--outside", "1e300"}, 2, {"--outside", "1e+300"}, folder);
  expect_error({"convert", "missing.nrrd", "b.vdb"}, 3, {"missing.nrrd"}, folder);
  expect_error({"convert", sample("sphere.nrrd"), "missing/b.vdb"}, 5, {"missing/b.vdb"}, folder);
  const std::string whole = read_bytes(folder / "a.vdb");
  write_bytes(folder / "cut.vdb", whole.substr(0, whole.size() / 2));
  expect_error({"mesh", "cut.vdb", "--level", "60", "-o", "a.vtu"}, 3, {"cut.vdb", "not complete"}, folder);
  write_bytes(folder / "text.vdb", "no grid");
  expect_error({"info", "text.vdb"}, 3, {"text.vdb", "not a .vdb file"}, folder);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.vdb", "cut.vdb", "text.vdb"}));
}

TEST(Vdb, DamageThatCrashesOpenVdbOrFillsTheMemoryIsAnError) {
  const TestFolder folder;
  for (const std::string name : {"crashes.vdb", "fills_memory.vdb"}) {
    const std::string file = std::string(SCANTET_DAMAGED) + "/" + name;
    expect_error({"mesh", file, "--level", "50", "-o", "a.vtu"}, 3, {name, "damaged"}, folder);
    expect_error({"info", file}, 3, {name, "damaged"}, folder);
  }
  EXPECT_TRUE(folder.names().empty());
}

TEST(Vdb, AFullDiskKeepsTheOldFile) {
  const TestFolder folder;
  write_bytes(folder / "a.vdb", "the old grid");
  RunOptions options;
  options.file_size_limit = 4096;
  const RunResult run = run_scantet({"convert", sample("sphere.nrrd"), folder / "a.vdb"}, options);
  EXPECT_EQ(run.status, 5) << run.err;
  EXPECT_NE(run.err.find("a.vdb"), std::string::npos) << run.err;
  EXPECT_EQ(read_bytes(folder / "a.vdb"), "the old grid");
  EXPECT_EQ(folder.names().size(), 1U);
}

}  // namespace
}  // namespace scantet
