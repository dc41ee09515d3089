// Ctrl-C and the progress line.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "run_process.h"

namespace scantet {
namespace {

// Minutes of work, were it not interrupted.
std::vector<std::string> long_job() {
  return {"mesh", sample("torus.nrrd"), "--level", "300.5", "--size", "0.15", "-o", "out.vtu", "--report", "out.json"};
}

TEST(Interrupt, FirstStopsCleanly) {
  for (const char* stage : {"sample", "refine R"}) {
    const TestFolder folder;
    RunOptions options;
    options.folder = folder.path();
    options.terminal = true;
    options.interrupt_at = stage;
    const RunResult run = run_scantet(long_job(), options);
    EXPECT_EQ(run.status, 130) << run.err;
    EXPECT_NE(run.err.find("scantet: cancelled"), std::string::npos) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_TRUE(folder.names().empty());
  }
}

TEST(Interrupt, EndsVerification) {
  const TestFolder folder;
  const std::vector<std::string> scan{sample("tanglecube.nrrd"), "--level", "0.1"};
  std::vector<std::string> mesh{"mesh", scan[0], scan[1], scan[2], "--size", "1", "-o", "a.vtu", "--quiet"};
  RunOptions options;
  options.folder = folder.path();
  ASSERT_EQ(run_scantet(mesh, options).status, 0);
  options.terminal = true;
  options.interrupt_at = "collar";
  const RunResult run =
      run_scantet({"verify", "a.vtu", "--against", scan[0], scan[1], scan[2], "--json", "a.cert.json"}, options);
  EXPECT_EQ(run.status, 130) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.vtu"});
  mesh.insert(mesh.end() - 3, "--certify");
  mesh.back() = "--no-theory";
  mesh[mesh.size() - 2] = "b.vtu";
  const RunResult both = run_scantet(mesh, options);
  EXPECT_EQ(both.status, 130) << both.err;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.vtu"});
}

TEST(Interrupt, SecondEndsAtOnce) {
  const TestFolder folder;
  RunOptions options;
  options.folder = folder.path();
  options.terminal = true;
  options.interrupt_at = "refine R";
  options.interrupts = 2;
  const RunResult run = run_scantet(long_job(), options);
  EXPECT_EQ(run.status, 130);
  EXPECT_TRUE(folder.names().empty());
}

TEST(Interrupt, EndsAWaitForAFile) {
  const TestFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  RunOptions options;
  options.folder = folder.path();
  options.interrupt_at = "about to wait";
  options.timeout_s = 20;
  const RunResult run = run_scantet({"mesh", "waits:pipe", "--plugin", SCANTET_STUB_WAITS}, options);
  EXPECT_EQ(run.status, 130) << run.err;
  EXPECT_NE(run.err.find("scantet: cancelled"), std::string::npos) << run.err;
}

TEST(ProgressOutput, TerminalShowsTheRuleAndIsClearedAtTheEnd) {
  RunOptions options;
  options.terminal = true;
  const RunResult run =
      run_scantet({"mesh", sample("sphere.nrrd"), "--level", "127.5", "--size", "1", "--no-theory"}, options);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("refine R"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("vertices"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("pending"), std::string::npos) << run.err;
  ASSERT_GE(run.err.size(), 4u);
  EXPECT_EQ(run.err.substr(run.err.size() - 4), "\r\033[K");
  EXPECT_EQ(run.err.find('\n'), std::string::npos) << "one line only";
}

TEST(ProgressOutput, PipeStaysQuiet) {
  const RunResult run = run_scantet({"mesh", sample("sphere.nrrd"), "--level", "127.5", "--size", "2", "--no-theory"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_FALSE(run.out.empty());
}

TEST(ProgressOutput, QuietSaysNothingAtAll) {
  RunOptions options;
  options.terminal = true;
  const RunResult run =
      run_scantet({"mesh", sample("sphere.nrrd"), "--level", "127.5", "--size", "2", "--quiet"}, options);
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.out, "");
}

}  // namespace
}  // namespace scantet
