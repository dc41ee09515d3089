// `scantet verify`: grades, exit statuses, the certificate as a file, and what it refuses.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "read_json.h"
#include "run_process.h"

namespace scantet {
namespace {

using nlohmann::json;

class VerifyCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    const RunResult run = run_scantet(
        {"mesh", sample("ellipsoid_oblique.nrrd"), "--level", "0.5", "--size", "1.5", "-o", mesh(), "--quiet"});
    ASSERT_EQ(run.status, 0) << run.err;
  }
  std::string mesh() const { return folder_ / "a.vtu"; }
  RunResult verify(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"verify", mesh()};
    words.insert(words.end(), more.begin(), more.end());
    return run_scantet(words);
  }
  TestFolder folder_;
};

TEST_F(VerifyCommand, MeshOfTheScanIsCertified) {
  const RunResult run =
      verify({"--against", sample("ellipsoid_oblique.nrrd"), "--level", "0.5", "--json", folder_ / "a.cert.json"});
  ASSERT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_NE(run.out.find("grade         certified"), std::string::npos) << run.out;
  const json certificate = read_json(folder_ / "a.cert.json");
  EXPECT_EQ(certificate["grade"], "certified");
  EXPECT_TRUE(certificate["findings"].empty());
  EXPECT_EQ(certificate["facets"]["count"], certificate["facets"]["certified"]);
  EXPECT_EQ(certificate["field_topology"], certificate["mesh_topology"]);
  EXPECT_EQ(certificate["mesh_file"]["sha256"].get<std::string>().size(), 64U);
  EXPECT_LE(certificate["mesh_to_level"]["lower_mm"], certificate["mesh_to_level"]["upper_mm"]);
  EXPECT_LT(certificate["mesh_to_level"]["upper_mm"], 0.3);
}

TEST_F(VerifyCommand, ReportHasTheCertificate) {
  const RunResult run = verify({"--against", sample("ellipsoid_oblique.nrrd"), "--level", "0.5", "--report",
                                folder_ / "a.json", "--report", folder_ / "a.html"});
  ASSERT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_NE(run.out.find("wrote " + (folder_ / "a.html")), std::string::npos) << run.out;
  const json report = read_json(folder_ / "a.json");
  EXPECT_EQ(report["certificate"]["grade"], "certified");
  EXPECT_EQ(report["mesh"]["boundary_facets"], report["certificate"]["facets"]["count"]);
  EXPECT_NE(read_bytes(folder_ / "a.html").find("id=\"scan-0\""), std::string::npos);
  EXPECT_EQ(verify({"--against", sample("ellipsoid_oblique.nrrd"), "--level", "0.5", "--report", mesh()}).status, 2);
}

TEST_F(VerifyCommand, CertificateCannotChooseWhatIsWritten) {
  const std::string file = folder_ / "a.cert.json";
  ASSERT_EQ(verify({"--against", sample("ellipsoid_oblique.nrrd"), "--level", "0.5", "--json", file}).status, 0);
  const json sound = read_json(file);
  for (const std::string option : {"json", "certificate", "against", "threads", "require"}) {
    json damaged = sound;
    damaged["options"][option] = {folder_ / "chosen"};
    write_bytes(file, damaged.dump());
    const RunResult run = run_scantet({"verify", "--certificate", file});
    EXPECT_EQ(run.status, 3) << option << run.err;
    EXPECT_NE(run.err.find("it sets --" + option), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "chosen")) << option;
  }
}

TEST_F(VerifyCommand, CertificateReplacesNothingThatIsRead) {
  const std::string scan = folder_ / "a.nrrd";
  const std::string certificate = folder_ / "a.cert.json";
  write_bytes(scan, read_bytes(sample("ellipsoid_oblique.nrrd")));
  const std::vector<std::string> what{"--against", scan, "--level", "0.5"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), what.begin(), what.end());
    return verify(more).status;
  };
  ASSERT_EQ(with({"--json", certificate}), 0);
  for (const std::string& file : {scan, mesh(), certificate}) {
    const std::string before = read_bytes(file);
    EXPECT_EQ(run_scantet({"verify", "--certificate", certificate, "--json", file}).status, 2) << file;
    EXPECT_EQ(read_bytes(file), before) << file;
  }
  const std::string both = folder_ / "both.json";
  EXPECT_EQ(with({"--json", both, "--report", both}), 2);
}

TEST_F(VerifyCommand, CertificateCanBeCheckedAgain) {
  const std::string file = folder_ / "a.cert.json";
  ASSERT_EQ(verify({"--against", sample("ellipsoid_oblique.nrrd"), "--level", "0.5", "--json", file}).status, 0);
  const RunResult again = run_scantet({"verify", "--certificate", file});
  EXPECT_EQ(again.status, 0) << again.out << again.err;
  EXPECT_NE(again.out.find(" holds"), std::string::npos) << again.out;
  std::string bytes = read_bytes(mesh());
  write_bytes(folder_ / "moved.vtu", bytes);
  EXPECT_EQ(run_scantet({"verify", folder_ / "moved.vtu", "--certificate", file}).status, 0);
  const RunResult other = run_scantet({"verify", "--certificate", file, "--against", sample("ellipsoid_axis.nrrd")});
  EXPECT_EQ(other.status, 4) << other.out;
  EXPECT_NE(other.out.find("is not the file that it names"), std::string::npos) << other.out;
  write_bytes(file, "{}");
  EXPECT_EQ(run_scantet({"verify", "--certificate", file}).status, 3);
  EXPECT_EQ(run_scantet({"verify", "--certificate", folder_ / "none.json"}).status, 3);
}

TEST_F(VerifyCommand, OtherLevelsFramesAndScansAreNot) {
  const RunResult level = verify({"--against", sample("ellipsoid_oblique.nrrd"), "--level", "30.5"});
  EXPECT_EQ(level.status, 4) << level.out;
  EXPECT_NE(level.out.find("[vertex.off_level]"), std::string::npos) << level.out;
  const RunResult frame = verify({"--against", sample("ellipsoid_axis.nrrd"), "--level", "0.5"});
  EXPECT_EQ(frame.status, 4) << frame.out;
  const RunResult scan = verify({"--against", sample("torus.nrrd"), "--level", "300.5"});
  EXPECT_EQ(scan.status, 4) << scan.out;
  EXPECT_NE(scan.out.find("not the scan"), std::string::npos) << scan.out;
}

TEST_F(VerifyCommand, GradesAreAsRequired) {
  const std::vector<std::string> near{"--against", sample("ellipsoid_oblique.nrrd"), "--level", "10.5"};
  EXPECT_EQ(verify(near).status, 4);
  std::vector<std::string> bounded = near;
  bounded.insert(bounded.end(), {"--require", "bounded"});
  EXPECT_EQ(verify(bounded).status, 0);
  bounded.insert(bounded.end(), {"--max-distance", "0.01"});
  const RunResult far = verify(bounded);
  EXPECT_EQ(far.status, 4);
  EXPECT_NE(far.out.find("[distance.exceeded]"), std::string::npos) << far.out;
}

// One more cell, outside of the scan: input.other_cells.
TEST_F(VerifyCommand, FileWithOtherSolidsIsRefused) {
  ASSERT_EQ(run_scantet({"convert", mesh(), folder_ / "a.msh2"}).status, 0);
  std::string text = read_bytes(folder_ / "a.msh2");
  const std::size_t count_at = text.find("$Elements\n") + std::string("$Elements\n").size();
  const std::size_t line_end = text.find('\n', count_at);
  const std::size_t count = std::stoul(text.substr(count_at, line_end - count_at));
  text.insert(text.find("$EndElements"), std::to_string(count + 1) + " 5 0 1 2 3 4 5 6 7 8\n");
  text.replace(count_at, line_end - count_at, std::to_string(count + 1));
  write_bytes(folder_ / "b.msh2", text);
  const RunResult run =
      run_scantet({"verify", folder_ / "b.msh2", "--against", sample("ellipsoid_oblique.nrrd"), "--level", "0.5"});
  EXPECT_EQ(run.status, 3) << run.out;
  EXPECT_NE(run.err.find("1 cell of three dimensions that is no tetrahedron"), std::string::npos) << run.err;
  EXPECT_EQ(run_scantet({"diff", mesh(), folder_ / "b.msh2"}).status, 4);
  EXPECT_EQ(run_scantet({"report", folder_ / "b.msh2"}).status, 4);
  const RunResult converted = run_scantet({"convert", folder_ / "b.msh2", folder_ / "c.vtu"});
  EXPECT_NE(converted.err.find("1 cell of three dimensions"), std::string::npos) << converted.err;
}

TEST_F(VerifyCommand, WrongUseAndInputsAreTold) {
  EXPECT_EQ(verify({"--level", "0.5"}).status, 2);
  EXPECT_EQ(verify({"--against", sample("torus.nrrd")}).status, 2);
  EXPECT_EQ(verify({"--against", sample("torus.nrrd"), "--level", "300.5", "--require", "perfect"}).status, 2);
  EXPECT_EQ(verify({"--against", folder_ / "none.nrrd", "--level", "1"}).status, 3);
  EXPECT_EQ(verify({"--against", sample("torus.nrrd"), "--level", "1e9"}).status, 3);
  EXPECT_EQ(
      verify({"--against", sample("torus.nrrd"), "--level", "300.5", "--json", folder_ / "no/such/folder.json"}).status,
      5);
  EXPECT_EQ(run_scantet({"verify", sample("torus.nrrd"), "--against", sample("torus.nrrd"), "--level", "300.5"}).status,
            2);
  EXPECT_EQ(run_scantet({"verify"}).status, 2);
}

}  // namespace
}  // namespace scantet
