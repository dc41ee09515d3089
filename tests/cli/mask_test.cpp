// Masks at half way between their values, where voxels that touch along an edge leave saddles at the level itself.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "byte_image.h"
#include "meshed.h"

namespace scantet {
namespace {

constexpr int kSide = 20;

/// One voxel in twelve, as if by chance, none at the border.
std::vector<bool> salt() {
  std::vector<bool> is_in(kSide * kSide * kSide, false);
  std::uint32_t state = 1;
  for (int k = 1; k < kSide - 1; ++k) {
    for (int j = 1; j < kSide - 1; ++j) {
      for (int i = 1; i < kSide - 1; ++i) {
        state = state * 1664525U + 1013904223U;
        is_in[i + kSide * (j + kSide * k)] = (state >> 16) % 12 == 0;
      }
    }
  }
  return is_in;
}

TEST(Mask, HalfWayHasNoSaddlesAtTheLevel) {
  const TestFolder folder;
  const std::string file = folder / "mask.nrrd";
  const std::vector<bool> is_in = salt();
  write_bytes(file, byte_image({kSide, kSide, kSide},
                               [&](int i, int j, int k) { return is_in[i + kSide * (j + kSide * k)] ? 100 : 0; }));
  for (const char* size : {"1", "4"}) {
    const Meshed run = run_mesh({file, "--level", "50", "--size", size});
    ASSERT_EQ(run.result.status, 0) << size << ": " << run.result.err;
    // Of 370 groups of voxels that share faces two are one in the middle of a cell with five of its corners in.
    EXPECT_EQ(run.report["topology"]["components"], 369) << size;
    EXPECT_TRUE(contains(run.result.err, "51 was taken")) << run.result.err;
    EXPECT_EQ(run.report["options"]["level"], 51) << run.report["options"];
  }
  const RunResult info = run_scantet({"info", file, "--level", "50"});
  EXPECT_TRUE(contains(info.out, "level that is meshed instead")) << info.out;
}

TEST(Mask, AGridOfItGivesTheSameMesh) {
  const TestFolder folder;
  const std::vector<bool> is_in = salt();
  write_bytes(folder / "a.nrrd", byte_image({kSide, kSide, kSide}, [&](int i, int j, int k) {
                return is_in[i + kSide * (j + kSide * k)] ? 1 : 0;
              }));
  ASSERT_EQ(run_scantet({"convert", folder / "a.nrrd", folder / "a.vdb"}).status, 0);
  std::string surfaces[2];
  for (const std::size_t n : {0, 1}) {
    const Meshed run =
        run_mesh({folder / (n == 0 ? "a.nrrd" : "a.vdb"), "--level", "0.5", "--size", "4", "-o", folder / "a.stl"});
    ASSERT_EQ(run.result.status, 0) << run.result.err;
    EXPECT_TRUE(contains(run.result.err, "0.51 was taken")) << run.result.err;
    surfaces[n] = read_bytes(folder / "a.stl").substr(80);  // behind the header, which names the job
  }
  EXPECT_TRUE(surfaces[0] == surfaces[1]);
}

TEST(Mask, WhatIsVerifiedIsTheLevelThatWasTaken) {
  const TestFolder folder;
  const std::string file = folder / "mask.nrrd";
  // Two blocks that share an edge.
  write_bytes(file, byte_image({16, 16, 8}, [](int i, int j, int k) {
                const bool low = i >= 2 && i < 8 && j >= 2 && j < 8;
                const bool high = i >= 8 && i < 14 && j >= 8 && j < 14;
                return (low || high) && k >= 2 && k < 6 ? 1 : 0;
              }));
  const Meshed run = run_mesh({file, "--level", "0.5", "--size", "1", "--certify", "bounded", "-o", folder / "a.vtu"});
  ASSERT_EQ(run.result.status, 0) << run.result.err;
  EXPECT_EQ(run.report["topology"]["components"], 2);
  EXPECT_EQ(run.report["certificate"]["grade"], "bounded") << run.report["certificate"];
}

}  // namespace
}  // namespace scantet
