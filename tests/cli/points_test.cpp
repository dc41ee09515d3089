// Point sets from the command line.
#include <gtest/gtest.h>

#include <algorithm>

#include "plugins/point_files.h"
#include "run_process.h"

namespace scantet {
namespace {

TEST(Points, AreMeshedTheSameByAnyNumberOfThreads) {
  const TestFolder folder;
  write_bytes(folder / "torus.xyz", torus_cloud(4, 1.5, 2000).without_normals().xyz());
  for (const std::string threads : {"1", "2"}) {
    const RunResult run =
        run_scantet({"mesh", "torus.xyz", "--threads", threads, "-o", threads + ".vtu"}, {folder.path()});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("Euler number 0 (1"), std::string::npos) << run.out;  // handle
    EXPECT_NE(run.err.find("2 x the least size"), std::string::npos) << run.err;
  }
  EXPECT_EQ(read_bytes(folder / "1.vtu"), read_bytes(folder / "2.vtu"));
}

TEST(Points, TooSparseForTheSizeAreRefusedWithOneThatWillDo) {
  const TestFolder folder;
  write_bytes(folder / "ball.ply", ball_cloud({0, 0, 0}, 5, 1000).binary_ply());
  const RunResult run = run_scantet({"mesh", "ball.ply", "--size", "0.1", "-o", "a.vtu"}, {folder.path()});
  EXPECT_EQ(run.status, 2) << run.err;
  EXPECT_NE(run.err.find("--size: 0.1 mm is finer than ball.ply can tell"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("mm apart on average"), std::string::npos) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 2) << "an error and a hint: " << run.err;
  const std::string before = "choose --size ";
  const std::size_t at = run.err.find(before);
  ASSERT_NE(at, std::string::npos) << run.err;
  const std::string size =
      run.err.substr(at + before.size(), run.err.find(' ', at + before.size()) - at - before.size());
  EXPECT_EQ(run_scantet({"mesh", "ball.ply", "--size", size, "-o", "a.vtu"}, {folder.path()}).status, 0) << size;
}

TEST(Points, ACoarseGridTellsLess) {
  const TestFolder folder;
  write_bytes(folder / "ball.xyz", ball_cloud({0, 0, 0}, 5, 1000).xyz());
  const RunResult run =
      run_scantet({"mesh", "ball.xyz", "--grid-step", "0.5", "--size", "0.9", "-o", "a.vtu"}, {folder.path()});
  EXPECT_EQ(run.status, 2) << run.err;
  EXPECT_NE(run.err.find("--grid-step is 0.5 mm"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("choose --size 1 or more"), std::string::npos) << run.err;
}

TEST(Points, InfoSaysHowWellTheSurfaceFits) {
  const TestFolder folder;
  write_bytes(folder / "ball.xyz", ball_cloud({0, 0, 0}, 5, 1000).xyz());
  const RunResult run = run_scantet({"info", "ball.xyz"}, {folder.path()});
  EXPECT_EQ(run.status, 0) << run.err;
  for (const char* part : {"different points", "1000", "given", "median distance", "least size"}) {
    EXPECT_NE(run.out.find(part), std::string::npos) << part << ": " << run.out;
  }
}

TEST(Points, BadFilesEndWithOneMessage) {
  const TestFolder folder;
  write_bytes(folder / "words.xyz", "1 2 3\n4 5 six\n");
  write_bytes(folder / "cut.ply", ball_cloud({0, 0, 0}, 5, 1000).binary_ply().substr(0, 9000));
  write_bytes(folder / "empty.pwn", "");
  for (const std::string file : {"words.xyz", "cut.ply", "empty.pwn"}) {
    for (const std::string command : {"mesh", "info"}) {
      const RunResult run = run_scantet({command, file}, {folder.path()});
      EXPECT_EQ(run.status, 3) << run.err;
      EXPECT_EQ(run.out, "");
      EXPECT_NE(run.err.find(file), std::string::npos) << run.err;
      EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 2) << "an error and a hint: " << run.err;
    }
  }
}

}  // namespace
}  // namespace scantet
