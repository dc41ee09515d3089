// What bounds a run: vertices, time, memory, and a signal, whatever it is busy with.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "read_json.h"
#include "run_process.h"

namespace scantet {
namespace {

// Four corners of a tetrahedron, one of them 1e5 mm away.
const char* const kSpike =
    "v 0 0 0\nv 10 0 0\nv 0 10 0\nv 3 100000 10\n"
    "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

const char* const kCube =
    "v 0 0 0\nv 10 0 0\nv 0 10 0\nv 10 10 0\nv 0 0 10\nv 10 0 10\nv 0 10 10\nv 10 10 10\n"
    "f 1 3 2\nf 2 3 4\nf 5 6 7\nf 6 8 7\nf 1 2 5\nf 2 6 5\nf 3 7 4\nf 4 7 8\nf 1 5 3\nf 3 5 7\nf 2 4 6\nf 4 8 6\n";

RunOptions within(const TestFolder& folder, double seconds) {
  RunOptions options;
  options.folder = folder.path();
  options.timeout_s = seconds;
  return options;
}

TEST(Budget, SurfacesThatTakeMoreVerticesThanAllowedAreRefusedSoon) {
  const TestFolder folder;
  write_bytes(folder / "spike.obj", kSpike);
  write_bytes(folder / "cube.obj", kCube);
  const std::vector<std::vector<std::string>> jobs{{"spike.obj", "--size", "5"}, {"cube.obj", "--size", "auto"}};
  for (const std::vector<std::string>& job : jobs) {
    std::vector<std::string> arguments{"mesh", "--max-vertices", "2000", "-o", "out.vtu"};
    arguments.insert(arguments.end(), job.begin(), job.end());
    const RunResult run = run_scantet(arguments, within(folder, 60));
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_NE(run.err.find("--max-vertices"), std::string::npos) << run.err;
    // Told by a first look, which takes a hundredth of the time that the sizes of the whole boundary do.
    EXPECT_EQ(run.err.find("vertices or more") != std::string::npos, job.back() == "auto") << run.err;
  }
}

TEST(Budget, ImprovementOfWhatALimitLeftDoesNotGoOnForEver) {
  const TestFolder folder;
  write_bytes(folder / "cube.obj", kCube);
  const RunResult run = run_scantet(
      {"mesh", "cube.obj", "--size", "auto", "--max-vertices", "35000", "-o", "out.vtu", "--report", "r.json"},
      within(folder, 60));
  EXPECT_EQ(run.status, 4) << run.err;
  EXPECT_EQ(read_json(folder / "r.json")["stop"], "limit");
}

TEST(Budget, TimeEndsARunWithTheMeshByThenOrNone) {
  const TestFolder folder;
  // Cell radii that refinement never reaches: it goes on until something ends it.
  const RunResult run =
      run_scantet({"mesh", sample("sphere.nrrd"), "--level", "127.5", "--size", "3", "--cell-radius-edge", "0.7",
                   "--small-slack", "1", "--max-time", "2s", "-o", "out.vtu", "--report", "r.json"},
                  within(folder, 60));
  EXPECT_EQ(run.status, 4) << run.err;
  EXPECT_NE(run.err.find("unmet: --max-time 2s was over while busy with 'refine R3"), std::string::npos) << run.err;
  EXPECT_EQ(read_json(folder / "r.json")["stop"], "time");
  EXPECT_EQ(run_scantet({"report", "out.vtu"}, within(folder, 60)).err.find("error"), std::string::npos);

  const TestFolder empty;
  const RunResult early = run_scantet({"mesh", sample("torus.nrrd"), "--level", "300.5", "--size", "0.15", "--max-time",
                                       "0.5", "-o", "out.vtu", "--report", "r.json"},
                                      within(empty, 30));
  EXPECT_EQ(early.status, 4) << early.err;
  EXPECT_NE(early.err.find("there is no mesh yet, and nothing is written"), std::string::npos) << early.err;
  EXPECT_TRUE(empty.names().empty());
}

TEST(Budget, MemoryEndsARun) {
  const TestFolder folder;
  const RunResult run =
      run_scantet({"mesh", sample("sphere.nrrd"), "--level", "127.5", "--size", "3", "--cell-radius-edge", "0.7",
                   "--small-slack", "1", "--max-memory", "200M", "-o", "out.vtu"},
                  within(folder, 100));
  EXPECT_EQ(run.status, 4) << run.err;
  EXPECT_NE(run.err.find("unmet: --max-memory 200M was over"), std::string::npos) << run.err;
}

// The estimate counts the whole job: at this size the mesh takes 19 GB.
TEST(Budget, SizeOfALargeScanThatTakesTooMuchMemoryIsRefusedAtOnce) {
  constexpr int kSide = 200;
  constexpr double kRadius = 90;
  const TestFolder folder;
  std::string voxels =
      "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: 200 200 200\n"
      "space directions: (1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\nencoding: raw\n"
      "space origin: (0,0,0)\n\n";
  const auto off = [&](int n) { return std::pow(n - 0.5 * (kSide - 1), 2); };
  for (int n = 0; n < kSide * kSide * kSide; ++n) {
    const double square = off(n % kSide) + off(n / kSide % kSide) + off(n / kSide / kSide);
    voxels += square < kRadius * kRadius ? '\xff' : '\0';
  }
  write_bytes(folder / "ball.nrrd", voxels);
  RunOptions options = within(folder, 60);
  options.memory_limit = std::uint64_t{1} << 30;  // what a look may take, and no mesh
  for (const char* size : {"0.4", "0.2"}) {
    const RunResult run = run_scantet(
        {"mesh", "ball.nrrd", "--level", "127.5", "--size", size, "--max-memory", "8G", "-o", "out.vtu"}, options);
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_NE(run.err.find("--max-memory is 8G"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("choose a larger size"), std::string::npos) << run.err;
  }
  EXPECT_EQ(folder.names().size(), 1U);
}

TEST(Budget, LackOfMemoryHasAStatusOfItsOwn) {
  const TestFolder folder;
  RunOptions options = within(folder, 100);
  options.memory_limit = std::uint64_t{900} << 20;
  const RunResult run = run_scantet(
      {"mesh", sample("torus.nrrd"), "--level", "300.5", "--size", "0.1", "--max-memory", "100G", "-o", "out.vtu"},
      options);
  EXPECT_EQ(run.status, 6) << run.err;
  EXPECT_NE(run.err.find("out of memory"), std::string::npos) << run.err;
  EXPECT_TRUE(folder.names().empty());
}

TEST(Budget, WhatIsReadIsNeverWritten) {
  const TestFolder folder;
  const std::string config = R"({"level": 127.5, "size": 3})";
  write_bytes(folder / "q.json", config);
  std::filesystem::create_symlink("q.json", folder / "link.json");
  std::filesystem::create_hard_link(folder / "q.json", folder / "hard.json");
  for (const char* report : {"q.json", "./q.json", "link.json", "hard.json"}) {
    const RunResult run =
        run_scantet({"mesh", sample("sphere.nrrd"), "--config", "q.json", "--report", report}, within(folder, 60));
    EXPECT_EQ(run.status, 2) << report << run.err;
    EXPECT_NE(run.err.find("q.json"), std::string::npos) << run.err;
    EXPECT_EQ(read_bytes(folder / "q.json"), config) << report;
  }
}

TEST(Budget, TablesMaterialsAndWhatAFolderHoldsAreNeverWritten) {
  const TestFolder folder;
  const auto stays = [&](const std::vector<std::string>& words, const std::string& file) {
    const std::string before = read_bytes(folder / file);
    const RunResult run = run_scantet(words, within(folder, 60));
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_NE(run.err.find("also read"), std::string::npos) << run.err;
    EXPECT_EQ(read_bytes(folder / file), before) << file;
  };
  const std::string labels = sample("labels_octants.nrrd");
  write_bytes(folder / "t.json", "1 first\n");
  stays({"mesh", labels, "--labels", "t.json", "--report", "t.json"}, "t.json");
  stays({"mesh", labels, "--label-names", "t.json", "--plan", "--report", "t.json"}, "t.json");
  write_bytes(folder / "m.json",
              R"({"places": [{"name": "a", "where": "z > 0", "youngs_modulus_mpa": 1, "poissons_ratio": 0.3}]})");
  stays({"mesh", sample("sphere.nrrd"), "--level", "127.5", "--materials", "m.json", "--plan", "--report", "m.json"},
        "m.json");
  write_bytes(folder / "v.json", std::string(8, '\1'));
  write_bytes(folder / "f.nhdr",
              "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\ndata file: v.json\n");
  stays({"mesh", sample("sphere.nrrd"), "--level", "127.5", "--field", "g=f.nhdr", "--plan", "--report", "v.json"},
        "v.json");
  std::filesystem::create_directory(folder / "x.stls");
  write_bytes(folder / "x.stls/a.off", "OFF\n4 4 0\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  stays({"mesh", "x.stls/a.off", "--size", "2", "-o", "x.stls"}, "x.stls/a.off");
}

TEST(Budget, NumbersTooLargeForAConfigurationAreWrongUse) {
  const TestFolder folder;
  write_bytes(folder / "c.json", "{\"level\":1e400}");
  const RunResult run = run_scantet({"mesh", sample("sphere.nrrd"), "--config", "c.json"}, within(folder, 60));
  EXPECT_EQ(run.status, 2) << run.err;
  EXPECT_NE(run.err.find("c.json: "), std::string::npos) << run.err;
}

}  // namespace
}  // namespace scantet
