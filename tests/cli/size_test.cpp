// --size and its kin, as users meet them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "meshed.h"

namespace scantet {
namespace {

using nlohmann::json;

Meshed mesh_torus(const std::vector<std::string>& options) {
  return mesh_torus_at("127.5", options);
}

int vertices_of(const Meshed& run) {
  EXPECT_EQ(run.result.status, 0) << run.result.err;
  return run.report.is_null() ? 0 : run.report["mesh"]["vertices"].get<int>();
}

bool says(const Meshed& run, const std::string& text) {
  return run.result.err.find(text) != std::string::npos;
}

TEST(Size, AutoGoesByTheShape) {
  const Meshed run = mesh_torus({"--size", "auto"});
  EXPECT_GT(vertices_of(run), 300);
  EXPECT_EQ(run.report["options"]["size"], "auto");
  EXPECT_EQ(run.report["topology"]["euler"], 0);
  EXPECT_EQ(run.report["rules"]["unmet"]["r2"], 0);
  EXPECT_FALSE(run.report["quality"]["histograms"].contains("size_ratio"));
  EXPECT_TRUE(says(run, "distance to the medial axis")) << run.result.err;
  EXPECT_GT(vertices_of(mesh_torus({"--size", "auto", "--feature-share", "0.2"})), vertices_of(run));
  EXPECT_TRUE(says(mesh_torus({"--size", "auto", "--lipschitz", "1"}), "Lipschitz radius"));
}

TEST(Size, FormulaIsFinerWhereItSays) {
  const Meshed fine = mesh_torus({"--size", "1.5"});
  const Meshed coarse = mesh_torus({"--size", "3"});
  const Meshed half = mesh_torus({"--size", "x < 0 ? 1.5 : 3"});
  EXPECT_LT(vertices_of(half), vertices_of(fine));
  EXPECT_GT(vertices_of(half), vertices_of(coarse));
  EXPECT_EQ(half.report["options"]["size"], "x < 0 ? 1.5 : 3");
  EXPECT_LE(half.report["rules"]["unmet"]["r3"], 0);
  EXPECT_TRUE(half.report["quality"]["histograms"].contains("size_ratio"));
  EXPECT_TRUE(says(half, "mm off")) << "the error of the grid is stated";
}

TEST(Size, OnTheBoundaryMayBeLess) {
  const Meshed plain = mesh_torus({"--size", "3"});
  for (const char* boundary : {"1.5", "1.5 + 0*x"}) {
    const Meshed fine = mesh_torus({"--size", "3", "--boundary-size", boundary});
    EXPECT_GT(vertices_of(fine), 2 * vertices_of(plain)) << boundary;
    EXPECT_EQ(fine.report["rules"]["unmet"]["r2"], 0);
  }
  EXPECT_EQ(vertices_of(mesh_torus({"--size", "3", "--boundary-size", "100 + 0*x"})), vertices_of(plain));
  EXPECT_GT(vertices_of(mesh_torus({"--size", "3", "--boundary-size", "auto"})), vertices_of(plain));
}

TEST(Size, OfARegion) {
  const Meshed plain = mesh_torus({"--size", "3"});
  EXPECT_GT(vertices_of(mesh_torus({"--size", "3", "--region-size", "1=1.5"})), 2 * vertices_of(plain));
  const Meshed none = mesh_torus({"--size", "3", "--region-size", "2=1.5"});
  EXPECT_EQ(none.result.status, 2);
  EXPECT_TRUE(says(none, "--region-size: the object has no region 2")) << none.result.err;
}

// A formula lists no regions.
TEST(Size, OfARegionThatIsNotListed) {
  const std::vector<std::string> job{"mesh", "implicit:torus", "--size", "0.2", "--region-size"};
  const auto run = [&](const std::string& size) {
    std::vector<std::string> arguments = job;
    arguments.push_back(size);
    return run_scantet(arguments);
  };
  EXPECT_EQ(run("1=0.1").status, 0);
  const RunResult none = run("2=0.1");
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("--region-size: the object has no region 2"), std::string::npos) << none.err;
}

TEST(Size, ImageInItsOwnFrame) {
  // The torus lies within 13 mm of the origin: 2 x 2 x 2 voxels around it, axes swapped and flipped, fine at negative
  // z.
  const auto image = [](float low, const std::string& origin) {
    std::string bytes =
        "NRRD0005\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: 2 2 2\nspace directions: "
        "(0,0,-40) "
        "(40,0,0) (0,40,0)\nspace origin: " +
        origin + "\nendian: little\nencoding: raw\n\n";
    for (int i = 0; i < 8; ++i) {
      const float size = i % 2 == 0 ? 3.0F : low;
      bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
    }
    return bytes;
  };
  const TestFolder folder;
  write_bytes(folder / "sizes.nrrd", image(0.5F, "(-20,-20,20)"));
  const Meshed run = mesh_torus({"--size", folder / "sizes.nrrd"});
  const Meshed plain = mesh_torus({"--size", "3"});
  EXPECT_GT(vertices_of(run), vertices_of(plain));
  const json checksum = run.report["input"]["sha256"];
  EXPECT_NE(checksum, plain.report["input"]["sha256"]) << "sizes belong to the input";
  const Meshed both = mesh_torus({"--size", folder / "sizes.nrrd", "--boundary-size", folder / "sizes.nrrd"});
  EXPECT_EQ(both.report["input"]["sha256"], checksum);

  write_bytes(folder / "same.nrrd", image(3, "(-20,-20,20)"));
  EXPECT_EQ(mesh_torus({"--size", folder / "same.nrrd"}).result.status, 0);

  write_bytes(folder / "zero.nrrd", image(0, "(-20,-20,20)"));
  const Meshed zero = mesh_torus({"--size", folder / "zero.nrrd"});
  EXPECT_EQ(zero.result.status, 2);
  EXPECT_TRUE(says(zero, "gives 0 mm at (")) << zero.result.err;

  write_bytes(folder / "far.nrrd", image(1, "(500,-20,20)"));
  const Meshed far = mesh_torus({"--size", folder / "far.nrrd"});
  EXPECT_EQ(far.result.status, 3);
  EXPECT_TRUE(says(far, "elsewhere than the object: along axis x")) << far.result.err;

  write_bytes(folder / "cut.nrrd", image(1, "(-20,-20,20)").substr(0, 190));
  EXPECT_EQ(mesh_torus({"--size", folder / "cut.nrrd"}).result.status, 3);
}

TEST(Size, ThatMakesNoSenseIsRefused) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"--size", "1 + foo"}, "it is wrong at character 5"},
      {{"--size", "none.nrrd"}, "none.nrrd: no such file"},
      {{"--size", "x"}, "at ("},
      {{"--size", "sqrt(x)"}, "gives no number at ("},
      {{"--size", "0.0001 + 0*x"}, "--max-vertices"},
      {{"--size", "1e-300"}, "means about 1e+300 vertices"},
      {{"--size", "3", "--boundary-size", "1e-9"}, "--size 3, --boundary-size 1e-9: sizes from 1e-09 mm on"},
      {{"--boundary-size", "-1"}, "--boundary-size: -1 is not a size in mm"},
      {{"--boundary-size", "y"}, "--boundary-size: \"y\" gives -"},
      {{"--size", std::string(100'000, '(')}, "not a size in mm"},
      {{"--size", "no file." + std::string(10'000, 'n')}, "no such file"},
      {{"--region-size", "1=" + std::string(100'000, '1')}, "is not a region and its size"},
      {{"--region-size", "one=1"}, "--region-size: \"one=1\""},
      {{"--feature-share", "0"}, "--feature-share"},
      {{"--lipschitz", "nan"}, "--lipschitz"}};
  for (const auto& [options, message] : cases) {
    const Meshed run = mesh_torus(options);
    EXPECT_EQ(run.result.status, 2) << options[1];
    EXPECT_TRUE(says(run, message)) << options[1] << ": " << run.result.err;
  }
}

TEST(Size, BeyondTheProofsIsSaidToWhoeverSetsABound) {
  const Meshed plain = mesh_torus({"--size", "3"});
  EXPECT_EQ(plain.result.err, "") << "nobody has asked for a bound";
  EXPECT_EQ(plain.report["theory"]["theorem"], "Theorem 3");
  EXPECT_EQ(plain.report["theory"]["needed"][0], "--alpha under 0.2 (here 1)");
  EXPECT_NE(plain.report["theory"]["meaning"].get<std::string>().find("The audit checks"), std::string::npos);
  const std::vector<std::vector<std::string>> bounds{
      {"--alpha", "1"}, {"--facet-radius-edge", "1"}, {"--cell-radius-edge", "2.5"}};
  for (const std::vector<std::string>& bound : bounds) {
    const Meshed run = mesh_torus({"--size", "3", bound[0], bound[1]});
    EXPECT_TRUE(says(run, "note: Theorem 3 proves that refinement ends")) << run.result.err;
    EXPECT_TRUE(says(run, "--alpha under 0.2 (here 1), ")) << run.result.err;
  }
  const Meshed hidden = mesh_torus({"--size", "3", "--alpha", "0.8", "--no-theory"});
  EXPECT_EQ(hidden.result.err, "");
  EXPECT_FALSE(hidden.report.contains("theory"));
  const Meshed proven = mesh_torus({"--size", "6", "--alpha", "0.15", "--facet-radius-edge", "1.2",
                                    "--cell-radius-edge", "16", "--optimize", "none"});
  EXPECT_EQ(proven.result.err, "");
  EXPECT_FALSE(proven.report.contains("theory"));
}

TEST(Size, BoundsFromAConfigurationAreSetByTheUserToo) {
  const TestFolder folder;
  write_bytes(folder / "job.json", "{\"alpha\": 0.9}");
  EXPECT_TRUE(says(mesh_torus({"--size", "3", "--config", folder / "job.json"}), "Theorem 3"));
}

}  // namespace
}  // namespace scantet
