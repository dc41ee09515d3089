// `scantet mesh --certify`: what was written is verified, refined for, and told.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "meshed.h"

namespace scantet {
namespace {

using nlohmann::json;

TEST(Certify, MeshThatWasWrittenIsVerified) {
  const TestFolder folder;
  const std::string file = folder / "a.cert.json";
  const Meshed run = run_mesh({sample("ellipsoid_oblique.nrrd"), "--level", "0.5", "--size", "1.5", "--certify", "-o",
                               folder / "a.vtu", "--certificate", file});
  ASSERT_EQ(run.result.status, 0) << run.result.err;
  const json& certificate = run.report["certificate"];
  EXPECT_EQ(certificate["grade"], "certified");
  EXPECT_EQ(certificate["facets"]["count"], run.report["mesh"]["boundary_facets"]);
  EXPECT_EQ(certificate["facets"]["count"], certificate["facets"]["certified"]);
  EXPECT_FALSE(certificate.contains("points_added"));
  EXPECT_EQ(run.report["options"]["certify"], "certified");
  EXPECT_TRUE(contains(run.result.out, "proved     certified: ")) << run.result.out;
  EXPECT_TRUE(contains(run.result.out, "wrote " + file)) << run.result.out;
  const RunResult again = run_scantet({"verify", "--certificate", file});
  EXPECT_EQ(again.status, 0) << again.out << again.err;
  EXPECT_TRUE(contains(again.out, " holds")) << again.out;
}

TEST(Certify, NamesNeedNotBeText) {
  const TestFolder folder;
  const std::string scan = folder / "s\xff.nrrd";
  std::filesystem::copy_file(sample("ellipsoid_oblique.nrrd"), scan);
  const Meshed run = run_mesh({scan, "--level", "0.5", "--size", "1.5", "--certify", "-o", folder / "a.vtu",
                               "--certificate", folder / "a.cert.json"});
  EXPECT_EQ(run.result.status, 0) << run.result.err;
}

TEST(Certify, GradeThatIsNotReachedIsUnmet) {
  const TestFolder folder;
  const std::vector<std::string> job{sample("islands.nii.gz"), "--level", "60", "--size", "1.5", "-o",
                                     folder / "a.inp"};
  std::vector<std::string> certified = job;
  certified.push_back("--certify");
  const Meshed run = run_mesh(certified);
  EXPECT_EQ(run.result.status, 4);
  EXPECT_TRUE(contains(run.result.err, "not certified")) << run.result.err;
  EXPECT_NE(run.report["certificate"]["grade"], "certified");
  EXPECT_TRUE(contains(run.result.out, "wrote ")) << run.result.out;
}

TEST(Certify, RefinementMakesCollarsHold) {
  const TestFolder folder;
  const Meshed run =
      run_mesh({sample("bar.mha"), "--level", "0.5", "--size", "1.5", "--certify", "refine", "-o", folder / "a.msh"});
  EXPECT_EQ(run.result.status, 0) << run.result.err;
  EXPECT_EQ(run.report["certificate"]["grade"], "certified") << run.report["certificate"]["findings"];
  EXPECT_GT(run.report["certificate"]["points_added"], 0);
}

TEST(Certify, PartsLeftOutOnPurposeAreNamed) {
  const TestFolder folder;
  const std::string mesh = folder / "a.vtu";
  const Meshed run = run_mesh({sample("islands.nii.gz"), "--level", "60", "--size", "1", "--components", "2",
                               "--certify", "refine", "-o", mesh});
  EXPECT_EQ(run.result.status, 0) << run.result.err;
  const json& certificate = run.report["certificate"];
  EXPECT_EQ(certificate["grade"], "certified") << certificate["findings"];
  EXPECT_EQ(certificate["left_out"]["components"], 198);
  EXPECT_EQ(certificate["field_topology"]["components"], 2);
  EXPECT_EQ(certificate["field_topology"], certificate["mesh_topology"]);
  const std::vector<std::string> verify{"verify", mesh, "--against", sample("islands.nii.gz"), "--level", "60"};
  EXPECT_EQ(run_scantet(verify).status, 4);
  std::vector<std::string> fewer = verify;
  fewer.insert(fewer.end(), {"--components", "3"});
  EXPECT_EQ(run_scantet(fewer).status, 4);
  fewer.back() = "2";
  EXPECT_EQ(run_scantet(fewer).status, 0);
}

TEST(Certify, CavityThatWasFilledIsNamed) {
  const TestFolder folder;
  const Meshed run = run_mesh({sample("shell.mha"), "--level", "1000.5", "--inside", "below", "--size", "2",
                               "--fill-cavities", "1e6", "--certify", "-o", folder / "a.vtk"});
  EXPECT_EQ(run.result.status, 0) << run.result.err;
  const json& certificate = run.report["certificate"];
  EXPECT_EQ(certificate["left_out"]["cavities_filled"], 1);
  EXPECT_EQ(certificate["left_out"]["parts"][0]["kind"], "cavity");
  EXPECT_EQ(certificate["field_topology"]["cavities"], 0);
}

TEST(Certify, SeveralLevelsAreVerifiedEachByItself) {
  const TestFolder folder;
  const std::string mesh = folder / "a.mesh";
  const Meshed run = run_mesh(
      {sample("torus.nrrd"), "--level", "400", "--level", "300.5", "--size", "1.5", "--certify", "refine", "-o", mesh});
  EXPECT_EQ(run.result.status, 0) << run.result.err;
  const json& levels = run.report["certificate"]["levels"];
  ASSERT_EQ(levels.size(), 2U);
  EXPECT_EQ(levels[0]["level"], 300.5);
  EXPECT_EQ(levels[1]["grade"], "certified");
  const RunResult fewer = run_scantet({"verify", mesh, "--against", sample("torus.nrrd"), "--level", "300.5"});
  EXPECT_EQ(fewer.status, 4);
  EXPECT_TRUE(contains(fewer.out, "[mesh.regions]")) << fewer.out;
}

TEST(Certify, CapsAreBounded) {
  const TestFolder folder;
  const std::vector<std::string> job{sample("bar.mha"), "--level", "0.5", "--size",        "1.5",
                                     "--border",        "cap",     "-o",  folder / "a.vtu"};
  std::vector<std::string> bounded = job;
  bounded.insert(bounded.end(), {"--certify", "bounded"});
  const Meshed run = run_mesh(bounded);
  EXPECT_EQ(run.result.status, 0) << run.result.err;
  EXPECT_EQ(run.report["certificate"]["grade"], "bounded");
  std::vector<std::string> certified = job;
  certified.push_back("--certify");
  EXPECT_EQ(run_mesh(certified).result.status, 2);
}

TEST(Certify, LabelMapsAreBounded) {
  const TestFolder folder;
  const std::string mesh = folder / "a.vtu";
  const std::string file = folder / "a.cert.json";
  const std::string map = sample("labels_shell.nrrd");
  for (const std::string smoothing : {"keep", "none"}) {
    const Meshed run = run_mesh({map, "--size", "2", "--label-smoothing", smoothing, "--certify", "bounded",
                                 "--certificate", file, "-o", mesh});
    ASSERT_EQ(run.result.status, 0) << smoothing << run.result.err << run.report["certificate"].dump(1);
    const json& certificate = run.report["certificate"];
    EXPECT_EQ(certificate["grade"], "bounded");
    ASSERT_EQ(certificate["regions"].size(), 3U);
    for (const json& region : certificate["regions"]) {
      EXPECT_EQ(region["field_components"], json::array({1, 1}));
      EXPECT_EQ(region["mesh_components"], 1);
      EXPECT_GT(region["voxels_kept"], 0);
    }
    const json recorded = read_json(file);
    EXPECT_EQ(recorded["options"]["labels"], json::array({"all"}));
    EXPECT_EQ(recorded["options"]["label-smoothing"], json::array({smoothing}));
    const RunResult again = run_scantet({"verify", "--certificate", file});
    EXPECT_EQ(again.status, 0) << again.out << again.err;
  }
  const std::vector<std::string> verify{"verify", mesh, "--against", map, "--label-smoothing", "none"};
  const auto verified = [&](std::vector<std::string> more) {
    more.insert(more.begin(), verify.begin(), verify.end());
    return run_scantet(more);
  };
  EXPECT_EQ(verified({"--labels", "all"}).status, 4) << "it is bounded, and certified was asked for";
  EXPECT_EQ(verified({"--labels", "all", "--require", "bounded"}).status, 0);
  EXPECT_TRUE(contains(verified({"--labels", "1"}).out, "[region.unknown]"));
  EXPECT_EQ(verified({}).status, 2) << "no labels";
  EXPECT_EQ(verified({"--labels", "all", "--level", "1"}).status, 2);
  EXPECT_EQ(verified({"--labels", "all", "--border", "cap"}).status, 2);
  const RunResult other = run_scantet({"verify", mesh, "--against", sample("labels_tubes.nrrd"), "--labels", "all"});
  EXPECT_EQ(other.status, 4);
  EXPECT_TRUE(contains(other.out, "grade         not the scan")) << other.out;
}

TEST(Certify, TableOfLabelsHasAChecksum) {
  const TestFolder folder;
  const std::string table = folder / "labels.txt";
  const std::string file = folder / "a.cert.json";
  const auto write = [&](const std::string& text) { std::ofstream(table) << text; };
  write("1 shell\n2 core\n");
  const Meshed run = run_mesh({sample("labels_shell.nrrd"), "--labels", table, "--size", "2", "--certify", "bounded",
                               "--certificate", file, "-o", folder / "a.vtu"});
  ASSERT_EQ(run.result.status, 0) << run.result.err;
  EXPECT_EQ(read_json(file)["labels_table"]["name"], table);
  EXPECT_EQ(run_scantet({"verify", "--certificate", file}).status, 0);
  write("1 bark\n2 core\n");  // the regions are the same, the file is not
  const RunResult again = run_scantet({"verify", "--certificate", file});
  EXPECT_EQ(again.status, 4) << again.out;
  EXPECT_TRUE(contains(again.out, table + " is not the file that it names")) << again.out;
}

TEST(Certify, GridsOfOpenVdbAreFieldsToo) {
  const TestFolder folder;
  const std::string grid = folder / "a.vdb";
  const std::string file = folder / "a.cert.json";
  ASSERT_EQ(run_scantet({"convert", sample("ellipsoid_oblique.nrrd"), grid}).status, 0);
  const Meshed run =
      run_mesh({grid, "--level", "0.5", "--size", "1.5", "--certify", "-o", folder / "a.vtu", "--certificate", file});
  ASSERT_EQ(run.result.status, 0) << run.result.err;
  EXPECT_EQ(run.report["certificate"]["grade"], "certified");
  const RunResult again = run_scantet({"verify", "--certificate", file});
  EXPECT_EQ(again.status, 0) << again.out << again.err;
  EXPECT_TRUE(contains(again.out, " holds")) << again.out;
  // The program without plugins says which one can check it.
  const std::string said = folder / "said.txt";
  const std::string check = std::string(SCANTET_EXECUTABLE) + "-check " + file + " 2> " + said;
  const int status = std::system(check.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 3);
  std::stringstream text;
  text << std::ifstream(said).rdbuf();
  EXPECT_TRUE(contains(text.str(), "scantet verify --certificate " + file)) << text.str();
  // The grid is the scan: the same proof, to the last digit.
  ASSERT_EQ(run_scantet({"verify", folder / "a.vtu", "--against", sample("ellipsoid_oblique.nrrd"), "--level", "0.5",
                         "--json", folder / "scan.json"})
                .status,
            0);
  EXPECT_EQ(read_json(folder / "scan.json")["mesh_to_level"], read_json(file)["mesh_to_level"]);
  const std::vector<std::string> verify{"verify", folder / "a.vtu", "--against", grid, "--grid", "density", "--level"};
  const auto with = [&](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return run_scantet(words);
  };
  EXPECT_EQ(with(verify, {"0.5"}).status, 0);
  EXPECT_EQ(with(verify, {"30.5"}).status, 4) << "another level";
  EXPECT_EQ(with(verify, {"0.5", "--grid", "heat"}).status, 2);
  EXPECT_EQ(with(verify, {"0.5", "--against", sample("sphere.nrrd")}).status, 2) << "an image has no grids";
}

TEST(Certify, LabelMapsAreNotCertified) {
  const TestFolder folder;
  for (const std::string grade : {"certified", "refine"}) {
    const RunResult run = run_mesh({sample("labels_shell.nrrd"), "--certify", grade, "-o", folder / "a.vtu"}).result;
    EXPECT_EQ(run.status, 2);
    EXPECT_TRUE(contains(run.err, "--certify bounded")) << run.err;
  }
}

TEST(Certify, MeshesOfSurfacesAreVerifiedAgainstThem) {
  const TestFolder folder;
  const std::string surface = folder / "ball.stl";
  ASSERT_EQ(run_mesh({sample("sphere.nrrd"), "--level", "127.5", "-o", surface}).result.status, 0);
  const std::string file = folder / "a.cert.json";
  const Meshed run =
      run_mesh({surface, "--size", "3", "--certify", "bounded", "-o", folder / "a.vtu", "--certificate", file});
  ASSERT_EQ(run.result.status, 0) << run.result.err;
  const json& certificate = run.report["certificate"];
  EXPECT_EQ(certificate["grade"], "bounded");
  EXPECT_EQ(certificate["surface_topology"], certificate["mesh_topology"]);
  EXPECT_TRUE(contains(run.result.out, "surface to mesh at most")) << run.result.out;
  const RunResult again = run_scantet({"verify", "--certificate", file});
  EXPECT_EQ(again.status, 0) << again.out << again.err;
  EXPECT_TRUE(contains(again.out, " holds")) << again.out;
  const auto verify = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"verify", folder / "a.vtu", "--require", "bounded", "--against"});
    return run_scantet(more);
  };
  EXPECT_EQ(verify({surface}).status, 0);
  EXPECT_EQ(verify({surface, "--repair"}).status, 0);
  EXPECT_EQ(verify({surface, "--max-distance", "0.001"}).status, 4);
  for (const char* option : {"--level", "--labels", "--voxel-size"}) {
    EXPECT_EQ(verify({surface, option, "1"}).status, 2) << option;
  }
  EXPECT_EQ(verify({sample("sphere.nrrd"), "--level", "127.5", "--repair"}).status, 2);
  EXPECT_EQ(verify({sample("sphere.nrrd")}).status, 2) << "no level";
  ASSERT_EQ(run_mesh({sample("torus.nrrd"), "--level", "300.5", "-o", folder / "torus.stl"}).result.status, 0);
  EXPECT_EQ(verify({folder / "torus.stl"}).status, 4) << "another surface";
  const RunResult certified = run_mesh({surface, "--certify", "-o", folder / "a.vtu"}).result;
  EXPECT_EQ(certified.status, 2);
  EXPECT_TRUE(contains(certified.err, "--certify bounded")) << certified.err;
}

TEST(Certify, WhatCannotBeVerifiedIsRefused) {
  const TestFolder folder;
  const std::vector<std::string> torus{sample("torus.nrrd"), "--level", "300.5", "--size", "3", "--certify"};
  const auto status = [&](std::vector<std::string> more) {
    more.insert(more.begin(), torus.begin(), torus.end());
    return run_mesh(more).result;
  };
  EXPECT_EQ(status({"-o", folder / "a.vtu"}).status, 0);
  const RunResult none = status({});
  EXPECT_EQ(none.status, 2);
  EXPECT_TRUE(contains(none.err, "that can be read again")) << none.err;
  EXPECT_EQ(status({"-o", folder / "a.stl"}).status, 2);
  EXPECT_EQ(status({"-o", folder / "a.vtu", "--cut", "x < 0"}).status, 2);
  EXPECT_EQ(status({"-o", folder / "a.vtu", "--order", "2"}).status, 2);
  const RunResult idle = run_mesh({sample("torus.nrrd"), "--level", "300.5", "--size", "3", "--certificate",
                                   folder / "a.json", "-o", folder / "a.vtu"})
                             .result;
  EXPECT_EQ(idle.status, 2);
  EXPECT_TRUE(contains(idle.err, "add --certify")) << idle.err;
}

}  // namespace
}  // namespace scantet
