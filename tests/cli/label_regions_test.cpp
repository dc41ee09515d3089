// Label maps, from the command line: which label is the background, which file they come from, and what their regions'
// surfaces and volumes are; and when values may be labels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "byte_image.h"
#include "meshed.h"
#include "segmentation.h"

namespace scantet {
namespace {

using nlohmann::json;

TEST(LabelMap, AnyLabelCanBeTheBackground) {
  const TestFolder folder;
  const std::string file = folder / "a.seg.nrrd";
  write_bytes(file, segmentation(kKeys));
  const Meshed run = run_mesh({file, "--background", "2", "--size", "2"});
  EXPECT_EQ(run.result.status, 0) << run.result.err;
  EXPECT_NE(run.result.err.find("--background 2: the label 0 is region 4"), std::string::npos) << run.result.err;
  std::map<int, std::uint64_t> voxels;
  for (const json& region : run.report["regions"]) voxels[region["region"].get<int>()] = region["voxels"];
  EXPECT_EQ(voxels, (std::map<int, std::uint64_t>{{0, 128}, {1, 128}, {3, 128}, {4, 128}}));
  EXPECT_EQ(json::parse(run_scantet({"info", file, "--background", "2", "--json"}).out)["labels"]["regions"], 3);
  const std::vector<std::pair<std::vector<std::string>, std::string>> refused{
      {{"--background", "9"}, "no voxel of the image has that label"},
      {{"--background", "1", "--labels", "2,3"}, "it does nothing here"},
      {{"--background", "1", "--as-grey"}, "labels are asked for, too"},
      {{"--background", "-1"}, "--background"},
      {{"--background", "1.5"}, "--background"}};
  for (const auto& [options, why] : refused) {
    std::vector<std::string> line{"mesh", file};
    line.insert(line.end(), options.begin(), options.end());
    const RunResult run_refused = run_scantet(line);
    EXPECT_EQ(run_refused.status, 2) << options[1];
    EXPECT_NE(run_refused.err.find(why), std::string::npos) << run_refused.err;
  }
}

TEST(LabelMap, TheOptionsThatMakeAnImageOneAreNamed) {
  const TestFolder folder;
  const std::string file = folder / "a.nrrd";
  write_bytes(file, segmentation("", 2));  // inside each other, as grey values may be
  write_bytes(folder / "names.txt", "1 one\n2 two\n");
  const auto reason = [&](const std::vector<std::string>& options) {
    std::vector<std::string> line{"info", file, "--json"};
    line.insert(line.end(), options.begin(), options.end());
    return json::parse(run_scantet(line).out)["labels"]["reason"].get<std::string>();
  };
  EXPECT_EQ(reason({"--background", "2"}), "--background says so");
  EXPECT_EQ(reason({"--labels", "all"}), "--labels says so");
  EXPECT_EQ(reason({"--label-names", folder / "names.txt", "--labels", "1,2"}), "--labels and --label-names say so");
}

/// Segments of 3D Slicer in two layers, a box of 8³: one of four sheets in the first, two in the second. hidden: the
/// first lies wholly under the others.
std::string layered(bool hidden) {
  std::string file =
      "NRRD0004\ntype: unsigned char\ndimension: 4\nspace: left-posterior-superior\nsizes: 2 8 8 8\nspace directions: "
      "none (1,0,0) (0,1,0) (0,0,1)\nkinds: list domain domain domain\nencoding: raw\nspace origin: (0,0,0)\n"
      "Segment0_ID:=a\nSegment0_Name:=tumour\nSegment0_Layer:=0\nSegment0_LabelValue:=1\n"
      "Segment1_ID:=b\nSegment1_Name:=liver\nSegment1_Layer:=1\nSegment1_LabelValue:=1\n"
      "Segment2_ID:=c\nSegment2_Name:=spleen\nSegment2_Layer:=1\nSegment2_LabelValue:=2\n\n";
  for (int n = 0; n < 512; ++n) {
    const int i = n % 8;
    file += static_cast<char>(i > 0 && i < 5 ? 1 : 0);
    file += static_cast<char>(i > (hidden ? 0 : 2) && i < 7 ? 1 + i / 5 : 0);
  }
  return file;
}

TEST(LabelMap, SegmentsThatLoseVoxelsToOthersAreNamed) {
  const TestFolder folder;
  const std::string file = folder / "a.seg.nrrd";
  write_bytes(file, layered(true));
  const RunResult hidden = run_scantet({"mesh", file, "--size", "2"});
  EXPECT_EQ(hidden.status, 0) << hidden.err;
  EXPECT_NE(hidden.err.find("nothing is left of tumour: later segments cover it"), std::string::npos) << hidden.err;
  EXPECT_EQ(hidden.err.find("loses"), std::string::npos) << hidden.err;
  EXPECT_EQ(json::parse(run_scantet({"info", file, "--json"}).out)["labels"]["hidden"], "tumour");
  write_bytes(file, layered(false));
  const RunResult part = run_scantet({"mesh", file, "--size", "2"});
  EXPECT_EQ(part.status, 0) << part.err;
  EXPECT_NE(part.err.find("taken for the last of these: tumour loses 128 of 256"), std::string::npos) << part.err;
  EXPECT_EQ(part.err.find("nothing is left"), std::string::npos) << part.err;
  EXPECT_FALSE(json::parse(run_scantet({"info", file, "--json"}).out)["labels"].contains("hidden"));
}

TEST(LabelMap, AShellOneVoxelThickHasTwoBoundarySurfaces) {
  const Meshed run = run_mesh({sample("labels_shell.nrrd"), "--size", "2"});
  std::vector<json> shells;
  for (const json& component : run.report["topology"]["component_list"]) {
    if (component["region"] == 2) shells.push_back(component);
  }
  ASSERT_EQ(shells.size(), 1U);
  EXPECT_EQ(shells[0]["surfaces"], 2);
  EXPECT_EQ(shells[0]["boundary_euler"], 4) << "two spheres, without a hole";
}

/// The same voxels as MetaImage, of which nothing but --labels says that they are labels.
TEST(LabelMap, MetaImageIsMeshedLikeNrrd) {
  const TestFolder folder;
  const std::string nrrd = segmentation(kKeys);
  write_bytes(folder / "a.seg.nrrd", nrrd);
  write_bytes(folder / "a.mha",
              "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nDimSize = 8 8 8\n"
              "ElementSpacing = 1 1 1\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n" +
                  nrrd.substr(nrrd.size() - 512));
  const Meshed mha = run_mesh({folder / "a.mha", "--labels", "all", "--size", "2"});
  EXPECT_EQ(mha.result.status, 0) << mha.result.err;
  EXPECT_EQ(mha.report["mesh"]["regions"].size(), 3U);
  EXPECT_EQ(mha.report["mesh"], run_mesh({folder / "a.seg.nrrd", "--size", "2"}).report["mesh"]);
}

TEST(LabelMap, JunctionCurvesAreTheSameBytesOnAnyNumberOfThreads) {
  const TestFolder folder;
  std::string first;
  for (const char* const threads : {"1", "2", "4"}) {
    const std::string mesh = folder / "a.stl";
    ASSERT_EQ(
        run_scantet({"mesh", sample("labels_octants.nrrd"), "--size", "2", "--threads", threads, "-o", mesh}).status,
        0);
    const std::string bytes = read_bytes(mesh);
    EXPECT_GT(bytes.size(), 10'000U);
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first) << threads;
  }
}

/// The axes of the octants are curves of four regions: of three each, in pairs closer to each other than places that
/// are one. The mesh follows them, and has no vertex inside that all but touches the surface.
TEST(LabelMap, CurvesOfFourRegionsAreFollowedWithoutTinyElements) {
  for (const double size_mm : {1.45, 1.5, 1.6}) {
    const Meshed run = run_mesh({sample("labels_octants.nrrd"), "--size", std::to_string(size_mm)});
    EXPECT_EQ(run.result.status, 0) << size_mm << run.result.err;
    EXPECT_GT(run.report["quality"]["min_edge_length_mm"].get<double>(), 0.005 * size_mm);
  }
}

/// Cubes of 0, 10 and 41 inside each other, whose values tell no labels from grey.
std::string nested_cubes() {
  std::string file =
      "NRRD0004\ntype: int\ndimension: 3\nspace: left-posterior-superior\nsizes: 20 20 20\nspace directions: (1,0,0) "
      "(0,1,0) (0,0,1)\nendian: little\nencoding: raw\nspace origin: (0,0,0)\n\n";
  for (int n = 0; n < 8000; ++n) {
    int off = 0;
    for (const int i : {n % 20, n / 20 % 20, n / 400}) off = std::max({off, 10 - i, i - 9});
    file += static_cast<char>(off < 5 ? 41 : off < 8 ? 10 : 0);
    file += std::string(3, '\0');
  }
  return file;
}

TEST(LabelMap, FewWholeValuesMayNameThings) {
  const TestFolder folder;
  const std::string file = folder / "a.nrrd";
  write_bytes(file, nested_cubes());
  const RunResult asked = run_scantet({"mesh", file});
  EXPECT_EQ(asked.status, 2);
  EXPECT_NE(asked.err.find("hint: try --labels all if its 3 whole values name things, else --level 25.5"),
            std::string::npos)
      << asked.err;
  EXPECT_EQ(json::parse(run_scantet({"info", file, "--json"}).out)["values"]["whole_values"], 3);
  EXPECT_NE(run_scantet({"info", file}).out.find("3 (--labels all if they name things)"), std::string::npos);
  EXPECT_EQ(run_scantet({"mesh", file, "--labels", "all", "--size", "3"}).status, 0);
  const RunResult grey = run_scantet({"mesh", sample("sphere.nrrd")});
  EXPECT_NE(grey.err.find("hint: try --level"), std::string::npos) << grey.err;
}

/// A label map of 32 × 18 × 18 voxels of 1 mm.
template <class Label>
std::string label_map(const Label& label) {
  return byte_image({32, 18, 18}, label);
}

TEST(LabelMap, PartsThatAreJoinedAndCavitiesThatAreLostAreFaults) {
  const TestFolder folder;
  const auto in_block = [](int i, int j, int k) {
    return i >= 3 && i < 29 && std::min(j, k) >= 3 && std::max(j, k) < 15;
  };
  write_bytes(folder / "two.nrrd", label_map([&](int i, int j, int k) { return in_block(i, j, k) && i != 15; }));
  const auto run = [](const std::string& file, const std::string& optimize) {
    return run_mesh({file, "--labels", "all", "--size", "8", "--optimize", optimize});
  };
  const Meshed joined = run(folder / "two.nrrd", "none");
  EXPECT_EQ(joined.result.status, 4);
  EXPECT_NE(joined.result.err.find("parts of labels that lie in one part of the mesh with others"), std::string::npos)
      << joined.result.err;
  const Meshed parted = run(folder / "two.nrrd", "full");
  EXPECT_EQ(parted.result.status, 0) << parted.result.err;
  EXPECT_EQ(parted.report["topology"]["components"], 2);
  // Of 75 voxels: too large to be looked for by itself, too small for a sample of that size.
  write_bytes(folder / "cavity.nrrd", label_map([&](int i, int j, int k) {
                return in_block(i, j, k) && !(i >= 8 && i < 11 && std::min(j, k) >= 6 && std::max(j, k) < 11);
              }));
  const Meshed filled = run(folder / "cavity.nrrd", "none");
  EXPECT_EQ(filled.result.status, 4);
  EXPECT_NE(
      filled.result.err.find("cavities of the domain that the mesh has not: 1, the first is the one of 75 voxels"),
      std::string::npos)
      << filled.result.err;
  const Meshed hollow = run(folder / "cavity.nrrd", "full");
  EXPECT_EQ(hollow.result.status, 0) << hollow.result.err;
  EXPECT_EQ(hollow.report["topology"]["cavities"], 1);
}

TEST(LabelMap, CavitiesOfAVoxelAreKept) {
  const TestFolder folder;
  write_bytes(folder / "cavity.nrrd", label_map([&](int i, int j, int k) {
                const bool is_cavity = (i == 9 && j == 8 && k == 9) || (i == 20 && j == 9 && k == 8);
                return i >= 3 && i < 29 && std::min(j, k) >= 3 && std::max(j, k) < 15 && !is_cavity;
              }));
  for (const char* size : {"4", "6", "8"}) {
    const Meshed run = run_mesh({folder / "cavity.nrrd", "--labels", "all", "--size", size});
    EXPECT_EQ(run.result.status, 0) << size << ": " << run.result.err;
    EXPECT_EQ(run.report["topology"]["cavities"], 2) << size;
  }
}

/// A label map of two balls in contact, 1 and 2 from left to right.
std::string two_balls() {
  std::string bytes = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 40 28 28\nencoding: raw\n\n";
  for (int k = 0; k < 28; ++k) {
    for (int j = 0; j < 28; ++j) {
      for (int i = 0; i < 40; ++i) {
        const auto apart = [&](double x) { return std::hypot(i - x, j - 13.6, k - 13.8); };
        bytes += static_cast<char>(apart(12.3) < 9.2 ? 1 : apart(25.4) < 8.1 ? 2 : 0);
      }
    }
  }
  return bytes;
}

// Facets cut off what is round; interfaces run so that the volumes of the mesh are those of the voxels.
TEST(LabelMap, VolumesOfTheMeshAreThoseOfTheVoxels) {
  const TestFolder folder;
  const std::string file = folder / "balls.nrrd";
  write_bytes(file, two_balls());
  for (const char* size : {"1.5", "2", "3"}) {
    const Meshed run = run_mesh({file, "--labels", "all", "--size", size});
    ASSERT_EQ(run.result.status, 0) << run.result.err;
    for (std::size_t n = 1; n < 3; ++n) {
      const json& region = run.report["regions"][n];
      EXPECT_NEAR(region["off_voxels_percent"].get<double>(), 0, 0.25) << size << " " << n;
      EXPECT_LT(region["off_field_percent"].get<double>(), -1) << "facets cut off what is round";
    }
  }
}

TEST(LabelMap, VolumesOfLabelsThatACutLeavesWholeAreThoseOfTheVoxels) {
  const TestFolder folder;
  const std::string file = folder / "balls.nrrd";
  write_bytes(file, two_balls());
  const Meshed run = run_mesh({file, "--labels", "all", "--size", "3", "--cut", "x < 27"});
  ASSERT_EQ(run.result.status, 0) << run.result.err;
  EXPECT_NEAR(run.report["regions"][1]["off_voxels_percent"].get<double>(), 0, 0.25);
  EXPECT_TRUE(run.report["regions"][2]["off_voxels_percent"].is_null()) << "it is not known how much is left";
}

TEST(LabelMap, VolumesOfLargeLabelsAreRightOrTold) {
  const std::vector<std::vector<std::string>> right{{"labels_shell.nrrd", "--size", "3"},
                                                    {"labels_voronoi.nrrd", "--size", "3"}};
  const std::vector<std::string> wrong{"labels_shell.nrrd", "--size", "3", "--optimize", "none"};  // not moved
  for (std::vector<std::string> arguments : {right[0], right[1], wrong}) {
    const bool is_right = arguments != wrong;
    arguments[0] = sample(arguments[0]);
    const Meshed run = run_mesh(arguments);
    int off = 0;
    for (const json& region : run.report["regions"]) {
      const bool is_large = region["region"] != 0 && region["voxels"] > 1000;
      off += is_large && std::abs(region["off_voxels_percent"].get<double>()) > 0.5 ? 1 : 0;
    }
    EXPECT_EQ(off, is_right ? 0 : 1) << arguments[0];
    const bool told = run.result.err.find("the volume of 1 label of over 1,000 voxels") != std::string::npos;
    EXPECT_EQ(told, !is_right) << run.result.err;
  }
}

TEST(LabelMap, LayersLeaveVolumesAsTheyAre) {
  const Meshed run = run_mesh({sample("labels_shell.nrrd"), "--layers", "2"});
  ASSERT_EQ(run.result.status, 0) << run.result.err;
  for (const json& region : run.report["regions"]) {
    if (region["region"] == 0) continue;
    EXPECT_LT(std::abs(region["off_voxels_percent"].get<double>()), 1.5) << region;
  }
}

TEST(LabelMap, SlackOfSmallElementsIsSaidToDoNothingWhereLabelsMeet) {
  const TestFolder folder;
  const Meshed run = run_mesh({sample("labels_octants.nrrd"), "--size", "3", "--small-slack", "2"});
  EXPECT_NE(run.result.err.find("--small-slack does nothing here"), std::string::npos) << run.result.err;
  write_bytes(folder / "a.nrrd", nested_cubes());
  const Meshed nested = run_mesh({folder / "a.nrrd", "--labels", "all", "--size", "3", "--small-slack", "2"});
  EXPECT_EQ(nested.result.status, 0) << nested.result.err;
  EXPECT_EQ(nested.result.err.find("--small-slack"), std::string::npos) << nested.result.err;
}

}  // namespace
}  // namespace scantet
