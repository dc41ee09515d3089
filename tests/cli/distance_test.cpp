// Distances between the mesh and the surface, from the command line to the report.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "meshed.h"

namespace scantet {
namespace {

using nlohmann::json;

Meshed mesh_at_3mm(std::vector<std::string> options) {
  options.insert(options.begin(), {"--size", "3", "-o", "a.mesh"});
  return mesh_torus_at("0.5", options);
}

const json* bound_of(const json& report, const std::string& name) {
  for (const json& bound : report["bounds"]) {
    if (bound["name"] == name) return &bound;
  }
  return nullptr;
}

TEST(DistanceContract, IsMeasuredUnasked) {
  const Meshed run = mesh_at_3mm({});
  EXPECT_EQ(run.result.status, 0) << run.result.err;
  for (const char* way : {"to_mesh", "to_surface"}) {
    const json& d = run.report["distance"][way];
    EXPECT_GT(d["lower_mm"], 0);
    EXPECT_GE(d["upper_mm"], d["lower_mm"]);
    EXPECT_LT(d["upper_mm"].get<double>(), 1.4 * d["lower_mm"].get<double>());
    EXPECT_EQ(d["worst"][0]["distance_mm"], d["lower_mm"]);
    EXPECT_FALSE(d.contains("beyond"));
  }
  EXPECT_NE(run.result.out.find("surface to mesh: "), std::string::npos) << run.result.out;
  EXPECT_EQ(bound_of(run.report, "max_distance_to_mesh_mm"), nullptr);
}

TEST(DistanceContract, IsKeptWhereItCan) {
  const json free = mesh_at_3mm({}).report["distance"];
  const double half =
      0.5 * std::max(free["to_mesh"]["lower_mm"].get<double>(), free["to_surface"]["lower_mm"].get<double>());
  const Meshed run = mesh_at_3mm({"--max-distance", std::to_string(half)});
  EXPECT_EQ(run.result.status, 0) << run.result.err;
  for (const char* way : {"to_mesh", "to_surface"}) {
    const json& d = run.report["distance"][way];
    EXPECT_LE(d["upper_mm"].get<double>(), half + 1e-9);
    EXPECT_EQ(d["beyond"], 0);
  }
  ASSERT_NE(bound_of(run.report, "max_distance_to_mesh_mm"), nullptr);
  EXPECT_EQ((*bound_of(run.report, "max_distance_to_mesh_mm"))["broken"], 0);
  ASSERT_NE(bound_of(run.report, "max_distance_to_surface_mm"), nullptr);
}

TEST(DistanceContract, IsTheSameForAnyNumberOfThreads) {
  const TestFolder folder;
  std::vector<std::string> meshes;
  for (const char* threads : {"1", "2", "4"}) {
    const RunResult run = run_scantet({"mesh", sample("torus.nrrd"), "--level", "0.5", "--size", "3", "--max-distance",
                                       "0.2", "--threads", threads, "-o", "a.mesh"},
                                      {folder.path()});
    EXPECT_NE(run.status, 1) << run.err;
    std::ifstream file(folder / "a.mesh", std::ios::binary);
    meshes.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    EXPECT_GT(meshes.back().size(), 1000U);
  }
  EXPECT_EQ(meshes[0], meshes[1]);
  EXPECT_EQ(meshes[0], meshes[2]);
}

TEST(DistanceContract, IsToldWhereItIsNotKept) {
  const Meshed run = mesh_at_3mm({"--max-distance", "0.1", "--max-vertices", "900"});
  EXPECT_EQ(run.result.status, 4) << run.result.err;
  const json& d = run.report["distance"]["to_mesh"];
  EXPECT_GT(d["beyond"], 0);
  EXPECT_GT(d["beyond"], d["undecided"]);
  const json* const bound = bound_of(run.report, "max_distance_to_mesh_mm");
  ASSERT_NE(bound, nullptr);
  EXPECT_EQ((*bound)["broken"], d["beyond"]);
  EXPECT_EQ((*bound)["of"], d["parts"]);
  EXPECT_GT((*bound)["worst"], 0.1);
  EXPECT_NE(run.result.err.find("unmet: surface to mesh, mm over 0.1: "), std::string::npos) << run.result.err;
}

TEST(DistanceContract, OfAFormulaIsMeasuredAtPoints) {
  const TestFolder folder;
  const RunResult run = run_scantet(
      {"mesh", "implicit:x^2+y^2+z^2-1", "--bounds", "-2,-2,-2,2,2,2", "--size", "0.3", "--report", "a.json"},
      {folder.path()});
  ASSERT_EQ(run.status, 0) << run.err;
  const json report = read_json(folder / "a.json");
  EXPECT_TRUE(report["distance"]["to_mesh"]["upper_mm"].is_null());
  EXPECT_GT(report["distance"]["to_mesh"]["points"], 10);
  EXPECT_NE(run.out.find("at the worst of"), std::string::npos) << run.out;
}

}  // namespace
}  // namespace scantet
