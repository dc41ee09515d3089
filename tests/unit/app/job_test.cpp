// The job as a library call, on a domain that comes from a plugin.
#include "scantet/app/job.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>

#include "fake_plugin.h"
#include "scantet/app/mesh_tools.h"
#include "scantet/base/error.h"
#include "scantet/io/mesh_io.h"
#include "scantet/io/sha256.h"
#include "unit/nested_balls.h"

namespace scantet {
namespace {

// Cancels when a stage is first reported.
class CancelAt final : public Progress {
 public:
  explicit CancelAt(std::string stage) : stage_(std::move(stage)) {}
  void report(const ProgressState& state) override { cancelled_ = cancelled_ || state.stage == stage_; }
  bool cancelled() const override { return cancelled_; }

 private:
  std::string stage_;
  bool cancelled_ = false;
};

/// Opens two balls in each other, so far apart.
class ShellPlugin final : public InputPlugin {
 public:
  explicit ShellPlugin(double gap_mm) : gap_mm_(gap_mm) {}
  std::string name() const override { return "shell"; }
  std::string description() const override { return "shells"; }
  int can_open(const std::string& input) const override { return input.ends_with(".shell") ? 10 : 0; }
  void declare_options(OptionSet&) override {}
  OpenedDomain open(const std::string&, Progress&) override {
    constexpr double kOuter = 4;
    return {std::make_unique<test::NestedBalls>(kOuter - gap_mm_, kOuter), std::nullopt, kOuter / 2, "half of it", {}};
  }
  std::vector<InfoSection> info(const std::string&, Progress&) override { return {}; }

 private:
  double gap_mm_;
};

/// A ball that is said to have a tunnel.
class BallWithHandle final : public Domain {
 public:
  static constexpr Point kPlace{0.25, 0.5, 0};  // in the tunnel

  Box bounds() const override { return ball_->bounds(); }
  Region region_at(const Point& p) const override { return ball_->region_at(p); }
  void crossings(const Segment& segment, Crossings& out) const override { ball_->crossings(segment, out); }
  std::vector<Component> components() const override {
    Component ball{1, {0, 0, 0}, bounds()};
    ball.euler = 0;
    ball.surfaces = 1;
    return {ball};
  }
  std::vector<Misplaced> misplaced(const MeshBoundary&, const PlaceFilter&) const override {
    return {{kPlace, kOutside, 0}};
  }

 private:
  std::unique_ptr<Domain> ball_ = make_sphere({0, 0, 0}, 4);
};

class HandlePlugin final : public InputPlugin {
 public:
  std::string name() const override { return "handle"; }
  std::string description() const override { return "handles"; }
  int can_open(const std::string& input) const override { return input.ends_with(".handle") ? 10 : 0; }
  void declare_options(OptionSet&) override {}
  OpenedDomain open(const std::string&, Progress&) override {
    return {std::make_unique<BallWithHandle>(), std::nullopt, 2, "half of it", {}};
  }
  std::vector<InfoSection> info(const std::string&, Progress&) override { return {}; }
};

class Job : public testing::Test {
 protected:
  std::string folder_ = testing::TempDir() + std::to_string(getpid()) + "_scantet_job_" +
                        testing::UnitTest::GetInstance()->current_test_info()->name();
  PluginRegistry plugins_;
  MeshJob job_;
  Progress progress_;

  void SetUp() override {
    std::filesystem::create_directory(folder_);
    plugins_.add(fake_plugin("ball", ".ball", 10));
    job_.input = "a.ball";
    job_.outputs = {folder_ + "/a.vtu"};
    job_.reports = {folder_ + "/a.json"};
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string code() {
    try {
      run_mesh_job(job_, plugins_, progress_);
    } catch (const Error& error) {
      return error.code();
    }
    return "none";
  }
};

TEST_F(Job, MeshesAndReports) {
  job_.input_options = {{"radius", "5", "--radius"}};
  job_.sizes.size = "1";
  job_.no_theory = true;
  const JobResult result = run_mesh_job(job_, plugins_, progress_);
  EXPECT_FALSE(result.cancelled);
  EXPECT_TRUE(result.findings.empty()) << result.findings.front();
  EXPECT_TRUE(result.notes.empty());
  EXPECT_EQ(result.written, (std::vector<std::string>{folder_ + "/a.vtu", folder_ + "/a.json"}));
  const double ball_mm3 = 4.0 / 3 * std::numbers::pi * 125;
  EXPECT_NEAR(result.report.mesh->volume_mm3, ball_mm3, 0.05 * ball_mm3);
  EXPECT_EQ(result.report.stop, "converged");
  for (const ReportBound& bound : result.report.bounds) EXPECT_EQ(bound.broken, 0u) << bound.name;
  EXPECT_EQ(result.report.bounds.size(), 7u);
  EXPECT_GT(result.report.rules->lattice_points, 0u);
  EXPECT_GE(result.report.stages.size(), 10u);
  EXPECT_TRUE(result.report.audit->passed());
  EXPECT_EQ(result.report.input->sha256, "") << "nothing was read";
  EXPECT_TRUE(result.report.timing_s->total);
  EXPECT_EQ(read_mesh(folder_ + "/a.vtu").tets.size(), result.report.mesh->tets);
}

// Parts do not overlap: however busy the machine, they take no longer than the whole.
TEST_F(Job, TimesPartsOfEachStage) {
  job_.sizes.size = "2";
  const Report report = run_mesh_job(job_, plugins_, progress_).report;
  std::map<std::string, double> seconds;
  std::map<std::string, std::vector<std::string>> parts;
  for (const PhaseAccount& phase : report.phases) {
    parts[phase.stage].push_back(phase.part);
    const bool is_later = phase.part == "a.json" || phase.part == "renaming";  // than the report's times
    if (!is_later) seconds[phase.stage] += phase.seconds;
  }
  EXPECT_EQ(parts["read"], (std::vector<std::string>{"input", "sizes"}));
  EXPECT_EQ(parts["write"],
            (std::vector<std::string>{"checksum of the input", "a.vtu", "checksums", "a.json", "renaming"}));
  EXPECT_EQ(parts["audit"],
            (std::vector<std::string>{"bounds", "distance", "measures", "arrays", "elements", "faces", "facets",
                                      "components", "boundary", "crossings", "distance from the domain",
                                      "circumcentres", "components of the domain"}));
  for (const StageAccount& stage : report.stages) seconds["stages"] += stage.seconds;
  constexpr double kRounding = 1e-6;
  EXPECT_LE(seconds["read"], *report.timing_s->read + kRounding);
  EXPECT_LE(seconds["audit"], *report.timing_s->audit + kRounding);
  EXPECT_LE(seconds["write"], *report.timing_s->write + kRounding);
  EXPECT_LE(seconds["stages"], *report.timing_s->sample + *report.timing_s->refine + kRounding);
}

TEST_F(Job, HandlesAreToldWhereTheyWereLost) {
  plugins_.add([] { return std::make_unique<HandlePlugin>(); });
  job_.input = "a.handle";
  const JobResult result = run_mesh_job(job_, plugins_, progress_);
  const auto& findings = result.report.audit->findings;
  const auto of_handles = [](const Finding& finding) { return finding.code == "audit.handles"; };
  const auto handles = std::find_if(findings.begin(), findings.end(), of_handles);
  ASSERT_NE(handles, findings.end());
  EXPECT_EQ(handles->where, BallWithHandle::kPlace) << "not the component's";
  EXPECT_EQ(handles->places, std::vector<Point>{BallWithHandle::kPlace});
}

TEST_F(Job, OptionsInTheReportAreResolved) {
  job_.outputs.clear();
  job_.reports.clear();
  job_.no_theory = true;
  const JobResult result = run_mesh_job(job_, plugins_, progress_);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_NE(result.notes[0].find("5 mm, half the radius"), std::string::npos) << result.notes[0];
  bool size = false;
  bool radius = false;
  for (const ReportOption& option : *result.report.options) {
    size = size || (option.name == "size" && option.value == ReportValue(5.0));
    radius = radius || (option.name == "radius" && option.value == ReportValue(10.0));
  }
  EXPECT_TRUE(size && radius);
}

TEST_F(Job, CancelledWritesNothing) {
  for (const char* stage : {"read", "sample", "refine", "audit", "write"}) {
    CancelAt progress(stage);
    job_.sizes.size = "1";
    const JobResult result = run_mesh_job(job_, plugins_, progress);
    EXPECT_TRUE(progress.cancelled()) << stage;
    EXPECT_TRUE(result.cancelled) << stage;
    EXPECT_TRUE(result.written.empty());
    EXPECT_TRUE(std::filesystem::is_empty(folder_)) << stage;
  }
}

TEST_F(Job, TheReportListsTheFilesOfTheRunWithTheirChecksums) {
  job_.reports = {folder_ + "/a.json", folder_ + "/a.csv"};
  const JobResult result = run_mesh_job(job_, plugins_, progress_);
  EXPECT_EQ(result.written, (std::vector<std::string>{folder_ + "/a.vtu", folder_ + "/a.csv", folder_ + "/a.json"}));
  ASSERT_EQ(result.report.files.size(), 2u);
  for (const ReportFile& file : result.report.files) EXPECT_EQ(file.sha256, sha256_file(file.path)) << file.path;
}

TEST_F(Job, UsedUpBudgetIsAFinding) {
  job_.budget.time = "1e-6";
  const JobResult late = run_mesh_job(job_, plugins_, progress_);
  EXPECT_FALSE(late.cancelled);
  EXPECT_FALSE(late.report.mesh);
  ASSERT_EQ(late.findings.size(), 1u);
  EXPECT_NE(late.findings[0].find("--max-time 1e-6 was over while busy with 'read input'"), std::string::npos)
      << late.findings[0];
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(Job, SizeThatTakesMoreMemoryThanAllowedIsRefused) {
  job_.sizes.size = "0.05";  // millions of vertices
  job_.budget.memory = "2G";
  EXPECT_EQ(code(), "usage.memory");
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(Job, FilesReadForTheJobAreNotReplaced) {
  std::ofstream(folder_ + "/a.json") << "{}";
  job_.read = {folder_ + "/a.json"};
  EXPECT_EQ(code(), "usage.same_file");
}

TEST_F(Job, LimitIsAFindingAndTheMeshIsWritten) {
  job_.sizes.size = "1";
  job_.mesher.max_vertices = 2000;
  const JobResult result = run_mesh_job(job_, plugins_, progress_);
  EXPECT_EQ(result.report.stop, "limit");
  const auto is_broken = [](const ReportBound& bound) { return bound.broken > 0; };
  EXPECT_TRUE(std::any_of(result.report.bounds.begin(), result.report.bounds.end(), is_broken));
  ASSERT_FALSE(result.findings.empty());
  EXPECT_NE(result.findings[0].find("--max-vertices 2000"), std::string::npos);
  EXPECT_EQ(result.written.size(), 2u);
}

TEST_F(Job, HopelessSizesAreRefusedAndLargeMeshesAnnounced) {
  job_.sizes.size = "1e-6";
  EXPECT_EQ(code(), "usage.size");
  job_.sizes.size = "1";
  job_.mesher.max_vertices = 100;
  EXPECT_EQ(code(), "usage.max_vertices") << "the boundary alone takes more";
  job_.mesher.max_vertices = 2000;
  const JobResult result = run_mesh_job(job_, plugins_, progress_);
  ASSERT_FALSE(result.notes.empty());
  EXPECT_NE(result.notes[0].find("--max-vertices"), std::string::npos);
}

TEST_F(Job, CloseRegionsAreAnnouncedAndHopelesslyCloseOnesRefused) {
  job_.input = "a.shell";
  job_.sizes.size = "2";
  double gap_mm = 0.5;
  plugins_.add([&] { return std::make_unique<ShellPlugin>(gap_mm); });
  const JobResult result = run_mesh_job(job_, plugins_, progress_);
  EXPECT_TRUE(result.findings.empty());
  ASSERT_FALSE(result.notes.empty());
  EXPECT_NE(result.notes[0].find("closer to each other than the size on 100 %"), std::string::npos);
  gap_mm = 1e-4;
  EXPECT_EQ(code(), "usage.gap");
}

TEST_F(Job, ErrorsComeBeforeTheWork) {
  job_.input_options = {{"radius", "-1", "--radius"}};
  EXPECT_EQ(code(), "usage.value");
  job_.input_options = {{"level", "1", "--level"}};
  EXPECT_EQ(code(), "usage.no_effect");
  job_.input_options.clear();
  job_.outputs = {folder_ + "/missing/a.vtu"};
  EXPECT_EQ(code(), "output.cannot_write");
  job_.outputs = {folder_ + "/a.ball"};
  EXPECT_EQ(code(), "usage.format");
  job_.input = "a.cube";
  job_.outputs.clear();
  EXPECT_EQ(code(), "input.not_found");
}

TEST_F(Job, MeshToolsReadWhatTheJobWrote) {
  run_mesh_job(job_, plugins_, progress_);
  const MeshFindings found = report_on_meshes({folder_ + "/a.vtu"}, {folder_ + "/b.csv"}, progress_);
  EXPECT_TRUE(found.findings.empty());
  EXPECT_EQ(found.written, std::vector<std::string>{folder_ + "/b.csv"});
  EXPECT_TRUE(convert_mesh(folder_ + "/a.vtu", folder_ + "/b.msh", Space::lps, progress_));
  EXPECT_EQ(read_mesh(folder_ + "/b.msh").tets, read_mesh(folder_ + "/a.vtu").tets);
  EXPECT_TRUE(convert_mesh(folder_ + "/a.vtu", folder_ + "/ras.mesh", Space::ras, progress_));
  CancelAt progress("read");
  EXPECT_FALSE(convert_mesh(folder_ + "/a.vtu", folder_ + "/c.msh", Space::lps, progress));
  EXPECT_FALSE(std::filesystem::exists(folder_ + "/c.msh"));
}

TEST_F(Job, SizesAreMeasuredAgainstTheFieldOfTheRunOnly) {
  job_.input_options = {{"radius", "5", "--radius"}};
  job_.sizes.size = "1.25";
  job_.optimize = Optimize::none;
  const JobResult result = run_mesh_job(job_, plugins_, progress_);
  const QualitySummary& quality = *result.report.quality;
  ASSERT_TRUE(quality.size_ratio);
  EXPECT_EQ(quality.size_ratio->max, quality.max_circumradius_mm() / 1.25);
  EXPECT_LE(quality.size_ratio->max, 1 + 1e-9) << "R3 holds";
  const MeshFindings found = report_on_meshes({folder_ + "/a.vtu"}, {}, progress_);
  EXPECT_FALSE(found.reports.front().quality->size_ratio) << "a mesh alone has no sizing field";
}

TEST_F(Job, SeveralMeshesShareTheirReports) {
  run_mesh_job(job_, plugins_, progress_);
  job_.sizes.size = "2";
  job_.outputs = {folder_ + "/b.mesh"};
  run_mesh_job(job_, plugins_, progress_);
  const std::vector<std::string> meshes{folder_ + "/a.vtu", folder_ + "/b.mesh"};
  const std::vector<std::string> reports{folder_ + "/r.html", folder_ + "/r.svg", folder_ + "/r.png"};
  const MeshFindings found = report_on_meshes(meshes, reports, progress_);
  ASSERT_EQ(found.reports.size(), 2u);
  EXPECT_EQ(found.written, reports);
  EXPECT_NE(found.reports[0].mesh->tets, found.reports[1].mesh->tets);
  EXPECT_EQ(found.reports[1].input->path, meshes[1]);
  for (const std::string& file : reports) EXPECT_GT(std::filesystem::file_size(file), 1000u) << file;
  CancelAt progress("audit");
  const MeshFindings cancelled = report_on_meshes(meshes, {folder_ + "/c.html"}, progress);
  EXPECT_TRUE(cancelled.cancelled);
  EXPECT_TRUE(cancelled.reports.empty());
  EXPECT_FALSE(std::filesystem::exists(folder_ + "/c.html"));
}

}  // namespace
}  // namespace scantet
