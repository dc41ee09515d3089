// What files cannot hold is told, and refused where nothing that was asked for would be in any of them.
#include <gtest/gtest.h>

#include "run_process.h"

namespace scantet {
namespace {

RunResult mesh_with(const std::vector<std::string>& more, const TestFolder& folder) {
  std::vector<std::string> arguments{"mesh", sample("sphere.nrrd"), "--level", "127.5", "--size", "5"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_scantet(arguments, {folder.path()});
}

bool says(const RunResult& run, const std::string& text) {
  return run.err.find(text + "\n") != std::string::npos;
}

TEST(Losses, AreNotedOfEachFile) {
  const TestFolder folder;
  const RunResult run = mesh_with({"--set", "foot=z < -8", "--field", "hu=" + sample("sphere.nrrd"), "-o", "d.elmer",
                                   "-o", "d.mesh", "-o", "d.bdf", "-o", "d.msh", "-o", "d.ply"},
                                  folder);
  EXPECT_EQ(run.status, 0) << run.err;
  for (const char* name : {"d.elmer", "d.mesh", "d.ply"}) {
    EXPECT_TRUE(says(run, std::string("note: ") + name + " holds no sets (foot) and no fields (hu)")) << run.err;
  }
  EXPECT_TRUE(says(run, "note: d.bdf holds no fields (hu)")) << run.err;
  EXPECT_EQ(run.err.find("d.msh"), std::string::npos) << run.err;
  const RunResult bare = mesh_with({"-o", "a.mesh", "-o", "a.stl", "-o", "a.vtk"}, folder);
  EXPECT_EQ(bare.err.find("holds no"), std::string::npos) << "nothing was asked for: " << bare.err;
}

TEST(Losses, WhatNoFileHoldsIsRefused) {
  const std::string field = "hu=" + sample("sphere.nrrd");
  const std::vector<std::vector<std::string>> refused{{"--set", "foot=z < -8", "-o", "a.mesh", "-o", "a.ply"},
                                                      {"--set", "foot=facets: z < -8", "-o", "a.vtu"},
                                                      {"--set", "foot=nodes: z < -8", "-o", "a.stls"},
                                                      {"--field", field, "-o", "a.bdf"},
                                                      {"--quality-fields", "-o", "a.inp", "-o", "a.stl"}};
  for (const std::vector<std::string>& more : refused) {
    const TestFolder folder;
    const RunResult run = mesh_with(more, folder);
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_NE(run.err.find(more[0] + ": it does nothing here: none of the mesh files"), std::string::npos) << run.err;
    EXPECT_TRUE(folder.names().empty());
  }
  const std::vector<std::vector<std::string>> taken{
      {"--set", "foot=z < -8", "-o", "a.stls"},
      {"--set", "foot=facets: z < -8", "--set", "other=nodes: not set(foot)", "-o", "a.vtu"},
      {"--field", field, "-o", "a.stl", "--report", "a.json"},
      {"--field", field}};
  for (const std::vector<std::string>& more : taken) {
    const TestFolder folder;
    const RunResult run = mesh_with(more, folder);
    EXPECT_EQ(run.status, 0) << run.err;
  }
}

TEST(Losses, ConversionsSayThem) {
  const TestFolder folder;
  ASSERT_EQ(mesh_with({"--set", "foot=z < -8", "--field", "hu=" + sample("sphere.nrrd"), "--cut", "lid: z < 8", "-o",
                       "a.msh", "-o", "a.vtu"},
                      folder)
                .status,
            0);
  const auto convert = [&](const std::string& from, const std::string& to) {
    const RunResult run = run_scantet({"convert", from, to}, {folder.path()});
    EXPECT_EQ(run.status, 0) << run.err;
    return run;
  };
  EXPECT_TRUE(says(convert("a.msh", "b.vtu"), "note: b.vtu holds no sets of facets (lid, foot)"));
  EXPECT_EQ(convert("a.vtu", "b.vtk").err, "");
  EXPECT_EQ(convert("b.vtk", "c.vtu").err, "");
  EXPECT_TRUE(says(convert("c.vtu", "c.mesh"), "note: c.mesh holds no sets (foot) and no fields (hu)")) << "by .vtk";
  EXPECT_EQ(convert("c.mesh", "d.vtk").err, "");
  write_bytes(folder / "e.inp",
              "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n*ELEMENT, TYPE=C3D4\n1, 1, 2, "
              "3, 4\n*MATERIAL, NAME=M\n*ELASTIC\n1, 0.3\n");
  EXPECT_TRUE(says(convert("e.inp", "f.inp"), "note: e.inp has what is not read: *MATERIAL, *ELASTIC"));
}

}  // namespace
}  // namespace scantet
