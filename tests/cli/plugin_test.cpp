// Plugins from the command line: those of the plugin folder, and those named with --plugin.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "run_process.h"

namespace scantet {
namespace {

void expect_error(const std::vector<std::string>& arguments, int status, const std::vector<std::string>& says) {
  const TestFolder folder;
  const RunResult run = run_scantet(arguments, {folder.path()});
  EXPECT_EQ(run.status, status) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 2) << "an error and a hint: " << run.err;
  for (const std::string& part : says) EXPECT_NE(run.err.find(part), std::string::npos) << part << ": " << run.err;
  EXPECT_TRUE(folder.names().empty());
}

TEST(Plugins, ThePluginFolderIsLoaded) {
  const TestFolder folder;
  const RunResult run = run_scantet({"mesh", "implicit:x^4-5*x^2+y^4-5*y^2+z^4-5*z^2+11.8", "--bounds",
                                     "-3,-3,-3,3,3,3", "--size", "0.4", "-o", "cube.vtu", "-o", "cube.stl"},
                                    {folder.path()});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("Euler number -8"), std::string::npos) << "genus five: " << run.out;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"cube.stl", "cube.vtu"}));
}

TEST(Plugins, WhatCannotBeComputedWithIsRefused) {
  expect_error({"mesh", "implicit:(x-1e15)^2+y^2+z^2-1", "--bounds", "999999999999998,-2,-2,1000000000000002,2,2"}, 3,
               {"too few digits", "origin"});
  expect_error({"mesh", "implicit:x^2+y^2+z^2-1e-50", "--bounds=-2e-25,-2e-25,-2e-25,2e-25,2e-25,2e-25"}, 3,
               {"too small", "1e-15"});
  expect_error({"mesh", "implicit:x^2+y^2+z^2-1e50", "--bounds=-2e25,-2e25,-2e25,2e25,2e25,2e25"}, 3,
               {"too large", "1e15"});
}

TEST(Plugins, FormulaAndBoundsAreChecked) {
  expect_error({"mesh", "implicit:x^2+yy", "-o", "a.vtu"}, 3, {"character 5", "\"yy\" is not known"});
  expect_error({"mesh", "implicit:x^2+y^2+z^2-1", "-o", "a.vtu"}, 2, {"--bounds is missing"});
  expect_error({"mesh", "implicit:sphere", "--bounds", "-1,-1,-1,1,1,1", "-o", "a.vtu"}, 3,
               {"x = -1", "enlarge --bounds"});
  expect_error({"info", "implicit:sphere", "--bounds", "-1,-1"}, 2, {"--bounds", "-1,-1"});
}

/// A cube as OFF, without its last side if `open`.
void write_cube(const std::string& path, bool open) {
  std::ofstream(path) << "OFF\n8 " << (open ? 5 : 6) << " 0\n0 0 0\n8 0 0\n0 8 0\n8 8 0\n0 0 8\n8 0 8\n0 8 8\n8 8 8\n"
                      << "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n"
                      << (open ? "" : "4 1 3 7 5\n");
}

TEST(Plugins, ASurfaceThatIsNotClosedIsRefusedOrRepaired) {
  const TestFolder folder;
  write_cube(folder.path() + "/open.off", true);
  const RunResult refused = run_scantet({"mesh", "open.off", "-o", "a.vtu"}, {folder.path()});
  EXPECT_EQ(refused.status, 3);
  EXPECT_NE(refused.err.find("open.off: the surface is not closed: 4 edges"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("--repair"), std::string::npos) << refused.err;
  const RunResult info = run_scantet({"info", "open.off", "--repair"}, {folder.path()});
  EXPECT_EQ(info.status, 0) << info.err;
  EXPECT_NE(info.out.find("filled 1 hole, the largest of 4 edges"), std::string::npos) << info.out;
  const RunResult mesh = run_scantet({"mesh", "open.off", "--repair", "--size", "2", "-o", "a.vtu"}, {folder.path()});
  EXPECT_EQ(mesh.status, 0) << mesh.err;
  EXPECT_NE(mesh.out.find("Euler number 2"), std::string::npos) << mesh.out;
}

TEST(Plugins, OneNamedIsUsedByEveryCommandThatOpensInputs) {
  const TestFolder folder;
  const RunResult mesh =
      run_scantet({"mesh", "good:", "--plugin", SCANTET_STUB_GOOD, "-o", "ball.vtu"}, {folder.path()});
  EXPECT_EQ(mesh.status, 0) << mesh.err;
  EXPECT_EQ(run_scantet({"info", "good:", std::string("--plugin=") + SCANTET_STUB_GOOD}).status, 0);
  const RunResult list = run_scantet({"plugins", "--plugin", SCANTET_STUB_GOOD, "--plugin", SCANTET_STUB_LIAR});
  EXPECT_EQ(list.status, 0) << list.err;
  for (const char* part : {"good: good:, a ball", SCANTET_STUB_GOOD, SCANTET_STUB_LIAR, "built in", "--bounds"}) {
    EXPECT_NE(list.out.find(part), std::string::npos) << part << ": " << list.out;
  }
  EXPECT_EQ(run_scantet({"mesh", "good:", "-o", "a.vtu"}, {folder.path()}).status, 3) << "not loaded";
}

TEST(Plugins, OneNamedThatCannotBeLoadedIsWrongUse) {
  for (const std::string command : {"mesh", "info"}) {
    expect_error({command, "a.nrrd", "--plugin", "absent.so"}, 2, {"absent.so", "no such file"});
  }
  expect_error({"plugins", "--plugin", SCANTET_STUB_CRASHES}, 2, {SCANTET_STUB_CRASHES, "Segmentation fault"});
  expect_error({"plugins", "--plugin", SCANTET_STUB_GOOD, "--plugin", SCANTET_STUB_GOOD}, 2,
               {SCANTET_STUB_GOOD, "there already"});
  expect_error({"report", "a.vtu", "--plugin", SCANTET_STUB_GOOD}, 2, {"unknown option --plugin"});
}

TEST(Plugins, ACrashOfOneEndsInAMessage) {
  const TestFolder folder;
  const RunResult run =
      run_scantet({"mesh", "opened:", "--plugin", SCANTET_STUB_CRASHES_WHEN_OPENED, "-o", "a.vtu"}, {folder.path()});
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_NE(run.err.find("crashed: segmentation fault, perhaps in a plugin: "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find(SCANTET_STUB_CRASHES_WHEN_OPENED), std::string::npos) << run.err;
  EXPECT_TRUE(folder.names().empty());
}

TEST(Plugins, OneThatLiesAboutItsBoundsIsFoundOut) {
  expect_error({"mesh", "liar:cuts", "--plugin", SCANTET_STUB_LIAR, "-o", "a.vtu"}, 3,
               {"liar:cuts", "its box", "liar"});
}

TEST(Plugins, NoOutputReplacesOne) {
  const TestFolder folder;
  const std::string plugin = folder / "p.so";
  std::filesystem::copy_file(SCANTET_STUB_GOOD, plugin);
  const std::string before = read_bytes(plugin);
  for (const char* link : {"p.vdb", "p.vtu", "p.msh", "p.json"}) std::filesystem::create_symlink("p.so", folder / link);
  const RunOptions here{folder.path()};
  ASSERT_EQ(run_scantet({"mesh", "good:", "--plugin", "p.so", "-o", "a.vtu"}, here).status, 0);
  const std::string scan = sample("sphere.nrrd");
  for (const std::vector<std::string>& words : {
           std::vector<std::string>{"convert", scan, "p.vdb", "--plugin", "./p.so"},
           {"convert", "a.vtu", "p.msh", "--plugin", "./p.so"},
           {"mesh", "good:", "--plugin", "p.so", "-o", "p.vtu"},
           {"mesh", "good:", "--plugin", "p.so", "-o", "b.vtu", "--report", "p.json"},
       }) {
    const RunResult run = run_scantet(words, here);
    EXPECT_EQ(run.status, 2) << words[2] << run.err;
    EXPECT_NE(run.err.find("this output is also read"), std::string::npos) << words[2] << run.err;
    EXPECT_EQ(read_bytes(plugin), before) << words[2];
  }
}

TEST(Plugins, AConfigurationCannotLoadThem) {
  const TestFolder folder;
  write_bytes(folder / "job.json", R"({"plugin": ["a.so"]})");
  const RunResult run = run_scantet({"mesh", sample("sphere.nrrd"), "--config", "job.json"}, {folder.path()});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("job.json: \"plugin\""), std::string::npos) << run.err;
}

}  // namespace
}  // namespace scantet
