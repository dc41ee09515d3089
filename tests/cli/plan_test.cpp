// What is to be expected of a mesh, and sizes chosen by it, from the command line to the report.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "read_json.h"
#include "run_process.h"

namespace scantet {
namespace {

using nlohmann::json;

RunResult torus(std::vector<std::string> options, const TestFolder& folder) {
  options.insert(options.begin(), {"mesh", sample("torus.nrrd"), "--level", "0.5"});
  return run_scantet(options, {folder.path()});
}

TEST(Plan, SaysWhatIsToBeExpectedAndMeshesNothing) {
  const TestFolder folder;
  const RunResult run = torus({"--size", "1", "--plan", "-o", "a.vtu", "--report", "plan.json"}, folder);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("To be expected (nothing was meshed)"), std::string::npos) << run.out;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"plan.json"}));
  const json plan = read_json(folder / "plan.json")["plan"];
  EXPECT_EQ(plan["fits"], true);
  EXPECT_GT(plan["memory_bytes"].get<double>(), 1e7);
  EXPECT_GT(plan["seconds"].get<double>(), 0);
  ASSERT_EQ(torus({"--size", "1", "--report", "mesh.json"}, folder).status, 0);
  const json mesh = read_json(folder / "mesh.json")["mesh"];
  EXPECT_NEAR(plan["tets"].get<double>() / mesh["tets"].get<double>(), 1, 0.25);
  EXPECT_NEAR(plan["vertices"].get<double>() / mesh["vertices"].get<double>(), 1, 0.25);
}

TEST(Plan, SaysWhatDoesNotFit) {
  const TestFolder folder;
  const auto misfit = [&](std::vector<std::string> options) {
    options.insert(options.end(), {"--plan", "--report", "plan.json"});
    const RunResult run = torus(options, folder);
    EXPECT_EQ(run.status, 0) << run.err;
    const json plan = read_json(folder / "plan.json")["plan"];
    EXPECT_EQ(plan["fits"], false);
    return plan.value("misfit", "");
  };
  EXPECT_NE(misfit({"--size", "1", "--max-vertices", "100"}).find("--max-vertices 100"), std::string::npos);
  EXPECT_NE(misfit({"--size", "1", "--max-memory", "1M"}).find("--max-memory 1M"), std::string::npos);
  EXPECT_NE(misfit({"--size", "0.5", "--max-time", "1e-3"}).find("--max-time 0.001"), std::string::npos);
  EXPECT_NE(misfit({"--size", "1e-6"}).find("--max-vertices"), std::string::npos) << "which a job would refuse";
}

TEST(Plan, HasNoPage) {
  const TestFolder folder;
  const RunResult run = torus({"--plan", "--report", "plan.html"}, folder);
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("--report: plan.html: a plan is written as JSON only"), std::string::npos) << run.err;
  EXPECT_TRUE(folder.names().empty());
}

TEST(TargetTets, ChoosesTheSize) {
  const TestFolder folder;
  const RunResult run = torus({"--target-tets", "40000", "--report", "a.json"}, folder);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("note: --target-tets 40000: size "), std::string::npos) << run.err;
  const json report = read_json(folder / "a.json");
  EXPECT_NEAR(report["mesh"]["tets"].get<double>(), 40000, 10000);
  EXPECT_GT(report["options"]["size"].get<double>(), 0);
  EXPECT_TRUE(report["options"]["target-tets"].is_null())
      << "the size says it: the report can be used as a configuration";
}

TEST(TargetTets, ThatMakeNoSenseAreRefused) {
  const auto expect = [](const std::vector<std::string>& options, const std::string& part) {
    const TestFolder folder;
    const RunResult run = torus(options, folder);
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
  };
  expect({"--target-tets", "0"}, "--target-tets: 0 is not a number of tetrahedra: it must be at least 1");
  expect({"--target-tets", "-5"}, "--target-tets: -5 is not a number of tetrahedra");
  expect({"--target-tets", "1"}, "--target-tets 1: however large the size, about ");
  expect({"--target-tets", "1000", "--size", "2"}, "--target-tets: it chooses the size, and --size asks for one");
  expect({"--target-tets", "1000", "--boundary-size", "1"}, "and --boundary-size asks for one");
  expect({"--target-tets", "1e13"}, "--max-vertices is");
}

TEST(Plan, MemoryChoosesTheSizeOnlyWhereItMust) {
  const TestFolder folder;
  const RunResult roomy = torus({"--plan", "--max-memory", "8G"}, folder);
  EXPECT_EQ(roomy.status, 0);
  EXPECT_EQ(roomy.err.find("is expected to take"), std::string::npos) << roomy.err;
  const RunResult none = torus({"--plan", "--max-memory", "1M", "--report", "a.json"}, folder);
  EXPECT_EQ(none.status, 0) << none.err;
  EXPECT_EQ(read_json(folder / "a.json")["plan"]["fits"], false) << "no size would fit";
}

}  // namespace
}  // namespace scantet
