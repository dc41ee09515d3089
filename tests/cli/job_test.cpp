// The jobs that succeed, and what they say: mesh, info, report, convert, configuration files, limits.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "read_json.h"
#include "run_process.h"

namespace scantet {
namespace {

using nlohmann::json;

std::vector<std::string> mesh_sphere(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"mesh", sample("sphere.nrrd"), "--level", "127.5"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

// What users of JSON reports may count on.
constexpr const char* kStableKeys[] = {"/mesh/vertices",
                                       "/mesh/tets",
                                       "/mesh/boundary_facets",
                                       "/mesh/boundary_vertices",
                                       "/mesh/volume_mm3",
                                       "/quality/min_dihedral_deg",
                                       "/quality/max_dihedral_deg",
                                       "/quality/min_facet_angle_deg",
                                       "/quality/max_radius_edge",
                                       "/quality/max_circumradius_mm",
                                       "/quality/histograms/inverse_aspect/edges",
                                       "/quality/histograms/dihedral_deg/counts",
                                       "/quality/histograms/radius_edge/counts",
                                       "/quality/histograms/edge_length_mm/counts",
                                       "/quality/histograms/size_ratio/counts",
                                       "/quality/statistics/size_ratio/max",
                                       "/rules/r1",
                                       "/rules/r2",
                                       "/rules/r3_1",
                                       "/rules/r3_2",
                                       "/rules/unmet/r1",
                                       "/topology/components",
                                       "/topology/boundary_components",
                                       "/topology/euler",
                                       "/topology/manifold",
                                       "/timing_s/read",
                                       "/timing_s/sample",
                                       "/timing_s/refine",
                                       "/timing_s/audit",
                                       "/timing_s/write",
                                       "/timing_s/total",
                                       "/phases/0/stage",
                                       "/phases/0/part",
                                       "/phases/0/seconds",
                                       "/phases/0/cpu_seconds",
                                       "/options/size",
                                       "/options/level",
                                       "/options/alpha",
                                       "/input/path",
                                       "/input/sha256",
                                       "/input/frame",
                                       "/version",
                                       "/stop"};

TEST(MeshJob, ReportHasTheStableKeys) {
  const TestFolder folder;
  const RunResult run = run_scantet(
      mesh_sphere({"--size", "3", "--optimize", "none", "-o", folder / "a.vtu", "--report", folder / "a.json"}));
  ASSERT_EQ(run.status, 0) << run.err;
  const json report = read_json(folder / "a.json");
  for (const char* key : kStableKeys) {
    EXPECT_TRUE(report.contains(json::json_pointer(key))) << key;
  }
  EXPECT_EQ(report["stop"], "converged");
  EXPECT_EQ(report["topology"]["euler"], 2);
  EXPECT_EQ(report["topology"]["components"], 1);
  EXPECT_EQ(report["options"]["size"], 3.0);
  EXPECT_EQ(report["options"]["level"], 127.5);
  EXPECT_EQ(report["input"]["sha256"].get<std::string>().size(), 64u);
  EXPECT_LE(report["quality"]["max_circumradius_mm"].get<double>(), 3 * (1 + 1e-9));
  EXPECT_LE(report["quality"]["max_radius_edge"].get<double>(), 2 * (1 + 1e-9));
  EXPECT_NEAR(report["mesh"]["volume_mm3"].get<double>(), 12214.84, 0.05 * 12214.84);
}

TEST(MeshJob, DefaultSizeIsTwiceTheSmallestSpacingAndIsSaid) {
  const TestFolder folder;
  const RunResult run = run_scantet(mesh_sphere({"--report", folder / "a.json"}));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(read_json(folder / "a.json")["options"]["size"], 2.0);
  EXPECT_NE(run.err.find("size 2 mm"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("2 x the smallest voxel spacing"), std::string::npos) << run.err;
}

TEST(MeshJob, LimitIsStatus4AndSaysWhichRuleAndWhere) {
  const TestFolder folder;
  const RunResult run = run_scantet(
      mesh_sphere({"--size", "2", "--max-vertices", "800", "-o", folder / "a.vtu", "--report", folder / "a.json"}));
  EXPECT_EQ(run.status, 4) << run.err;
  EXPECT_NE(run.err.find("scantet: unmet: "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("--max-vertices"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("R"), std::string::npos) << run.err;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.json", "a.vtu"}));
  const json report = read_json(folder / "a.json");
  EXPECT_EQ(report["stop"], "limit");
  EXPECT_GT(report["rules"]["unmet"]["r1"].get<int>() + report["rules"]["unmet"]["r2"].get<int>() +
                report["rules"]["unmet"]["r3"].get<int>(),
            0);
}

TEST(MeshJob, ReachesTheDihedralAngleAskedFor) {
  const TestFolder folder;
  for (const char* how : {"exude", "full"}) {
    const RunResult run = run_scantet(
        mesh_sphere({"--size", "3", "--optimize", how, "--min-dihedral", "12", "--report", folder / "a.json"}));
    ASSERT_EQ(run.status, 0) << how << ": " << run.err;
    const json report = read_json(folder / "a.json");
    EXPECT_GE(report["quality"]["min_dihedral_deg"], 12) << how;
    EXPECT_EQ(report["optimization"]["target_deg"], 12);
    EXPECT_EQ(report["optimization"]["tets_below"], 0);
    EXPECT_EQ(report["optimization"]["stages"][0]["stage"], std::string(how) == "full" ? "improve" : how);
    EXPECT_EQ(report["options"]["min-dihedral"], 12);
    EXPECT_EQ(report["options"]["max-dihedral"], 165) << "the value that was kept, though not given";
    for (const json& bound : report["bounds"]) EXPECT_EQ(bound["broken"], 0) << bound;
    EXPECT_EQ(report["bounds"][0]["name"], "min_dihedral_deg");
    EXPECT_EQ(report["bounds"][0]["of"], report["mesh"]["tets"]);
    EXPECT_TRUE(report["timing_s"].contains("optimize"));
  }
}

TEST(MeshJob, EdgesThatStayShortAreStatus4IfABoundIsAskedForAndToldIfNot) {
  const TestFolder folder;
  const RunResult asked = run_scantet(
      mesh_sphere({"--size", "3", "--min-edge", "2.9", "--report", folder / "a.json", "-o", folder / "a.mesh"}));
  EXPECT_EQ(asked.status, 4) << asked.err;
  EXPECT_NE(asked.err.find("edge length, mm under 2.9"), std::string::npos) << asked.err;
  EXPECT_NE(asked.err.find("--min-edge 2.9"), std::string::npos) << asked.err;
  const json report = read_json(folder / "a.json");
  EXPECT_TRUE(report["short_edges"]["is_bound"]);
  EXPECT_GT(report["short_edges"]["count"], 0);
  EXPECT_EQ(report["bounds"].back()["name"], "min_edge_mm");
  EXPECT_EQ(report["bounds"].back()["broken"], report["short_edges"]["count"]);
  EXPECT_LE(report["short_edges"]["places"].size(), 100u);
  EXPECT_EQ(report["audit"]["passed"], true);

  const RunResult plain = run_scantet(mesh_sphere({"--size", "3", "--report", folder / "b.json"}));
  EXPECT_EQ(plain.status, 0) << plain.err;
  const json told = read_json(folder / "b.json")["short_edges"];
  EXPECT_EQ(told["than"], "5% of the size");
  EXPECT_FALSE(told["is_bound"]);
  EXPECT_EQ(told["count"], 0);
  const RunResult none = run_scantet(mesh_sphere({"--size", "3", "--min-edge", "0", "--report", folder / "c.json"}));
  EXPECT_EQ(none.status, 0) << none.err;
  EXPECT_FALSE(read_json(folder / "c.json").contains("short_edges"));
  for (const char* wrong : {"5px", "-1", "60%", "nan"}) {
    EXPECT_EQ(run_scantet(mesh_sphere({"--size", "3", std::string("--min-edge=") + wrong})).status, 2) << wrong;
  }
}

TEST(MeshJob, DihedralAngleThatIsNotReachedIsStatus4AndSaysWhere) {
  const TestFolder folder;
  const RunResult run = run_scantet(mesh_sphere({"--size", "3", "--optimize", "none", "--min-dihedral", "30", "-o",
                                                 folder / "a.vtu", "--report", folder / "a.json"}));
  EXPECT_EQ(run.status, 4);
  EXPECT_NE(run.err.find("--min-dihedral 30"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find(") mm"), std::string::npos) << run.err;
  const json report = read_json(folder / "a.json");
  EXPECT_GT(report["optimization"]["tets_below"], 0);
  EXPECT_EQ(report["bounds"][0]["broken"], report["optimization"]["tets_below"]);
  EXPECT_LT(report["bounds"][0]["worst"], 30);
}

TEST(MeshJob, WithoutOptimizingNoAngleIsAskedForUnlessSaid) {
  const TestFolder folder;
  const RunResult run = run_scantet(mesh_sphere({"--size", "3", "--optimize", "none", "--report", folder / "a.json"}));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_FALSE(read_json(folder / "a.json").contains("optimization"));
}

TEST(MeshJob, ConfigurationFileAndCommandLine) {
  const TestFolder folder;
  write_bytes(folder / "job.json", R"({"level": 127.5, "size": 5, "output": ["a.vtu", "a.stl"], "seed": 3,
                                       "facet-distance": null})");
  const RunResult run = run_scantet(
      {"mesh", sample("sphere.nrrd"), "--config", "job.json", "--size", "4", "--report", "a.json"}, {folder.path()});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.json", "a.stl", "a.vtu", "job.json"}));
  const json options = read_json(folder / "a.json")["options"];
  EXPECT_EQ(options["size"], 4.0) << "the command line wins";
  EXPECT_EQ(options["seed"], 3);
  EXPECT_TRUE(options["facet-distance"].is_null());
}

TEST(MeshJob, OptionsOfAReportAreAConfiguration) {
  const TestFolder folder;
  ASSERT_EQ(
      run_scantet(mesh_sphere({"--size", "4", "--seed", "5", "-o", "a.vtu", "--report", "a.json"}), {folder.path()})
          .status,
      0);
  const std::string mesh = read_bytes(folder / "a.vtu");
  write_bytes(folder / "again.json", read_json(folder / "a.json")["options"].dump());
  ASSERT_EQ(std::remove((folder / "a.vtu").c_str()), 0);
  ASSERT_EQ(run_scantet({"mesh", sample("sphere.nrrd"), "--config", "again.json"}, {folder.path()}).status, 0);
  EXPECT_EQ(read_bytes(folder / "a.vtu"), mesh);
  // The defaults in it ask for nothing: --space matters to no file here, and --alpha is not the user's.
  json options = read_json(folder / "a.json")["options"];
  options.erase("output");
  options.erase("report");
  write_bytes(folder / "again.json", options.dump());
  const RunResult run = run_scantet({"mesh", sample("sphere.nrrd"), "--config", "again.json"}, {folder.path()});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
}

TEST(MeshJob, InsideBelowAndRas) {
  const TestFolder folder;
  const RunResult run = run_scantet({"mesh", sample("shell.mha"), "--level", "1000.5", "--inside", "below", "--space",
                                     "ras", "--report", folder / "a.json", "-o", folder / "a.vtu"});
  ASSERT_EQ(run.status, 0) << run.err;
  const json report = read_json(folder / "a.json");
  EXPECT_EQ(report["topology"]["boundary_components"], 2);
  EXPECT_EQ(report["topology"]["euler"], 4);
  EXPECT_EQ(report["options"]["space"], "ras");
}

TEST(Info, TextAndJsonTellTheSame) {
  const RunResult text = run_scantet({"info", sample("shell.mha"), "--level", "1000.5", "--inside", "below"});
  const RunResult data = run_scantet({"info", sample("shell.mha"), "--level", "1000.5", "--inside", "below", "--json"});
  ASSERT_EQ(text.status, 0) << text.err;
  ASSERT_EQ(data.status, 0) << data.err;
  const json info = json::parse(data.out);
  EXPECT_EQ(info["components"]["components"], 1);
  EXPECT_EQ(info["components"]["cavities"], 1);
  EXPECT_EQ(info["image"]["pixel_type"], "uint16");
  EXPECT_EQ(info["border"]["touches"], false);
  EXPECT_LT(info["values"]["min"].get<double>(), info["values"]["suggested_level"].get<double>());
  EXPECT_LT(info["values"]["suggested_level"].get<double>(), info["values"]["max"].get<double>());
  for (const char* part : {"MetaImage", "uint16", "spacing", "suggested level", "components", "cavities"}) {
    EXPECT_NE(text.out.find(part), std::string::npos) << part;
  }
}

/// A block of 5 × 5 × 5 voxels of 9 in 0; the one in its middle has 4.
std::string block_around_four() {
  std::string file = "NRRD0004\ntype: unsigned char\ndimension: 3\nsizes: 7 7 7\nencoding: raw\nspacings: 1 1 1\n\n";
  for (int n = 0; n < 7 * 7 * 7; ++n) {
    const auto inner = [](int at) { return at >= 1 && at <= 5; };
    const bool block = inner(n % 7) && inner(n / 7 % 7) && inner(n / 49);
    file += static_cast<char>(n == 171 ? 4 : block ? 9 : 0);
  }
  return file;
}

TEST(Info, AndMeshTellThatVoxelsAreAtTheLevel) {
  const TestFolder folder;
  write_bytes(folder / "a.nrrd", block_around_four());
  const auto at_level = [&](const std::string& level) {
    const RunResult run = run_scantet({"info", "--json", "a.nrrd", "--level", level}, {folder.path()});
    EXPECT_EQ(run.status, 0) << run.err;
    return json::parse(run.out)["at_level"];
  };
  EXPECT_EQ(at_level("4"), (json{{"voxels", 1}, {"gaps", 1}, {"clear_level", 4 + 0.38 * 5}}));
  EXPECT_EQ(at_level("5.9"), (json{{"voxels", 0}}));
  const auto said = [&](const std::string& level) {
    return run_scantet({"mesh", "a.nrrd", "--level", level, "-o", "a.vtk"}, {folder.path()}).err;
  };
  EXPECT_NE(said("4").find("note: the level 4 is itself the value of 1 voxel"), std::string::npos) << said("4");
  EXPECT_NE(said("4").find("--level 5.9"), std::string::npos);
  EXPECT_EQ(said("5.9").find("is itself the value"), std::string::npos);
}

TEST(Info, CountsIslandsAndFindsTheBorder) {
  const json islands = json::parse(run_scantet({"info", sample("islands.nii.gz"), "--level", "60", "--json"}).out);
  EXPECT_EQ(islands["components"]["components"], 200);
  const json bar = json::parse(run_scantet({"info", sample("bar.mha"), "--level", "0.5", "--json"}).out);
  EXPECT_EQ(bar["border"]["touches"], true);
  EXPECT_GT(bar["border"]["face_-i_percent"].get<double>(), 0);
  EXPECT_EQ(bar["border"]["face_+i_percent"], 0.0);
}

TEST(Convert, KeepsTheMeshAndReportMeasuresIt) {
  const TestFolder folder;
  ASSERT_EQ(run_scantet(mesh_sphere({"--size", "3", "-o", folder / "a.vtu", "--report", folder / "a.json"})).status, 0);
  const json original = read_json(folder / "a.json");
  for (const char* name : {"b.msh", "b.msh2", "b.mesh", "b.vtk"}) {
    ASSERT_EQ(run_scantet({"convert", folder / "a.vtu", folder / name}).status, 0) << name;
    const RunResult run = run_scantet({"report", folder / name, "--report", folder / "b.json"});
    ASSERT_EQ(run.status, 0) << name << run.err;
    const json converted = read_json(folder / "b.json");
    EXPECT_EQ(converted["mesh"]["tets"], original["mesh"]["tets"]) << name;
    EXPECT_EQ(converted["mesh"]["vertices"], original["mesh"]["vertices"]) << name;
    EXPECT_EQ(converted["mesh"]["boundary_facets"], original["mesh"]["boundary_facets"]) << name;
    EXPECT_EQ(converted["topology"]["euler"], 2) << name;
    EXPECT_NE(run.out.find("dihedral"), std::string::npos) << run.out;
  }
}

// Two tets that share nothing but a vertex: the boundary is pinched there.
const char* const kPinched =
    "MeshVersionFormatted 2\nDimension 3\nVertices\n7\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\n-1 0 0 1\n0 -1 0 "
    "1\n0 0 -1 1\nTetrahedra\n2\n1 2 3 4 1\n1 6 5 7 1\nEnd\n";

// A real scan, where there: its mesh as an Abaqus file is the mesh that the other formats hold.
TEST(Convert, ReadsTheAbaqusFileOfABrainBack) {
  const std::string brain = "/usr/share/mricron/templates/ch2bet.nii.gz";
  if (!std::filesystem::exists(brain)) GTEST_SKIP() << brain << " is not installed";
  const TestFolder folder;
  const std::vector<std::string> job{"mesh", brain, "--level",        "60", "--size",
                                     "6",    "-o",  folder / "a.inp", "-o", folder / "a.vtu"};
  ASSERT_NE(run_scantet(job).status, 2);
  for (const char* name : {"inp", "vtu"}) {
    const std::string copy = folder / (std::string(name) + ".mesh");
    const RunResult run = run_scantet({"convert", folder / (std::string("a.") + name), copy});
    ASSERT_EQ(run.status, 0) << run.err;
  }
  const std::string of_inp = read_bytes(folder / "inp.mesh");
  const std::string of_vtu = read_bytes(folder / "vtu.mesh");
  ASSERT_GT(of_vtu.size(), 100'000U);
  // Coordinates of more than 20 characters are rounded there; everything else is the same.
  EXPECT_EQ(of_inp.substr(of_inp.find("Triangles")), of_vtu.substr(of_vtu.find("Triangles")));
}

TEST(Report, SeveralMeshesGetASectionEach) {
  const TestFolder folder;
  write_bytes(folder / "pinched.mesh", kPinched);
  ASSERT_EQ(run_scantet(mesh_sphere({"--size", "4", "-o", folder / "a.vtu"})).status, 0);
  const RunResult run = run_scantet({"report", "a.vtu", "pinched.mesh", "--report", "r.json"}, {folder.path()});
  EXPECT_EQ(run.status, 4) << run.out << run.err;
  const std::size_t first = run.out.find("a.vtu:\n");
  const std::size_t second = run.out.find("pinched.mesh:\n");
  ASSERT_NE(second, std::string::npos) << run.out;
  EXPECT_LT(first, second);
  EXPECT_NE(run.out.find("2 tets", second), std::string::npos) << run.out;
  EXPECT_NE(run.err.find("scantet: unmet: pinched.mesh: "), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("unmet: a.vtu"), std::string::npos) << run.err;
  const json report = read_json(folder / "r.json");
  ASSERT_EQ(report["meshes"].size(), 2u);
  EXPECT_EQ(report["meshes"][0]["audit"]["passed"], true);
  EXPECT_EQ(report["meshes"][1]["audit"]["passed"], false);
  const RunResult missing = run_scantet({"report", "a.vtu", "none.vtu", "--report", "s.html"}, {folder.path()});
  EXPECT_EQ(missing.status, 3) << missing.err;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.vtu", "pinched.mesh", "r.json"}));
}

TEST(Report, FaultyMeshIsStatus4) {
  const TestFolder folder;
  write_bytes(folder / "pinched.mesh", kPinched);
  const RunResult run = run_scantet({"report", folder / "pinched.mesh"});
  EXPECT_EQ(run.status, 4) << run.out << run.err;
  EXPECT_NE(run.err.find("scantet: unmet: "), std::string::npos) << run.err;
}

}  // namespace
}  // namespace scantet
