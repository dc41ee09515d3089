// A scan made simpler before it is meshed, from the command line to the report; and tissues that are lost by that, or
// that were nowhere to begin with.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "byte_image.h"
#include "read_json.h"
#include "run_process.h"

namespace scantet {
namespace {

using nlohmann::json;

json info(const std::vector<std::string>& options) {
  std::vector<std::string> arguments{"info", "--json", sample("islands.nii.gz"), "--level", "60"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const RunResult run = run_scantet(arguments);
  EXPECT_EQ(run.status, 0) << run.err;
  return json::parse(run.out);
}

TEST(Simplify, InfoShowsWhatIsLeft) {
  EXPECT_EQ(info({})["components"]["components"], 200);
  EXPECT_LT(info({"--smooth", "0.8"})["components"]["components"].get<int>(), 200);
  EXPECT_EQ(info({"--smooth", "0.8"}), info({"--smooth", "0.8"}));
}

TEST(Simplify, IsToldAndMeshed) {
  const TestFolder folder;
  const RunResult run = run_scantet({"mesh", sample("torus.nrrd"), "--level", "0.5", "--smooth", "1", "--resample", "2",
                                     "-o", "a.mesh", "--report", "a.json"},
                                    {folder.path()});
  ASSERT_NE(run.status, 1) << run.err;
  EXPECT_NE(run.err.find("note: the image is the one after a Gaussian (--smooth 1), a new grid (--resample 2)"),
            std::string::npos)
      << run.err;
  EXPECT_EQ(read_json(folder / "a.json")["options"]["smooth"], 1);
}

TEST(Simplify, ACutIsShownAndMeshed) {
  const json all = info({});
  const json cut = info({"--crop-voxels", "0:9,:,:5"});
  EXPECT_EQ(cut["simplified"]["crop"], "--crop-voxels 0:9,:,:5");
  EXPECT_FALSE(all.contains("simplified"));
  EXPECT_EQ(cut["image"]["size"][0], 10);
  EXPECT_EQ(cut["image"]["size"][1], all["image"]["size"][1]);
  EXPECT_EQ(cut["image"]["size"][2], 6);
  EXPECT_LT(cut["components"]["components"].get<int>(), 200);
  const TestFolder folder;
  const RunResult run = run_scantet({"mesh", sample("torus.nrrd"), "--level", "0.5", "--crop", ":,:0,:", "--smooth",
                                     "1", "--smoothing", "curvature", "--report", "a.json"},
                                    {folder.path()});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("after a cut (--crop :,:0,:), curvature flow (--smooth 1)"), std::string::npos) << run.err;
  const json report = read_json(folder / "a.json");
  EXPECT_EQ(report["options"]["crop"], ":,:0,:");
  EXPECT_EQ(report["topology"]["handle_check"]["handles"], 0) << "half a torus has none";
}

/// A map of bytes on a grid of 16 × 8 × 8: value(i) at all voxels, but `border` at the outermost ones.
template <class Value>
std::string byte_map(const Value& value, int border) {
  return byte_image({16, 8, 8}, [&](int i, int j, int k) {
    const bool inside = std::min({i, j, k}) > 0 && i < 15 && std::max(j, k) < 7;
    return inside ? value(i) : border;
  });
}

TEST(Simplify, TissuesMeanWhatTheyMeantBeforeTheCut) {
  const TestFolder folder;
  write_bytes(folder / "a.nrrd", byte_map([](int i) { return i < 8 ? 240 : 80; }, 0));
  write_bytes(folder / "b.nrrd", byte_map([](int i) { return i < 8 ? 10 : 40; }, 3));
  const auto info = [&](const std::string& box) {
    return run_scantet(
        {"info", "--json", folder / "a.nrrd", "--tissue", folder / "b.nrrd", "--crop-voxels", box + ",:,:"});
  };
  const json kept = json::parse(info("7:15").out)["tissues"];
  EXPECT_EQ(kept["percents"], false);
  EXPECT_EQ(kept["voxels_1"], 36);
  const RunResult none = info("8:15");
  EXPECT_EQ(none.status, 3) << "what is left comes to 120 at most, and is 255ths as before";
  EXPECT_NE(none.err.find("nowhere is a tissue more likely than the background"), std::string::npos) << none.err;
}

TEST(Simplify, TissuesOfBytesAreSmoothed) {
  const TestFolder folder;
  write_bytes(folder / "a.nrrd", byte_map([](int i) { return i < 8 ? 255 : 0; }, 0));
  write_bytes(folder / "b.nrrd", byte_map([](int i) { return i < 8 ? 0 : 250; }, 0));
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {"--smooth", "0.6"}, {"--smooth", "0.6", "--smoothing", "curvature"}, {"--resample", "0.8"}}) {
    std::vector<std::string> arguments{"info", "--json", folder / "a.nrrd", "--tissue", folder / "b.nrrd"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult run = run_scantet(arguments);
    ASSERT_EQ(run.status, 0) << run.err;
    const json tissues = json::parse(run.out)["tissues"];
    EXPECT_NEAR(tissues["volume_1_mm3"].get<double>(), 7 * 36, 70) << options[0];
    EXPECT_NEAR(tissues["volume_2_mm3"].get<double>(), 7 * 36, 70) << options[0];
  }
}

TEST(Tissues, ThoseThatAreNowhereTheMostLikelyAreTold) {
  const TestFolder folder;
  write_bytes(folder / "grey.nrrd", byte_map([](int i) { return i < 8 ? 230 : 25; }, 0));
  write_bytes(folder / "csf.nrrd", byte_map([](int i) { return i == 8 ? 115 : 0; }, 0));
  const std::vector<std::string> maps{folder / "grey.nrrd", "--tissue", folder / "csf.nrrd"};
  const RunResult run = run_scantet({"mesh", maps[0], maps[1], maps[2], "--size", "1.2"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("nowhere is tissue 2 (csf) more likely than all others: it is not in the mesh"),
            std::string::npos)
      << run.err;
  const json info = json::parse(run_scantet({"info", maps[0], maps[1], maps[2], "--json"}).out)["tissues"];
  EXPECT_EQ(info["name_2"], "csf");
  EXPECT_EQ(info["voxels_2"], 0);
}

TEST(Simplify, RefusesWhatMakesNoSense) {
  const auto expect = [](const std::vector<std::string>& options, const std::string& part) {
    const TestFolder folder;
    std::vector<std::string> arguments{"mesh", sample("islands.nii.gz"), "--level", "60", "-o", folder / "a.mesh"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult run = run_scantet(arguments);
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
    EXPECT_TRUE(folder.names().empty());
  };
  expect({"--smooth", "0"}, "--smooth: 0 is not a length in mm: it must be greater than 0");
  expect({"--smooth", "1e9"}, "--smooth 1e+09: the image is only");
  expect({"--median", "99"}, "--median: 99 is not a number of voxels: it must be");
  expect({"--crop", "1000:2000,:,:"}, "--crop: along an axis of the image the box holds fewer than two voxels");
  expect({"--crop-voxels", "3:3,:,:"}, "--crop-voxels: along an axis of the image the box holds fewer than two voxels");
  expect({"--crop", "5:2,:,:"}, "--crop: the range along x runs from 5 to 2 mm: backwards");
  expect({"--crop", "5:6"}, "--crop: \"5:6\" is not a box");
  expect({"--crop", ":,:,:", "--crop-voxels", ":,:,:"}, "--crop says already");
  expect({"--smoothing", "curvature"}, "--smoothing: it does nothing here");
  expect({"--smooth", "1", "--smoothing", "median"}, "--smoothing: ");
  expect({"--fill-cavities", "-1"}, "--fill-cavities: -1 is not a volume in mm^3: it must be greater than 0");
  expect({"--resample", "1e-9"}, "--resample 1e-09: that is more than 4e9 voxels");
}

}  // namespace
}  // namespace scantet
