// Label maps, from the command line: told, listed, meshed as they are asked for, and refused where a level is asked of
// them.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "meshed.h"
#include "segmentation.h"

namespace scantet {
namespace {

using nlohmann::json;

TEST(LabelMap, SegmentationOf3DSlicerIsListedAndNoLevelIsAskedOfIt) {
  const TestFolder folder;
  const std::string file = folder / "a.seg.nrrd";
  write_bytes(file, segmentation(kKeys + "Segment0_Name:=bone of the thigh\n"));
  const json info = json::parse(run_scantet({"info", file, "--json"}).out);
  EXPECT_NE(info["labels"]["reason"].get<std::string>().find("Segment0_ID"), std::string::npos);
  EXPECT_EQ(info["labels"]["count"], 4);
  EXPECT_EQ(info["labels"]["regions"], 3);
  EXPECT_EQ(info["labels"]["voxels_2"], 128);
  EXPECT_EQ(info["labels"]["volume_2_mm3"], 128);
  EXPECT_EQ(info["labels"]["name_1"], "bone of the thigh");
  EXPECT_FALSE(info["labels"].contains("name_2"));
  EXPECT_FALSE(info.contains("values")) << "no level is suggested";
  const std::vector<std::vector<std::string>> of_levels{
      {"--level", "1.5"},       {"--inside", "below"},    {"--outside", "0"}, {"--components", "largest"},
      {"--min-component", "1"}, {"--fill-cavities", "1"}, {"--median", "1"},  {"--smooth", "1"},
      {"--resample", "2"},      {"--close-handles", "2"}};
  for (const std::vector<std::string>& option : of_levels) {
    const RunResult refused = run_scantet({"mesh", file, option[0], option[1], "-o", folder / "a.vtu"});
    EXPECT_EQ(refused.status, 3) << option[0];
    EXPECT_NE(refused.err.find(option[0] + ": "), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("is a label map: its header names segments"), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("--as-grey"), std::string::npos) << refused.err;
  }
  EXPECT_EQ(run_scantet({"info", file, "--level", "1.5"}).status, 3);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.seg.nrrd"});
  EXPECT_EQ(run_scantet({"mesh", file, "--level", "1.5", "--as-grey", "--size", "2"}).status, 0);
  EXPECT_EQ(run_scantet({"mesh", file, "--labels", "all", "--as-grey"}).status, 2);
  const json grey = json::parse(run_scantet({"info", file, "--as-grey", "--json"}).out);
  EXPECT_TRUE(grey["values"].contains("suggested_level"));
}

/// Cubes of the labels 5, 9 and 30 in a box of 24 × 10 × 10, apart from each other.
std::string cubes(const std::string& type = "unsigned char", int bytes = 1) {
  std::string file =
      "NRRD0004\ntype: " + type +
      "\ndimension: 3\nspace: left-posterior-superior\nsizes: 24 10 10\nspace directions: (2,0,0) (0,2,0) "
      "(0,0,2)\nkinds: domain domain domain\nendian: little\nencoding: raw\nspace origin: (0,0,0)\n\n";
  for (int n = 0; n < 2400; ++n) {
    const int i = n % 24;
    const int j = n / 24 % 10;
    const int k = n / 240;
    const bool in = i % 8 > 1 && i % 8 < 6 && j > 2 && j < 7 && k > 2 && k < 7;
    file += static_cast<char>(in ? std::array{5, 9, 30}[static_cast<std::size_t>(i / 8)] : 0);
    for (int byte = 1; byte < bytes; ++byte) file += '\0';
  }
  return file;
}

using Regions = std::map<int, std::string>;

/// Regions and their names in the .msh that the command writes with these arguments.
Regions regions_of(const std::vector<std::string>& arguments) {
  const TestFolder folder;
  std::vector<std::string> all{"mesh"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  all.insert(all.end(), {"-o", "a.msh"});
  const RunResult run = run_scantet(all, {folder.path()});
  EXPECT_TRUE(run.status == 0 || run.status == 4) << run.err;
  Regions regions;
  std::istringstream lines(read_bytes(folder / "a.msh"));
  for (std::string line; std::getline(lines, line) && line != "$EndPhysicalNames";) {
    std::istringstream words(line);
    int dimension = 0;
    int region = 0;
    std::string name;
    if (words >> dimension >> region >> name && dimension == 3) regions[region] = name.substr(1, name.size() - 2);
  }
  return regions;
}

TEST(LabelMap, ATerminalDoesNotObeyNames) {
  const TestFolder folder;
  const std::string file = folder / "a.seg.nrrd";
  write_bytes(file, segmentation(kKeys + "Segment0_Name:=\x1b[2Jbone\n"));
  const RunResult info = run_scantet({"info", file});
  EXPECT_EQ(info.out.find('\x1b'), std::string::npos);
  EXPECT_NE(info.out.find("?[2Jbone"), std::string::npos) << info.out;
}

TEST(LabelMap, SmoothingOfLabelsIsRefusedWhereThereAreNone) {
  const RunResult grey = run_scantet({"mesh", sample("sphere.nrrd"), "--level", "127.5", "--label-smoothing", "none"});
  EXPECT_EQ(grey.status, 2);
  EXPECT_NE(grey.err.find("--label-smoothing: it does nothing here"), std::string::npos) << grey.err;
}

TEST(LabelMap, LabelsBecomeRegionsWithTheirNames) {
  const TestFolder folder;
  const std::string file = folder / "a.nrrd";
  write_bytes(file, cubes());
  EXPECT_EQ(regions_of({file}), (Regions{{5, "region_5"}, {9, "region_9"}, {30, "region_30"}}));
  EXPECT_EQ(regions_of({file, "--labels", "5,20-40"}), (Regions{{5, "region_5"}, {30, "region_30"}}));
  EXPECT_EQ(regions_of({file, "--labels", "5, 20-40"}), (Regions{{5, "region_5"}, {30, "region_30"}}));
  write_bytes(folder / "a.nrrd.txt", "5 Femur_L 2001\n9 Femur_R 2002\n77 Nowhere 1\n");
  EXPECT_EQ(regions_of({file}), (Regions{{5, "Femur_L"}, {9, "Femur_R"}, {30, "region_30"}}));
  write_bytes(folder / "names.tsv", "index\tname\tabbreviation\n5\tleft femur\tL\n9\tright femur\tR\n");
  EXPECT_EQ(regions_of({file, "--labels", "all", "--label-names", folder / "names.tsv"}),
            (Regions{{5, "left_femur"}, {9, "right_femur"}, {30, "region_30"}}));
  write_bytes(folder / "groups.txt", "# both femora\n5 2 femur\n9 2\n30 nail\n");
  EXPECT_EQ(regions_of({file, "--labels", folder / "groups.txt"}), (Regions{{2, "femur"}, {30, "nail"}}));
  const Meshed grouped = run_mesh({file, "--labels", folder / "groups.txt", "--size", "2"});
  ASSERT_FALSE(grouped.report.is_null()) << grouped.result.err;
  EXPECT_NEAR(grouped.report["quality"]["regions"][0]["volume_mm3"].get<double>(), 2 * 64 * 8, 0.25 * 2 * 64 * 8);
}

TEST(LabelMap, ReportsHoldEachRegionAgainstItsVoxels) {
  const TestFolder folder;
  const std::string file = folder / "a.nrrd";
  write_bytes(file, cubes());
  write_bytes(folder / "names.txt", "5 left 10 20 30 0\n9 right 40 50 60 0\n");
  const Meshed run = run_mesh({file, "--label-names", folder / "names.txt", "--size", "1.2"});
  ASSERT_EQ(run.result.status, 0) << run.result.err;
  const json& regions = run.report["regions"];
  ASSERT_EQ(regions.size(), 4U);
  EXPECT_EQ(regions[0]["voxels"], 2400 - 3 * 64);
  EXPECT_EQ(regions[1]["name"], "left");
  EXPECT_EQ(regions[1]["color"], "#0a141e");
  for (std::size_t n = 1; n < 4; ++n) {
    EXPECT_EQ(regions[n]["voxels"], 64);
    EXPECT_EQ(regions[n]["voxels_mm3"], 512);
    EXPECT_EQ(regions[n]["components"], 1);
    EXPECT_EQ(regions[n]["field_components"], 1);
    EXPECT_GE(regions[n]["voxels_kept"], 56);
    EXPECT_NEAR(regions[n]["off_voxels_percent"].get<double>(), 0, 20) << "cubes of four voxels a side are rounded off";
    EXPECT_NEAR(regions[n]["off_field_percent"].get<double>(), 0, 5);
    EXPECT_GE(regions[n]["min_dihedral_deg"], 10);
    EXPECT_EQ(regions[n]["neighbors"].size(), 1U);
    EXPECT_EQ(regions[n]["neighbors"][0]["area_mm2"], run.report["topology"]["interfaces"][n - 1]["area_mm2"]);
  }
  EXPECT_NE(run.result.out.find("centres are in the region of their label"), std::string::npos) << run.result.out;
  bool tells_smoothing = false;
  for (const json& phase : run.report["phases"]) tells_smoothing |= phase["part"] == "label smoothing";
  EXPECT_TRUE(tells_smoothing);
}

TEST(LabelMap, AGaussianLosesLabelsAndSaysSo) {
  const std::string shell = sample("labels_shell.nrrd");
  const Meshed run = run_mesh({shell, "--label-smoothing", "1.5", "--size", "3"});
  EXPECT_EQ(run.result.status, 0) << run.result.err;
  EXPECT_NE(run.result.err.find("does not keep labels: "), std::string::npos) << run.result.err;
  EXPECT_NE(run.result.err.find("lost are 2"), std::string::npos) << run.result.err;
  EXPECT_EQ(run.report["mesh"]["regions"].size(), 1U);
  EXPECT_GT(run.report["regions"][1]["voxels"], 1000);
  EXPECT_GT(std::abs(run.report["regions"][1]["off_voxels_percent"].get<double>()), 0.5);
  EXPECT_NE(run.result.err.find("the volume of 1 label of over 1,000 voxels"), std::string::npos) << run.result.err;
  for (const char* const bad : {"-1", "0", "smooth", "1mm", "inf"}) {
    EXPECT_EQ(run_mesh({shell, "--label-smoothing", bad}).result.status, 2) << bad;
  }
  EXPECT_EQ(run_mesh({shell, "--label-smoothing", "none", "--size", "3"}).result.status, 0);
}

TEST(LabelMap, OverlappingSegmentsAreTold) {
  const TestFolder folder;
  std::string file =
      "NRRD0004\ntype: unsigned char\ndimension: 4\nspace: left-posterior-superior\nsizes: 2 8 8 8\nspace directions: "
      "none (1,0,0) (0,1,0) (0,0,1)\nkinds: list domain domain domain\nencoding: raw\nspace origin: (0,0,0)\n"
      "Segment0_ID:=a\nSegment0_Name:=liver\nSegment0_Layer:=0\nSegment0_LabelValue:=1\nSegment0_Color:=1 0 0\n"
      "Segment1_ID:=b\nSegment1_Name:=tumour\nSegment1_Layer:=1\nSegment1_LabelValue:=1\n\n";
  for (int n = 0; n < 512; ++n) {
    const int i = n % 8;
    file += static_cast<char>(i > 0 && i < 7 ? 1 : 0);
    file += static_cast<char>(i > 2 && i < 5 ? 1 : 0);
  }
  write_bytes(folder / "a.seg.nrrd", file);
  EXPECT_EQ(regions_of({folder / "a.seg.nrrd", "--size", "2"}), (Regions{{1, "liver"}, {2, "tumour"}}));
  const json info = json::parse(run_scantet({"info", folder / "a.seg.nrrd", "--json"}).out);
  EXPECT_EQ(info["labels"]["overlapping"], 128);
  EXPECT_EQ(info["labels"]["voxels_1"], 4 * 64);
  EXPECT_EQ(info["labels"]["parts_1"], 2);
  const RunResult run = run_scantet({"mesh", folder / "a.seg.nrrd", "--size", "2"});
  EXPECT_NE(run.err.find("128 voxels are in several segments"), std::string::npos) << run.err;
}

TEST(LabelMap, RegionsAreNamedInSizesAndLayers) {
  const TestFolder folder;
  const std::string file = folder / "a.nrrd";
  write_bytes(file, cubes());
  write_bytes(folder / "a.nrrd.txt", "5 Femur_L 2001\n9 Femur_R 2002\n");
  const auto tets = [](const Meshed& run) {
    std::map<int, std::size_t> counts;
    for (const json& region : run.report["mesh"]["regions"]) counts[region["region"]] = region["tets"];
    return counts;
  };
  auto plain = tets(run_mesh({file, "--size", "3"}));
  auto finer = tets(run_mesh({file, "--size", "3", "--region-size", "Femur_R=1"}));
  EXPECT_GT(finer[9], 4 * plain[9]);
  EXPECT_LT(finer[5], 2 * plain[5]);
  const Meshed layers = run_mesh({file, "--size", "3", "--layers", "4,Femur_L"});
  EXPECT_EQ(layers.result.status, 0) << layers.result.err;
  EXPECT_EQ(layers.report["layers"]["broken"], 0);
  EXPECT_GT(tets(layers)[5], 2 * plain[5]);
  EXPECT_LT(tets(layers)[30], 2 * plain[30]);
  const Meshed unknown = run_mesh({file, "--layers", "2,Femur_X"});
  EXPECT_EQ(unknown.result.status, 2);
  EXPECT_NE(unknown.result.err.find("did you mean Femur_"), std::string::npos) << unknown.result.err;
  EXPECT_EQ(run_mesh({file, "--region-size", "Tibia=1"}).result.status, 2);
}

/// One sheet of voxels, of 1 mm: what a mesh of 2 mm has one tet across.
TEST(LabelMap, LayersAreHeldOrToldWithTheirPlaces) {
  const std::string shell = sample("labels_shell.nrrd");
  const Meshed two = run_mesh({shell, "--layers", "2"});
  EXPECT_EQ(two.result.status, 0) << two.result.err;
  EXPECT_EQ(two.report["layers"]["broken"], 0);
  EXPECT_GT(two.report["layers"]["vertices"], 1000);
  const Meshed stopped = run_mesh({shell, "--layers", "2,2", "--max-vertices", "40000"});
  EXPECT_EQ(stopped.result.status, 4) << "not fine enough by then";
  EXPECT_GT(stopped.report["layers"]["broken"], 0);
  EXPECT_FALSE(stopped.report["layers"]["places"].empty());
  EXPECT_NE(stopped.result.err.find("layers of tets across under 2: "), std::string::npos) << stopped.result.err;
}

TEST(LabelMap, ChoicesThatMakeNoSenseAreRefused) {
  const TestFolder folder;
  const std::string file = folder / "a.nrrd";
  write_bytes(file, cubes());
  const auto refused = [&](const std::vector<std::string>& options, int status, const std::string& says) {
    std::vector<std::string> arguments{"mesh", file};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult run = run_scantet(arguments, {folder.path()});
    EXPECT_EQ(run.status, status) << run.err;
    EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
  };
  refused({"--labels", "5,6"}, 2, "--labels: 6: no voxel of the image has that label");
  refused({"--labels", "10-20"}, 2, "no voxel of the image has a label of that range");
  refused({"--labels", "5,1-9"}, 2, "chosen twice");
  refused({"--labels", "5,,9"}, 2, "no label");
  refused({"--labels", "9-5"}, 2, "no label");
  refused({"--labels", "femur"}, 2, "no table of labels 'femur'");
  refused({"--label-names", "femur"}, 3, "'femur'");
  write_bytes(folder / "t", "5 2 femur\n9 2 tibia\n");
  refused({"--labels", "t"}, 2, "t:2: region 2 is called femur and tibia");
  write_bytes(folder / "t", "5 femur\n8 tibia\n");
  refused({"--labels", "t"}, 2, "t:2: no voxel");
  write_bytes(folder / "t", "femur 5\n");
  refused({"--labels", "t"}, 2, "t:1: \"femur\" is no label");
  refused({"--label-names", "t"}, 3, "no line of 't' has a label and its name");
  write_bytes(folder / "t", "5 0\n9 0\n30 0\n");
  refused({"--labels", "t"}, 3, "all voxels are background");
}

TEST(LabelMap, WhatHoldsNoLabelsIsRefused) {
  const TestFolder folder;
  const auto refused = [&](const std::string& type, int bytes, std::size_t at, const std::string& put,
                           const std::string& says) {
    std::string file = cubes(type, bytes);
    file.replace(file.size() - 2400 * static_cast<std::size_t>(bytes) + at, put.size(), put);
    write_bytes(folder / "b.nrrd", file);
    const RunResult run = run_scantet({"mesh", folder / "b.nrrd", "--labels", "all"});
    EXPECT_EQ(run.status, 3) << run.err;
    EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
  };
  refused("signed char", 1, 7, "\xff", "the label -1 is negative");
  refused("unsigned int", 4, 0, "\xff\xff\xff\xff", "the label 4294967295 is too large");
  refused("float", 4, 0, std::string("\0\0\x20\x40", 4), "the value ");  // 2.5
  write_bytes(folder / "c.nrrd", cubes().substr(0, cubes().size() - 2400) + std::string(2400, '\0'));
  EXPECT_EQ(run_scantet({"mesh", folder / "c.nrrd", "--labels", "all"}).status, 3) << "an empty map";
}

TEST(LabelMap, RegionsMayMeet) {
  const TestFolder folder;
  write_bytes(folder / "a.seg.nrrd", segmentation(kKeys));
  EXPECT_EQ(regions_of({folder / "a.seg.nrrd", "--max-vertices", "3000"}),
            (Regions{{1, "region_1"}, {2, "region_2"}, {3, "region_3"}}));
}

TEST(LabelMap, OneSegmentIsAMask) {
  const TestFolder folder;
  write_bytes(folder / "a.seg.nrrd", segmentation(kKeys, 1));
  EXPECT_EQ(run_scantet({"mesh", folder / "a.seg.nrrd", "--level", "0.5", "--size", "2"}).status, 0);
}

TEST(LabelMap, WithoutTheKeysShellsAreGrey) {
  const TestFolder folder;
  write_bytes(folder / "a.nrrd", segmentation("Segmentation:=no key of a segment\n"));
  EXPECT_EQ(run_scantet({"mesh", folder / "a.nrrd", "--level", "0.5", "--size", "2"}).status, 0);
}

// Atlases, where there: Debian's mricron-data.
TEST(LabelMap, AtlasesAreToldByTheirIntentAndByTheirValues) {
  const std::string folder = "/usr/share/mricron/templates/";
  if (!std::filesystem::exists(folder + "aal.nii.gz")) GTEST_SKIP() << folder << " is not installed";
  const json info = json::parse(run_scantet({"info", folder + "aal.nii.gz", "--json"}).out);
  EXPECT_EQ(info["labels"]["reason"], "its NIfTI intent is 1002, NIFTI_INTENT_LABEL");
  EXPECT_EQ(info["labels"]["count"], 117);
  EXPECT_EQ(info["labels"]["name_116"], "Vermis_10");
  const RunResult refused = run_scantet({"mesh", folder + "aal.nii.gz", "--level", "36.5"});
  EXPECT_EQ(refused.status, 3);
  EXPECT_NE(refused.err.find("NIFTI_INTENT_LABEL"), std::string::npos) << refused.err;
  for (const std::string grey : {"ch2bet.nii.gz", "ch2.nii.gz", "ch2better.nii.gz", "inia19-t1-brain.nii.gz"}) {
    EXPECT_TRUE(json::parse(run_scantet({"info", folder + grey, "--level", "60", "--json"}).out).contains("values"))
        << grey;
  }
}

}  // namespace
}  // namespace scantet
