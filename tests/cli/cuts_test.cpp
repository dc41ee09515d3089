// Cuts, from the command line: caps by name, at planes and at the border of a scan, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "byte_image.h"
#include "meshed.h"

namespace scantet {
namespace {

const std::string kBall = "implicit:x^2 + y^2 + z^2 - 1";

/// The names of the surfaces in a Gmsh file.
std::vector<std::string> surfaces_in(const std::string& file) {
  std::istringstream lines(read_bytes(file));
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line) && line != "$EndPhysicalNames";) {
    if (line.starts_with("2 ") && line.ends_with("\"")) names.push_back(line.substr(line.find('"') + 1));
  }
  for (std::string& name : names) name.pop_back();
  return names;
}

/// A grey image of 12³ voxels, 100 in a bar along x that both ends of the scan cut, around (x, 5.5, 5.5).
std::string bar_to_the_border() {
  return byte_image({12, 12, 12}, [](int, int j, int k) {
    const double y = j - 5.5;
    const double z = k - 5.5;
    return std::max(0.0, 120 - 20 * std::sqrt(y * y + z * z));
  });
}

TEST(Cuts, BorderIsCappedAndNamedByAnatomy) {
  const TestFolder folder;
  write_bytes(folder / "bar.nrrd", bar_to_the_border());
  const RunResult run = run_scantet({"mesh", folder / "bar.nrrd", "--level", "50", "--size", "1", "--border", "cap",
                                     "-o", folder / "a.msh", "--report", folder / "a.json"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(surfaces_in(folder / "a.msh"), (std::vector<std::string>{"boundary_1_0", "border_right", "border_left"}));
  const nlohmann::json report = read_json(folder / "a.json");
  EXPECT_EQ(report["topology"]["components"], 1);
  // Between the caps at 0 and 11 mm the bar is 11 mm long.
  EXPECT_NEAR(report["mesh"]["volume_mm3"], 11 * 3.14159265 * 3.5 * 3.5, 25) << "within a voxel of the circle";
}

TEST(Cuts, PlanesAreNamedInEveryKindOfInput) {
  const TestFolder folder;
  ASSERT_EQ(run_scantet({"convert", sample("sphere.nrrd"), folder / "a.vdb"}).status, 0);
  const std::vector<std::vector<std::string>> inputs{{sample("sphere.nrrd"), "--level", "127"},
                                                     {folder / "a.vdb", "--level", "127"},
                                                     {kBall, "--bounds", "-2,-2,-2,2,2,2", "--size", "0.3"},
                                                     {sample("labels_shell.nrrd")}};
  for (std::vector<std::string> words : inputs) {
    const std::string input = words[0];
    words.insert(words.begin(), "mesh");
    const bool is_formula = input == kBall;
    for (const std::string& word :
         {std::string("--cut"), std::string(is_formula ? "x < 0.3" : "x + 0.2y < 3"), std::string("--cut"),
          std::string(is_formula ? "clamp: z > -0.2" : "clamp: z > -2"), std::string("-o"), folder / "a.msh"}) {
      words.push_back(word);
    }
    const RunResult run = run_scantet(words);
    ASSERT_EQ(run.status, 0) << input << run.err;
    const std::vector<std::string> names = surfaces_in(folder / "a.msh");
    const auto has = [&](const std::string& start) {
      return std::any_of(names.begin(), names.end(), [&](const std::string& name) { return name.starts_with(start); });
    };
    EXPECT_TRUE(has("cut_1")) << input;
    EXPECT_TRUE(has("clamp")) << input;
  }
}

/// A U of flat faces, 3 x 3 x 1 mm with arms 1 mm wide and 2 long, up along y.
std::string flat_u() {
  return "OFF\n16 10 0\n0 0 0\n3 0 0\n3 3 0\n2 3 0\n2 1 0\n1 1 0\n1 3 0\n0 3 0\n"
         "0 0 1\n3 0 1\n3 3 1\n2 3 1\n2 1 1\n1 1 1\n1 3 1\n0 3 1\n"
         "8 7 6 5 4 3 2 1 0\n8 8 9 10 11 12 13 14 15\n4 0 1 9 8\n4 1 2 10 9\n4 2 3 11 10\n4 3 4 12 11\n4 4 5 13 12\n"
         "4 5 6 14 13\n4 6 7 15 14\n4 7 0 8 15\n";
}

TEST(Cuts, PolyhedraAreCutExactly) {
  const TestFolder folder;
  write_bytes(folder / "u.off", flat_u());
  struct Expected {
    std::vector<std::string> cuts;
    double volume_mm3;
    double area_mm2;
    int components;
  };
  const std::vector<Expected> all{{{"y < 2"}, 5, 22, 1},      // both arms
                                  {{"x < 1.5"}, 3.5, 16, 1},  // across the bottom
                                  {{"y > 1.5"}, 3, 16, 2},    // the arms alone
                                  {{"z + 0.5x < 1.25", "y > 1.5"}, 1.5, 8 + 3 * std::sqrt(0.3125), 2},  // a prism, too
                                  {{"y + 0.5x < 2", "x < 0.9"}, 1.5975, 7.645 + 0.9 * std::sqrt(1.25), 1},
                                  // Along faces, and through edges.
                                  {{"x < 1"}, 3, 14, 1},
                                  {{"y < 1"}, 3, 14, 1},
                                  {{"y > 1"}, 4, 20, 2},
                                  {{"z < 1"}, 7, 30, 1},
                                  {{"x - y < 0"}, 3, 14 + 2 * std::sqrt(2), 2}};
  for (const Expected& expected : all) {
    std::vector<std::string> words{"mesh",           folder / "u.off", "--sharp-edges",  "30", "--size", "0.25", "-o",
                                   folder / "u.vtu", "--report",       folder / "u.json"};
    for (const std::string& cut : expected.cuts) words.insert(words.end(), {"--cut", cut});
    const RunResult run = run_scantet(words);
    ASSERT_EQ(run.status, 0) << expected.cuts[0] << run.err;
    const nlohmann::json report = read_json(folder / "u.json");
    EXPECT_NEAR(report["mesh"]["volume_mm3"], expected.volume_mm3, 1e-8) << expected.cuts[0];
    EXPECT_NEAR(report["topology"]["interfaces"][0]["area_mm2"], expected.area_mm2, 1e-8) << expected.cuts[0];
    EXPECT_EQ(report["topology"]["components"], expected.components) << expected.cuts[0];
  }
}

/// A cube of label 1 of 36 voxels a side, with a sheet of label 2 of 12 × 12 × 1 voxels within.
std::string sheet_in_a_cube() {
  return byte_image({44, 44, 44}, [](int i, int j, int k) {
    const bool is_cube = std::min({i, j, k}) >= 4 && std::max({i, j, k}) < 40;
    const bool is_sheet = k == 22 && std::min(i, j) >= 16 && std::max(i, j) < 28;
    return is_sheet ? 2 : is_cube ? 1 : 0;
  });
}

TEST(Cuts, NoLabelIsLostSilentlyBesideACut) {
  const TestFolder folder;
  write_bytes(folder / "a.nrrd", sheet_in_a_cube());
  const auto run = [&](const std::string& option, const std::string& value, const std::string& size,
                       const std::string& optimize = "full") {
    return run_mesh({folder / "a.nrrd", "--labels", "all", "--size", size, option, value, "--optimize", optimize});
  };
  const Meshed capped = run("--border", "cap", "20", "none");
  EXPECT_EQ(capped.result.status, 4);
  EXPECT_NE(capped.result.err.find("144 voxels of region_2"), std::string::npos) << capped.result.err;
  EXPECT_EQ(capped.report["regions"][2]["voxels_kept"], 0);
  EXPECT_FALSE(capped.report["regions"][1]["off_voxels_percent"].is_null()) << "the border cuts nothing of it";
  const Meshed cut = run("--cut", "z < 38", "20", "none");
  EXPECT_EQ(cut.result.status, 4);
  EXPECT_NE(cut.result.err.find("144 voxels of region_2"), std::string::npos) << cut.result.err;
  for (const Meshed& mended : {run("--border", "cap", "20"), run("--cut", "z < 38", "20")}) {
    EXPECT_EQ(mended.result.status, 0) << mended.result.err;
    EXPECT_GT(mended.report["regions"][2]["voxels_kept"], 72);
  }
  const Meshed half = run("--cut", "x < 22.3", "2");
  EXPECT_EQ(half.result.status, 0) << half.result.err;
  EXPECT_NE(half.result.err.find("volumes are not held against those of the voxels for 2 labels"), std::string::npos);
  EXPECT_EQ(half.report["regions"][2]["voxels"], 7 * 12);
  EXPECT_TRUE(half.report["regions"][2]["off_voxels_percent"].is_null());
  EXPECT_TRUE(half.report["regions"][2]["field_mm3"].is_null());
  const Meshed without = run("--cut", "z < 20", "20");
  EXPECT_EQ(without.result.status, 0) << "the cut takes all of label 2: " << without.result.err;
}

/// A box with label 1 up to the layer z = 9 and label 2 from there on.
std::string two_layers() {
  return byte_image({16, 16, 20}, [](int x, int y, int z) {
    const bool in_box = std::min({x, y, z}) > 1 && std::max(x, y) < 14 && z < 18;
    return !in_box ? 0 : z < 10 ? 1 : 2;
  });
}

// Label 1 ends halfway between the layers 9 and 10, and a plane between these would leave a sheet of it.
TEST(Cuts, LabelsGoStraightOnToACutBetweenTwoLayers) {
  const TestFolder folder;
  write_bytes(folder / "a.nrrd", two_layers());
  const auto run = [&](const std::string& cut) {
    return run_mesh({folder / "a.nrrd", "--labels", "all", "--size", "4", "--cut", cut});
  };
  const Meshed without = run("z > 9.2");
  EXPECT_EQ(without.result.status, 0) << without.result.err;
  ASSERT_EQ(without.report["regions"].size(), 2U) << without.report["regions"];
  EXPECT_EQ(without.report["regions"][1]["region"], 2);
  const Meshed nothing = run("z > 17.5");
  EXPECT_EQ(nothing.result.status, 3);
  EXPECT_NE(nothing.result.err.find("the cuts leave nothing of the object"), std::string::npos) << nothing.result.err;
  const Meshed with = run("z > 8.8");
  EXPECT_EQ(with.result.status, 0) << with.result.err;
  ASSERT_EQ(with.report["regions"].size(), 3U) << with.report["regions"];
  EXPECT_EQ(with.report["regions"][1]["voxels"], 12 * 12) << "those of the layer 9";
  EXPECT_EQ(with.report["regions"][1]["voxels_kept"], 12 * 12);
}

/// The probability of one label of a map of unsigned bytes, as 255ths.
std::string probability_of(char label, std::string file) {
  const std::size_t head = file.find("\n\n") + 2;
  for (std::size_t n = head; n < file.size(); ++n) file[n] = static_cast<char>(file[n] == label ? 255 : 0);
  return file;
}

TEST(Cuts, TissuesGoStraightOnToACutBetweenTwoLayers) {
  const TestFolder folder;
  write_bytes(folder / "low.nrrd", probability_of(1, two_layers()));
  write_bytes(folder / "high.nrrd", probability_of(2, two_layers()));
  const Meshed run =
      run_mesh({folder / "low.nrrd", "--tissue", folder / "high.nrrd", "--size", "4", "--cut", "z > 9.2"});
  EXPECT_EQ(run.result.status, 0) << run.result.err;
  ASSERT_EQ(run.report["regions"].size(), 2U) << run.report["regions"];
  EXPECT_EQ(run.report["regions"][1]["name"], "high");
}

// A bar that the plane cuts, and beside it two lone voxels, far smaller than the size.
TEST(Cuts, WholeComponentsAreKeptBesideACut) {
  const TestFolder folder;
  const std::string file = byte_image({24, 16, 16}, [](int x, int y, int z) {
    const bool in_bar = x > 2 && x < 21 && y > 1 && y < 8 && z > 1 && z < 8;
    const bool is_lone = (x == 4 || x == 8) && y == 13 && z == 13;
    return in_bar || is_lone ? 100 : 0;
  });
  write_bytes(folder / "bar.nrrd", file);
  const RunResult run = run_scantet({"mesh", folder / "bar.nrrd", "--level", "50.5", "--size", "6", "--cut", "x < 15",
                                     "-o", folder / "a.vtu", "--report", folder / "a.json"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("meet, or come near, 1 of the object's components"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("of the others 2 are left whole"), std::string::npos) << run.err;
  const nlohmann::json report = read_json(folder / "a.json");
  ASSERT_EQ(report["notes"].size(), 1U) << report["notes"];
  EXPECT_NE(run.err.find(report["notes"][0]), std::string::npos) << run.err;
  const nlohmann::json topology = report["topology"];
  EXPECT_EQ(topology["components"], 3);
  EXPECT_EQ(topology["handle_check"]["compared"], 2);
}

TEST(Cuts, WhatMakesNoSenseIsRefused) {
  const std::vector<std::string> ball{sample("sphere.nrrd"), "--level", "127", "--size", "3"};
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.begin(), ball.begin(), ball.end());
    return run_mesh(more).result;
  };
  const RunResult malformed = run({"--cut", "x = 3"});
  EXPECT_EQ(malformed.status, 2);
  EXPECT_NE(malformed.err.find("--cut: \"x = 3\" is no plane: it has neither < nor >"), std::string::npos);
  EXPECT_NE(malformed.err.find("clamp: z > -40"), std::string::npos) << "the form is told";
  const RunResult nothing = run({"--cut", "x > 1000"});
  EXPECT_EQ(nothing.status, 3);
  EXPECT_NE(nothing.err.find("the cuts leave nothing of the object"), std::string::npos);
  const RunResult missed = run({"--cut", "x < 1000"});
  EXPECT_EQ(missed.status, 0);
  EXPECT_NE(missed.err.find("the plane of cut_1 does not meet the object"), std::string::npos) << missed.err;
  const RunResult borderless = run_mesh({kBall, "--bounds", "-2,-2,-2,2,2,2", "--border", "cap"}).result;
  EXPECT_EQ(borderless.status, 2);
  EXPECT_NE(borderless.err.find("has no border"), std::string::npos);
}

}  // namespace
}  // namespace scantet
