// Label maps, from the command line: told, listed, and refused where a level is asked of them.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "read_json.h"
#include "run_process.h"

namespace scantet {
namespace {

using nlohmann::json;

/// A segmentation as 3D Slicer writes it: labels 1, 2 and 3 in slabs of a box of 8³. keys: of the segments.
std::string segmentation(const std::string& keys, int labels = 3) {
  std::string file =
      "NRRD0004\ntype: unsigned char\ndimension: 3\nspace: left-posterior-superior\nsizes: 8 8 8\n"
      "space directions: (1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\nencoding: raw\nspace origin: (0,0,0)\n" +
      keys + "\n";
  for (int n = 0; n < 512; ++n) {
    const int i = n % 8;
    file += static_cast<char>(i == 0 || i == 7 ? 0 : 1 + (i - 1) / 2 % labels);
  }
  return file;
}

const std::string kKeys = "Segment0_ID:=Segment_1\nSegment0_LabelValue:=1\n";

TEST(LabelMap, SegmentationOf3DSlicerIsListedAndRefused) {
  const TestFolder folder;
  const std::string file = folder / "a.seg.nrrd";
  write_bytes(file, segmentation(kKeys));
  const json info = json::parse(run_scantet({"info", file, "--json"}).out);
  EXPECT_NE(info["labels"]["reason"].get<std::string>().find("Segment0_ID"), std::string::npos);
  EXPECT_EQ(info["labels"]["count"], 4);
  EXPECT_EQ(info["labels"]["voxels_2"], 128);
  EXPECT_FALSE(info.contains("values")) << "no level is suggested";
  const RunResult refused = run_scantet({"mesh", file, "--level", "1.5", "-o", folder / "a.vtu"});
  EXPECT_EQ(refused.status, 3);
  EXPECT_NE(refused.err.find("is a label map: its header names segments"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("--as-grey"), std::string::npos) << refused.err;
  EXPECT_EQ(run_scantet({"info", file, "--level", "1.5"}).status, 3);
  EXPECT_EQ(run_scantet({"mesh", file}).status, 3) << "and no level is asked for";
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.seg.nrrd"});
  EXPECT_EQ(run_scantet({"mesh", file, "--level", "1.5", "--as-grey", "--size", "2"}).status, 0);
  const json grey = json::parse(run_scantet({"info", file, "--as-grey", "--json"}).out);
  EXPECT_TRUE(grey["values"].contains("suggested_level"));
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
  EXPECT_EQ(info["labels"]["not_listed"], 97);
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
