// Thin parts of labels, in meshes whose elements are many times as wide: bars, tunnels and windows are in them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <vector>

#include "byte_image.h"
#include "meshed.h"

namespace scantet {
namespace {

using nlohmann::json;

using LabelOf = std::function<int(int, int, int)>;  // of a voxel in a block; 0 is the background around it

struct ThinCase {
  const char* name;
  LabelOf label;
  std::map<int, std::int64_t> euler;  ///< of the boundary of each label's region
};

void PrintTo(const ThinCase& thin, std::ostream* out) {
  *out << thin.name;
}

/// Whether a voxel is in one of two balls, 28 voxels apart.
bool in_ball(int i, int j, int k) {
  const auto square = [](int a) { return a * a; };
  return std::min(square(i - 14), square(i - 42)) + square(j - 19) + square(k - 19) < 52;
}

bool is_between(int i) {
  return i >= 14 && i < 42;
}

std::vector<ThinCase> thin_cases() {
  return {
      {"Bar",
       [](int i, int j, int k) { return in_ball(i, j, k) || (is_between(i) && j == 19 && k == 19) ? 1 : 2; },
       {{1, 2}, {2, 4}}},
      {"TwoBars",
       [](int i, int j, int k) {
         return in_ball(i, j, k) || (is_between(i) && (j == 15 || j == 24) && k == 19) ? 1 : 2;
       },
       {{1, 0}, {2, 2}}},
      {"Tunnel", [](int i, int j, int) { return i == 28 && j == 20 ? 0 : 2; }, {{2, 0}}},
      {"Window", [](int i, int j, int k) { return i == 28 && !(j == 20 && k == 20) ? 1 : 2; }, {{1, 0}, {2, 2}}},
      {"Wall",
       [](int i, int j, int k) { return i != 28 && std::min(j, k) >= 8 && std::max(j, k) < 32 ? 1 : 2; },
       {{1, 4}}},
      {"Islands", [](int i, int j, int k) { return i % 9 == 5 && j % 11 == 6 && k % 10 == 7 ? 0 : 2; }, {}},
  };
}

class ThinLabels : public testing::TestWithParam<ThinCase> {};

INSTANTIATE_TEST_SUITE_P(All, ThinLabels, testing::ValuesIn(thin_cases()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(ThinLabels, AreInTheMesh) {
  const TestFolder folder;
  const std::string file = folder / "thin.nrrd";
  write_bytes(file, byte_image({56, 40, 40}, [&](int i, int j, int k) {
                const bool is_in = std::min({i, j, k}) >= 2 && i < 54 && j < 38 && k < 38;
                return is_in ? GetParam().label(i, j, k) : 0;
              }));
  for (const char* size : {"3", "4", "8"}) {
    const Meshed run = run_mesh({file, "--labels", "all", "--size", size});
    ASSERT_EQ(run.result.status, 0) << size << ": " << run.result.err;
    std::map<int, std::int64_t> euler;
    for (const json& component : run.report["topology"]["component_list"]) {
      euler[component["region"].get<int>()] += component["boundary_euler"].get<std::int64_t>();
    }
    for (const auto& [region, expected] : GetParam().euler)
      EXPECT_EQ(euler[region], expected) << region << ", " << size;
  }
}

/// Threads one voxel thick that walk from the middle of 20³ voxels, in any of the 26 directions.
std::vector<char> threads(std::uint32_t seed) {
  const auto next = [&](std::uint32_t below) {
    seed = (seed * 1103515245U + 12345U) & 0x7fffffffU;
    return static_cast<int>((seed >> 16) % below);
  };
  std::vector<char> is_thread(20 * 20 * 20);
  for (int thread = 0; thread < 3; ++thread) {
    std::array<int, 3> at{10, 10, 10};
    std::array<int, 3> step{};
    for (int& d : step) d = next(3) - 1;
    for (int n = 0; n < 40; ++n) {
      if (next(4) == 0) {
        const int turned = next(3) - 1;
        step[static_cast<std::size_t>(next(3))] = turned;
      }
      for (std::size_t axis = 0; axis < 3; ++axis) at[axis] += step[axis];
      if (*std::min_element(at.begin(), at.end()) < 3 || *std::max_element(at.begin(), at.end()) > 16) break;
      is_thread[static_cast<std::size_t>((at[2] * 20 + at[1]) * 20 + at[0])] = 1;
    }
  }
  return is_thread;
}

TEST(Threads, HangTogetherByEdgesAndCornersAsInTheField) {
  for (const std::uint32_t seed : {21U, 39U, 42U}) {
    const TestFolder folder;
    const std::vector<char> is_thread = threads(seed);
    write_bytes(folder / "threads.nrrd", byte_image({20, 20, 20}, [&](int i, int j, int k) {
                  if (is_thread[static_cast<std::size_t>((k * 20 + j) * 20 + i)] != 0) return 3;
                  if (std::min({i, j, k}) < 1 || std::max({i, j, k}) > 18) return 0;
                  return j < 10 ? 1 : 2;
                }));
    const Meshed run = run_mesh({folder / "threads.nrrd", "--labels", "all", "--size", "4"});
    ASSERT_EQ(run.result.status, 0) << seed << ": " << run.result.err;
    for (const json& region : run.report["regions"]) {
      if (region["region"] == 0) continue;
      EXPECT_EQ(region["components"], region["field_components"]) << seed << ": " << region;
    }
  }
}

}  // namespace
}  // namespace scantet
