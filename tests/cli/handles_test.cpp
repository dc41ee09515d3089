// Thin handles closed before a scan is meshed, from the command line to the report and the certificate; and many kept.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "meshed.h"
#include "read_json.h"
#include "run_process.h"

namespace scantet {
namespace {

using nlohmann::json;

/// A block of 100 in 0, 22 × 14 × 12 voxels of 1 mm, with a tunnel of 2 × 2 voxels through it, one of 6 × 6, and a
/// handle of one voxel's thickness on it.
std::string holed_block() {
  std::string file = "NRRD0004\ntype: unsigned char\ndimension: 3\nsizes: 22 14 12\nencoding: raw\nspacings: 1 1 1\n\n";
  for (int n = 0; n < 22 * 14 * 12; ++n) {
    const std::array<int, 3> p{n % 22, n / 22 % 14, n / 308};
    const auto in = [&](int axis, int low, int high) { return p[axis] >= low && p[axis] <= high; };
    const bool block = in(0, 1, 20) && in(1, 1, 12) && in(2, 1, 7);
    const bool tunnels = (in(0, 3, 4) && in(1, 5, 6)) || (in(0, 10, 15) && in(1, 4, 9));
    const bool handle = p[1] == 11 && ((in(0, 4, 9) && p[2] == 10) || ((p[0] == 4 || p[0] == 9) && in(2, 7, 10)));
    file += static_cast<char>((block && !tunnels) || handle ? 100 : 0);
  }
  return file;
}

TEST(Handles, InfoCountsThemBeforeAndAfter) {
  const TestFolder folder;
  write_bytes(folder / "a.nrrd", holed_block());
  const auto info = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"info", "--json", "a.nrrd", "--level", "50"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult run = run_scantet(arguments, {folder.path()});
    EXPECT_EQ(run.status, 0) << run.err;
    return json::parse(run.out);
  };
  EXPECT_EQ(info({})["components"]["handles"], 3);
  EXPECT_FALSE(info({}).contains("closed_handles"));
  const json one = info({"--close-handles", "1.5"});
  EXPECT_EQ(one["closed_handles"]["before"], 3);
  EXPECT_EQ(one["closed_handles"]["after"], 2);
  EXPECT_EQ(one["closed_handles"]["cuts"], 1);
  EXPECT_EQ(one["closed_handles"]["voxels"], 1);
  EXPECT_EQ(one["components"]["handles"], 2);
  const json two = info({"--close-handles", "4"});
  EXPECT_EQ(two["closed_handles"]["after"], 1);
  EXPECT_EQ(two["closed_handles"]["cuts"], 1);
  EXPECT_EQ(two["closed_handles"]["fillings"], 1);
  EXPECT_EQ(two["components"]["handles"], 1);
  EXPECT_EQ(two["components"]["components"], 1);
  EXPECT_EQ(two["components"]["cavities"], 0);
  EXPECT_EQ(two["values"], info({})["values"]) << "of the scan as it was read";
}

TEST(Handles, WhatIsClosedIsToldMeshedAndCertified) {
  const TestFolder folder;
  write_bytes(folder / "a.nrrd", holed_block());
  const std::string scan = folder / "a.nrrd";
  const std::string mesh = folder / "a.vtu";
  const Meshed run =
      run_mesh({scan, "--level", "50.5", "--close-handles", "4", "--size", "1", "--certify", "bounded", "-o", mesh});
  EXPECT_EQ(run.result.status, 0) << run.result.err;
  EXPECT_TRUE(contains(run.result.err,
                       "note: --close-handles 4 leaves 1 of 3 handles: 1 cut and 1 filling change 5 voxels, "
                       "also for the audit"))
      << run.result.err;
  EXPECT_EQ(run.report["options"]["close-handles"], 4);
  EXPECT_EQ(run.report["topology"]["handles"], 1);
  EXPECT_EQ(run.report["topology"]["handle_check"]["expected_handles"], 1);
  EXPECT_NE(run.report["certificate"]["grade"], "undecided");
  const std::vector<std::string> verify{"verify", mesh, "--against", scan, "--level", "50.5", "--require", "bounded"};
  EXPECT_EQ(run_scantet(verify).status, 4) << "the scan as it was read has three";
  std::vector<std::string> closed = verify;
  closed.insert(closed.end(), {"--close-handles", "4"});
  EXPECT_EQ(run_scantet(closed).status, 0);
}

TEST(Handles, NothingIsChangedWithoutNeed) {
  const TestFolder folder;
  const auto mesh_with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"mesh", sample("torus.nrrd"), "--level", "300.5", "--size", "2", "-o", "a.stl"});
    const RunResult run = run_scantet(more, {folder.path()});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(contains(run.err, "there is no handle so thin"), more.size() > 8) << run.err;
    return read_bytes(folder / "a.stl");
  };
  EXPECT_EQ(mesh_with({}), mesh_with({"--close-handles", "0.5"}));
}

TEST(Handles, WhatMakesNoSenseIsRefused) {
  const auto expect = [](const std::vector<std::string>& options, int status, const std::string& part) {
    const TestFolder folder;
    std::vector<std::string> arguments{"mesh", sample("torus.nrrd"), "-o", folder / "a.vtu"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult run = run_scantet(arguments);
    EXPECT_EQ(run.status, status) << run.err;
    EXPECT_TRUE(contains(run.err, part)) << run.err;
    EXPECT_TRUE(folder.names().empty());
  };
  for (const std::string value : {"0", "-1", "nan", "inf", "thin"}) {
    expect({"--level", "300", "--close-handles", value}, 2, "--close-handles: ");
  }
  expect({"--level", "300", "--close-handles", "1e6"}, 2, "--close-handles 1e+06: the image is only ");
  expect({"--level", "300", "--level", "400", "--close-handles", "2"}, 2,
         "--close-handles 2: there are 2 levels, and it is for one");
  expect({"--level", "1e9", "--close-handles", "2"}, 3, "leaves nothing inside");
  expect({"--close-handles", "2"}, 2, "--level is missing");
}

// A brain of 201 handles, most of them thinner than a voxel, where there: Debian's mricron-data.
/// A block of 9 in 0, with a cell of voxels of 5 in it, one more beside these, and a 0 beside that one.
std::string block_around_a_cell_of_five() {
  std::string file = "NRRD0004\ntype: unsigned char\ndimension: 3\nsizes: 10 10 10\nencoding: raw\nspacings: 1 1 1\n\n";
  for (int n = 0; n < 1000; ++n) {
    const std::array<int, 3> p{n % 10, n / 10 % 10, n / 100};
    const auto in = [&](int low, int high) {
      return std::all_of(p.begin(), p.end(), [=](int at) { return at >= low && at <= high; });
    };
    const bool is_five = in(4, 5) || p == std::array{5, 5, 6};
    file += static_cast<char>(is_five ? 5 : in(1, 8) && p != std::array{5, 6, 6} ? 9 : 0);
  }
  return file;
}

TEST(Handles, ThatAreNotKnownAreToldOf) {
  const TestFolder folder;
  write_bytes(folder / "a.nrrd", block_around_a_cell_of_five());
  const auto said = [&](const std::string& level) {
    return run_scantet({"mesh", "a.nrrd", "--as-grey", "--level", level, "-o", "a.vtk"}, {folder.path()}).err;
  };
  EXPECT_TRUE(contains(said("5"), "handles a component or cavity has is not known") ||
              contains(said("5"), "components and cavities have is not known"))
      << said("5");
  EXPECT_FALSE(contains(said("5.5"), "is not known")) << said("5.5");
}

TEST(Handles, AreKeptAtManyPointsBeforeAMeshIsImproved) {
  const std::string scan = "/usr/share/mricron/templates/inia19-t1-brain.nii.gz";
  if (!std::filesystem::exists(scan)) GTEST_SKIP() << scan << " is not installed";
  const Meshed refined = run_mesh({scan, "--level", "100", "--size", "2", "--optimize", "none"});
  EXPECT_EQ(refined.result.status, 4);
  EXPECT_TRUE(contains(refined.result.err, "whose boundary has not the handles of the domain's")) << refined.result.err;
  const Meshed improved = run_mesh({scan, "--level", "100", "--size", "2"});
  EXPECT_EQ(improved.result.status, 0) << improved.result.err;
  EXPECT_EQ(improved.report["stages"][0]["stage"], "boundary sample") << "the time of the mesh before is not lost";
}

}  // namespace
}  // namespace scantet
