// Probability maps, from the command line: what is meshed of them, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "byte_image.h"
#include "meshed.h"

namespace scantet {
namespace {

using nlohmann::json;

/// A map of floats on a grid of 12 × 8 × 8: probability(i) within all but the outermost voxels, 0 there.
template <class Probability>
std::string probability_map(const Probability& probability, const std::string& origin = "(0,0,0)") {
  std::string file =
      "NRRD0004\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: 12 8 8\nspace directions: (1,0,0) "
      "(0,1,0) (0,0,1)\nkinds: domain domain domain\nendian: little\nencoding: raw\nspace origin: " +
      origin + "\n\n";
  for (int n = 0; n < 768; ++n) {
    const int i = n % 12;
    const int j = n / 12 % 8;
    const int k = n / 96;
    const bool inside = std::min({i, j, k}) > 0 && i < 11 && j < 7 && k < 7;
    const auto value = static_cast<float>(inside ? probability(i) : 0);
    file.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  return file;
}

TEST(Tissues, AreMeshedByTheLargestProbability) {
  const TestFolder folder;
  const auto left = [](int i) { return i < 5 ? 1.0 : i == 5 ? 0.7 : 0; };
  write_bytes(folder / "grey.nrrd", probability_map(left));
  write_bytes(folder / "white.nrrd", probability_map([&](int i) { return 1 - left(i); }));
  const Meshed run = run_mesh({folder / "grey.nrrd", "--tissue", folder / "white.nrrd", "--size", "1.2"});
  ASSERT_EQ(run.result.status, 0) << run.result.err;
  const json& regions = run.report["regions"];
  ASSERT_EQ(regions.size(), 3U);
  EXPECT_EQ(regions[1]["name"], "grey");
  EXPECT_EQ(regions[2]["name"], "white");
  EXPECT_EQ(regions[1]["voxels"], 5 * 6 * 6);
  EXPECT_NEAR(regions[1]["volume_mm3"].get<double>(), 180, 25);
  write_bytes(folder / "moved.nrrd", probability_map(left, "(0,0.5,0)"));
  const Meshed moved = run_mesh({folder / "grey.nrrd", "--tissue", folder / "moved.nrrd"});
  EXPECT_EQ(moved.result.status, 3);
  EXPECT_NE(moved.result.err.find("tissue 2 is not on the grid"), std::string::npos) << moved.result.err;
  write_bytes(folder / "large.nrrd", probability_map([](int i) { return 10.0 * i; }));
  EXPECT_EQ(run_mesh({folder / "grey.nrrd", "--tissue", folder / "large.nrrd"}).result.status, 3);
  EXPECT_EQ(run_mesh({folder / "grey.nrrd", "--tissue", folder / "white.nrrd", "--level", "0.5"}).result.status, 2);
  EXPECT_EQ(run_mesh({folder / "grey.nrrd", "--tissue", folder / "white.nrrd", "--as-grey"}).result.status, 2);
}

/// The same maps in one file, one behind the other.
std::string maps_in_one(const std::vector<std::string>& maps) {
  std::string file = maps.front().substr(0, maps.front().find("\n\n") + 2);
  const auto replace = [&](const std::string& from, const std::string& to) {
    file.replace(file.find(from), from.size(), to);
  };
  replace("dimension: 3", "dimension: 4");
  replace("sizes: 12 8 8", "sizes: 12 8 8 " + std::to_string(maps.size()));
  replace("(0,0,1)", "(0,0,1) none");
  replace("kinds: domain domain domain", "kinds: domain domain domain list");
  for (const std::string& map : maps) file += map.substr(map.find("\n\n") + 2);
  return file;
}

TEST(Tissues, MayBeInOneFile) {
  const TestFolder folder;
  const auto left = [](int i) { return i < 5 ? 1.0 : i == 5 ? 0.7 : 0; };
  const std::string grey = probability_map(left);
  const std::string white = probability_map([&](int i) { return 1 - left(i); });
  write_bytes(folder / "grey.nrrd", grey);
  write_bytes(folder / "white.nrrd", white);
  write_bytes(folder / "both.nrrd", maps_in_one({grey, white}));
  write_bytes(folder / "names.txt", "1 grey\n2 white\n");
  const Meshed two = run_mesh({folder / "grey.nrrd", "--tissue", folder / "white.nrrd", "--size", "1.2"});
  const Meshed one = run_mesh({folder / "both.nrrd", "--label-names", folder / "names.txt", "--size", "1.2"});
  ASSERT_EQ(one.result.status, 0) << one.result.err;
  EXPECT_EQ(one.report["regions"], two.report["regions"]);
  EXPECT_EQ(one.report["mesh"]["tets"], two.report["mesh"]["tets"]);
  const json info = json::parse(run_scantet({"info", folder / "both.nrrd", "--json"}).out);
  EXPECT_EQ(info["tissues"]["count"], 2);
  EXPECT_EQ(info["tissues"]["name_2"], "both_2");
  EXPECT_EQ(info["tissues"]["voxels_1"], 5 * 6 * 6);
  EXPECT_EQ(info["tissues"]["parts_1"], 1);
  EXPECT_EQ(info["tissues"]["touches_1"], json({0, 2}));
  const RunResult level = run_scantet({"mesh", folder / "both.nrrd", "--level", "0.5"});
  EXPECT_EQ(level.status, 3);
  EXPECT_NE(level.err.find("holds 2 volumes"), std::string::npos) << level.err;
  write_bytes(folder / "series.nrrd", maps_in_one({grey, probability_map([](int i) { return 10.0 * i; })}));
  const RunResult series = run_scantet({"mesh", folder / "series.nrrd"});
  EXPECT_EQ(series.status, 3);
  EXPECT_NE(series.err.find("these are no probabilities"), std::string::npos) << series.err;
}

/// Three tissues of four voxels along x each, in one file.
std::string three_tissues() {
  const auto slab = [](int first) { return [first](int i) { return i >= first && i < first + 4 ? 0.9 : 0.05; }; };
  return maps_in_one({probability_map(slab(0)), probability_map(slab(4)), probability_map(slab(8))});
}

TEST(Tissues, AreChosenNamedAndGroupedAsLabelsAre) {
  const TestFolder folder;
  const std::string file = folder / "maps.nrrd";
  write_bytes(file, three_tissues());
  write_bytes(folder / "table.txt", "1-2 7 brain\n3 0 air\n");
  const auto tissues = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"info", file, "--json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return json::parse(run_scantet(arguments).out)["tissues"];
  };
  const json all = tissues({"--labels", "all"});
  EXPECT_EQ(all["count"], 3);
  EXPECT_EQ(all["voxels_2"], 4 * 6 * 6);
  const json two = tissues({"--labels", "2-3"});
  EXPECT_EQ(two["count"], 2);
  EXPECT_FALSE(two.contains("voxels_1")) << "is background";
  EXPECT_EQ(two["voxels_2"], 4 * 6 * 6);
  EXPECT_EQ(two["name_3"], "maps_3");
  EXPECT_EQ(two, tissues({"--background", "1"}));
  const Meshed grouped = run_mesh({file, "--labels", folder / "table.txt", "--size", "1.2"});
  ASSERT_EQ(grouped.result.status, 0) << grouped.result.err;
  const json& regions = grouped.report["regions"];
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[1]["region"], 7);
  EXPECT_EQ(regions[1]["name"], "brain");
  EXPECT_EQ(regions[1]["voxels"], 7 * 6 * 6);
  EXPECT_NE(grouped.result.err.find("1 tissue is not chosen, and part of the background"), std::string::npos)
      << grouped.result.err;
}

TEST(Tissues, ChoicesThatCannotBeAreRefused) {
  const TestFolder folder;
  const std::string file = folder / "maps.nrrd";
  write_bytes(file, three_tissues());
  write_bytes(folder / "none.txt", "1-3 0\n");
  const auto refused = [&](const std::vector<std::string>& options, const std::string& why) {
    std::vector<std::string> arguments{"mesh", file, "-o", folder / "a.vtu"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult run = run_scantet(arguments);
    EXPECT_EQ(run.status, 2) << why;
    EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
  };
  refused({"--labels", "3,4"}, "--labels: 4: no voxel of the image has that label");
  refused({"--background", "4"}, "--background: 4: no voxel of the image has that label");
  refused({"--labels", "1", "--background", "2"}, "--labels chooses");
  refused({"--labels", folder / "none.txt"}, "all tissues are background");
  refused({"--label-smoothing", "2"}, "is no label map");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"maps.nrrd", "none.txt"}));
}

TEST(Tissues, BytesOf0And1AreMasks) {
  const TestFolder folder;
  const auto mask = [](int first, int end) {
    return byte_image({12, 8, 8}, [&](int i, int j, int k) {
      return i >= first && i < end && std::min(j, k) > 0 && std::max(j, k) < 7 ? 1 : 0;
    });
  };
  write_bytes(folder / "left.nrrd", mask(1, 7));
  write_bytes(folder / "right.nrrd", mask(5, 11));
  const Meshed run = run_mesh({folder / "left.nrrd", "--tissue", folder / "right.nrrd", "--size", "1.2"});
  ASSERT_EQ(run.result.status, 0) << run.result.err;
  EXPECT_NE(run.result.err.find("the maps' bytes are masks: each is 0 or 1"), std::string::npos) << run.result.err;
  EXPECT_EQ(run.report["regions"][1]["voxels"], 6 * 6 * 6) << "the first one has what both cover";
  EXPECT_EQ(run.report["regions"][2]["voxels"], 4 * 6 * 6);
  const RunResult info = run_scantet({"info", "--json", folder / "left.nrrd", "--tissue", folder / "right.nrrd"});
  EXPECT_EQ(json::parse(info.out)["tissues"]["masks"], true) << info.err;
}

/// Four tissues around each other in 24³ voxels, so blurred that the outer two are in places likely between voxels
/// only.
std::vector<std::string> blurred_shells() {
  constexpr double kBlur = 1.2;  // voxels
  constexpr std::array<double, 5> kRadii{0, 6.3, 8.1, 9.3, 10.6};
  const auto within = [&](double radius, double r) {
    return radius == 0 ? 0 : 1 / (1 + std::exp((r - radius) / kBlur));
  };
  std::vector<std::string> maps(kRadii.size() - 1,
                                "NRRD0004\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: 24 24 24\n"
                                "space directions: (1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\nendian: "
                                "little\nencoding: raw\nspace origin: (0,0,0)\n\n");
  for (int n = 0; n < 24 * 24 * 24; ++n) {
    const double r = std::hypot(n % 24 - 11.5, n / 24 % 24 - 11.5, n / 576 - 11.5);
    for (std::size_t t = 0; t < maps.size(); ++t) {
      const auto value = static_cast<float>(within(kRadii[t + 1], r) - within(kRadii[t], r));
      maps[t].append(reinterpret_cast<const char*>(&value), sizeof value);
    }
  }
  return maps;
}

TEST(Tissues, ThatAreLikelyOnlyBetweenVoxelsMakeNoSlits) {
  const TestFolder folder;
  const std::vector<std::string> maps = blurred_shells();
  std::vector<std::string> arguments{folder / "1.nrrd"};
  for (std::size_t t = 1; t <= maps.size(); ++t) {
    const std::string file = folder / (std::to_string(t) + ".nrrd");
    write_bytes(file, maps[t - 1]);
    if (t > 1) arguments.insert(arguments.end(), {"--tissue", file});
  }
  arguments.insert(arguments.end(), {"--size", "2"});
  const Meshed run = run_mesh(arguments);
  EXPECT_EQ(run.result.status, 0) << run.result.err;
  EXPECT_EQ(run.report["regions"].size(), 5U);
}

}  // namespace
}  // namespace scantet
