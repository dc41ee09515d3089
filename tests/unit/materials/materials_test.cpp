#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "scantet/base/error.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/field/scan_from_memory.h"
#include "scantet/materials/assign_materials.h"
#include "scantet/materials/sample_means.h"
#include "scantet/materials/tet_means.h"

namespace scantet {
namespace {

/// Two tets, of regions 1 and 2.
TetMesh make_pair() {
  TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  mesh.tet_regions = {1, 2};
  build_boundary(mesh);
  mesh.region_names = {{2, "bone"}};
  return mesh;
}

/// Of 8³ voxels 0.5 mm apart around the mesh.
template <class Value>
ScanValues make_values(const Value& value) {
  std::vector<double> voxels;
  for (int k = 0; k < 8; ++k) {
    for (int j = 0; j < 8; ++j) {
      for (int i = 0; i < 8; ++i) voxels.push_back(value(Point{-1 + 0.5 * i, -1 + 0.5 * j, -1 + 0.5 * k}));
    }
  }
  const Frame frame({Vec{0.5, 0, 0}, Vec{0, 0.5, 0}, Vec{0, 0, 0.5}}, {-1, -1, -1});
  return ScanValues(make_scan(std::move(voxels), {8, 8, 8}, frame));
}

MaterialFile read_text(const std::string& text) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("scantet_materials_" + std::to_string(getpid()) + ".json")).string();
  std::ofstream(path) << text;
  try {
    MaterialFile file = read_material_file(path);
    std::filesystem::remove(path);
    return file;
  } catch (...) {
    std::filesystem::remove(path);
    throw;
  }
}

std::string refusal(const std::string& text) {
  try {
    read_text(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "usage.materials");
    return error.what();
  }
  return "none";
}

constexpr const char* kLaw = R"("file": "ct", "density": {"a": 0.1, "b": 0.001}, "ash": [{"a": 0.05, "b": 0.9}],
    "modulus": [{"below": 0.27, "b": 33900, "c": 2.2}, {"below": 0.6, "a": 469, "b": 5307}, {"b": 10200, "c": 2.01}])";

TEST(MaterialLaw, ValuesByHand) {
  const MaterialLaw law = *read_text(std::string("{\"scan\": {") + kLaw + "}}").law;
  EXPECT_NEAR(law.density_of(400), 0.05 + 0.9 * 0.5, 1e-15);
  EXPECT_EQ(law.density_of(-2000), 0);
  EXPECT_NEAR(law.modulus_of_density(0.2), 33900 * std::pow(0.2, 2.2), 1e-9);
  EXPECT_NEAR(law.modulus_of_density(0.5), 469 + 5307 * 0.5, 1e-9);
  EXPECT_NEAR(law.modulus_of_density(0.27), 469 + 5307 * 0.27, 1e-9);
  EXPECT_NEAR(law.modulus_of_density(1.5), 10200 * std::pow(1.5, 2.01), 1e-9);
}

TEST(MaterialLaw, BinsBeginAtTheLargest) {
  EXPECT_EQ(bins_of({100, 99.9, 50, 49, 0}, 50), (std::vector<double>{0, 1, 1, 2, 2}));
  EXPECT_EQ(bins_of({300, 200, 100}, 1e-12), (std::vector<double>{0, 1e14, 2e14}));  // more than whole numbers count
  EXPECT_EQ(even_bins_of({100, 76, 75, 49, 1, 0}, 4), (std::vector<double>{0, 0, 1, 2, 3, 3}));
  EXPECT_EQ(even_bins_of({7, 7}, 3), (std::vector<double>{0, 0}));
  EXPECT_EQ(even_bins_of({100, 0}, 1), (std::vector<double>{0, 0}));
}

TEST(TetMeans, LinearFieldsHaveTheirValueAtTheCentre) {
  const TetMesh mesh = make_pair();
  const std::vector<double> means = tet_means(
      mesh, make_values([](const Point& p) { return 3 + 2 * p.x - p.y + 5 * p.z; }), [](double x) { return x; });
  EXPECT_NEAR(means[0], 3 + 6 * 0.25, 1e-12);
  EXPECT_NEAR(means[1], 3 + 6 * 0.5, 1e-12);
}

TEST(TetMeans, BendsBetweenVoxelsAreIntegratedExactly) {
  // The mean of |x - 1/2| over the unit tet, by hand: the volume above x = 1/2 is 1/8 of it, with its centre at 5/8.
  const TetMesh mesh = make_pair();
  const std::vector<double> means =
      tet_means(mesh, make_values([](const Point& p) { return std::abs(p.x - 0.5); }), [](double x) { return x; });
  EXPECT_NEAR(means[0], 0.25 + 2 * (1.0 / 8) * (5.0 / 8 - 0.5), 1e-12);
}

TEST(Materials, RegionsAndLawShareTheMesh) {
  TetMesh mesh = make_pair();
  const ScanTable scans{{"ct", make_values([](const Point& p) { return 400 + p.x - 0.5; })}};
  const MaterialFile file = read_text(std::string(R"({"regions": {"1": {"youngs_modulus_mpa": 7, "poissons_ratio": 0.4,
      "density_g_per_cm3": 2, "conductivity": 3}}, "scan": {)") +
                                      kLaw + ", \"regions\": [\"bone\"]}}");
  const auto conductivities = assign_materials(file, scans, mesh);
  ASSERT_EQ(mesh.materials.size(), 2U);
  EXPECT_EQ(mesh.tet_materials, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(mesh.materials[0].youngs_modulus_mpa, 7);
  EXPECT_EQ(mesh.materials[0].density_tonne_per_mm3, 2e-9);
  EXPECT_EQ(conductivities[0], 3);
  EXPECT_FALSE(conductivities[1]);
  EXPECT_NEAR(mesh.materials[1].youngs_modulus_mpa, 469 + 5307 * 0.5, 1e-9);
  EXPECT_NEAR(mesh.materials[1].density_tonne_per_mm3, 0.5e-9, 1e-18);
}

TEST(Materials, WhatIsIntegratedMakesADifference) {
  const ScanTable scans{{"ct", make_values([](const Point& p) { return 1000 * p.x; })}};
  const auto first_modulus = [&](const std::string& what) {
    TetMesh mesh = make_pair();
    assign_materials(
        read_text(R"({"scan": {"file": "ct", "modulus": [{"b": 100, "c": 2}], "integrate": ")" + what + "\"}}"), scans,
        mesh);
    return mesh.materials[mesh.tet_materials[0]].youngs_modulus_mpa;
  };
  // Voxels 0.5 mm apart, so x² between them is linear: at most 1/16 more than x². Its mean over the unit tet is 1/10.
  EXPECT_NEAR(first_modulus("hu"), 100 * 0.25 * 0.25, 1e-9);
  EXPECT_NEAR(first_modulus("density"), 100 * 0.25 * 0.25, 1e-9);
  EXPECT_NEAR(first_modulus("voxels"), 100 * (1 + 3 * 0.25) / 10, 1e-9);
  EXPECT_NEAR(first_modulus("nodes"), 100.0 / 4, 1e-9);
  EXPECT_GT(first_modulus("modulus"), 10);
  EXPECT_LT(first_modulus("modulus"), 10 + 100.0 / 16);
}

TEST(SampleMeans, VoxelsWithTheirCentresInTheTet) {
  // Centres half a millimetre apart: of the unit tet the ten with i + j + k <= 2, faces included; x² is 1 at one of
  // them, 1/4 at three, 0 at six.
  const TetMesh mesh = make_pair();
  const auto square = [](double x) { return x * x; };
  const std::vector<double> means = voxel_means(mesh, make_values([](const Point& p) { return p.x; }), square);
  EXPECT_NEAR(means[0], (1 + 3 * 0.25) / 10, 1e-15);
}

TEST(SampleMeans, ATetWithoutACentreTakesTheEightAroundItsOwn) {
  TetMesh mesh = make_pair();
  for (Point& p : mesh.vertices) p = {0.1 + 0.2 * p.x, 0.1 + 0.2 * p.y, 0.1 + 0.2 * p.z};
  const auto square = [](double x) { return x * x; };
  const std::vector<double> means = voxel_means(mesh, make_values([](const Point& p) { return p.x; }), square);
  EXPECT_NEAR(means[0], 0.25 / 2, 1e-15);  // x is 0 or 1/2 at these
}

TEST(SampleMeans, CornersOfTheTet) {
  const TetMesh mesh = make_pair();
  const auto square = [](double x) { return x * x; };
  const ScanValues scan = make_values([](const Point& p) { return 2 * p.x; });
  const std::vector<double> means = corner_means(mesh, scan, square);
  EXPECT_NEAR(means[0], 1, 1e-12);  // 4 at one of four
  EXPECT_NEAR(means[1], 2, 1e-12);  // at two of four
}

TEST(Materials, PlacesComeBeforeRegionsInTheirOrder) {
  TetMesh mesh = make_pair();  // the second tet's centre is at 0.5, 0.5, 0.5
  const MaterialFile file = read_text(R"json({"places": [
      {"name": "cement", "where": "ball(0.5, 0.5, 0.5, 0.1)", "youngs_modulus_mpa": 2000, "poissons_ratio": 0.3},
      {"name": "rest", "where": "box(-1, -1, -1, 2, 2, 2)", "youngs_modulus_mpa": 5, "poissons_ratio": 0.3, "conductivity": 4}],
      "regions": {"bone": {"youngs_modulus_mpa": 9, "poissons_ratio": 0.3}}})json");
  const auto conductivities = assign_materials(file, {}, mesh);
  ASSERT_EQ(mesh.materials.size(), 2U) << "nothing is left for the region";
  EXPECT_EQ(mesh.materials[0].name, "cement");
  EXPECT_EQ(mesh.materials[0].youngs_modulus_mpa, 2000);
  EXPECT_EQ(mesh.materials[1].name, "rest");
  EXPECT_EQ(mesh.tet_materials, (std::vector<std::uint32_t>{1, 0}));
  EXPECT_EQ(conductivities[1], 4);
  TetMesh other = make_pair();
  const MaterialFile idle =
      read_text(R"({"places": [{"name": "a", "where": "z > -9"}, {"name": "b", "where": "z > 0"}]})");
  EXPECT_THROW(assign_materials(idle, {}, other), Error) << "nothing is left for the second place";
  EXPECT_THROW(read_text(R"json({"places": [{"name": "a", "where": "bal(0, 0, 0, 1)"}]})json"), Error);
}

TEST(Materials, MistakesAreRefused) {
  EXPECT_NE(refusal("{}").find("neither"), std::string::npos);
  EXPECT_NE(refusal(R"({"places": [{"name": "a"}]})").find("\"where\""), std::string::npos);
  EXPECT_NE(refusal(R"({"places": {}})").find("no list"), std::string::npos);
  EXPECT_NE(refusal("{").find("not valid JSON"), std::string::npos);
  const std::string brackets = std::string(200'000, '[') + std::string(200'000, ']');
  EXPECT_NE(refusal(R"({"scan": {"file": "ct", "regions": )" + brackets + "}}").find("deeply"), std::string::npos);
  EXPECT_NE(refusal(R"({"region": {}})").find("did you mean \"regions\"?"), std::string::npos);
  EXPECT_NE(refusal(R"({"scan": {"file": "ct"}})").find("\"modulus\""), std::string::npos);
  EXPECT_NE(refusal(R"({"scan": {"modulus": [{}]}})").find("\"file\""), std::string::npos);
  EXPECT_NE(refusal(R"({"scan": {"file": "ct", "modulus": [{"below": 1}]}})").find("last piece"), std::string::npos);
  EXPECT_NE(refusal(R"({"scan": {"file": "ct", "modulus": [{}], "bins": {}}})").find("either"), std::string::npos);
  EXPECT_NE(refusal(R"({"regions": {"1": {"poissons_ratio": 0.5}}})").find("out of range"), std::string::npos);
  EXPECT_NE(refusal(R"({"regions": {"1": {"youngs_modulus_mpa": 1000}}})").find("\"poissons_ratio\" is missing"),
            std::string::npos);
  TetMesh mesh = make_pair();
  EXPECT_THROW(assign_materials(read_text(R"({"regions": {"1": {}}})"), {}, mesh), Error);
  EXPECT_THROW(assign_materials(read_text(R"({"regions": {"1": {}, "bones": {}}})"), {}, mesh), Error);
}

}  // namespace
}  // namespace scantet
