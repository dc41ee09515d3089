// How much is wrong with a mesh, and whether another attempt is worth its time.
#include "scantet/app/mesh_faults.h"

#include <gtest/gtest.h>

namespace scantet {
namespace {

constexpr std::size_t kLost = 258;

/// As many losses as that, and further faults.
Faults faults(std::size_t losses, std::size_t others) {
  return {losses, losses + others, losses + others, 0};
}

TEST(MeshFaults, OfHandlesThoseThatAreWrongCountNotThePlacesWhereOneMayBe) {
  Meshing meshing;
  meshing.refined.wrong_handles = {{0, 0, 0}, {10, 0, 0}, {20, 0, 0}};
  meshing.refined.wrong_handle_count = 1;
  EXPECT_EQ(faults_in(meshing), (Faults{1, 1, 1, 0}));
  meshing.loss_count = LossCount{2, 0};
  EXPECT_EQ(faults_in(meshing), (Faults{2, 2, 2, 0}));
  EXPECT_EQ(mesh_faults(meshing, false).handles.size(), 3U);
}

TEST(MeshFaults, AFewHandlesThatAreThereForOthersArePlacesToo) {
  Meshing meshing;
  meshing.refined.mesh.tets.resize(1000);
  meshing.refined.exchanged_handles = {{0, 0, 0}, {10, 0, 0}};
  EXPECT_TRUE(mesh_faults(meshing, false).handles.empty()) << "a sign alone";
  EXPECT_FALSE(finer_may_help(meshing, false));
  meshing.loss_count = LossCount{1, 0};
  const MeshFaults counted = mesh_faults(meshing, false);
  EXPECT_EQ(counted.handles.size(), 2U);
  EXPECT_TRUE(finer_may_help(meshing, false));
  EXPECT_TRUE(has_only_wrong_handles(meshing, counted));
  meshing.refined.wrong_handles = {{20, 0, 0}};
  EXPECT_EQ(mesh_faults(meshing, false).handles.size(), 1U) << "where the Euler number is another";
  meshing.refined.wrong_handles.clear();
  meshing.loss_count = LossCount{4, 0};
  EXPECT_TRUE(mesh_faults(meshing, false).handles.empty()) << "so many do not come right";
  EXPECT_FALSE(has_only_wrong_handles(meshing, counted));
}

TEST(MeshFaults, HandlesAreExchangedWhereTheEulerNumberIsRightAndNothingElseIsLost) {
  const auto are_exchanged = [](std::uint64_t losses, std::uint64_t wrong, std::size_t tangled) {
    Meshing meshing;
    const std::optional<LossCount> counted = LossCount{losses, 0};
    meshing.loss_count = counted;
    meshing.refined.wrong_handle_count = wrong;
    meshing.refined.tangled.resize(tangled);
    return has_exchanged_handles(meshing, mesh_faults(meshing, false));
  };
  EXPECT_TRUE(are_exchanged(2, 0, 0));
  EXPECT_FALSE(are_exchanged(2, 1, 0)) << "the Euler number tells";
  EXPECT_FALSE(are_exchanged(2, 0, 1)) << "there is more to mend first";
  EXPECT_FALSE(are_exchanged(0, 0, 0));
}

TEST(MeshFaults, CavitiesThatAreLostHavePlacesAndCountOnce) {
  Meshing meshing;
  meshing.refined.mesh.tets.resize(1000);
  const std::optional<LossCount> counted = LossCount{2, 0, {{1, 2, 3}}};
  meshing.loss_count = counted;
  const MeshFaults faults = mesh_faults(meshing, false);
  EXPECT_EQ(faults.losses, std::vector<Point>({{1, 2, 3}}));
  EXPECT_EQ(faults_in(meshing), (Faults{2, 1, 2, 0})) << "at none of the spots is the other one";
  EXPECT_TRUE(finer_may_help(meshing, false));
  EXPECT_FALSE(has_only_wrong_handles(meshing, faults));
}

TEST(MeshFaults, WhereTetsHaveChangedSidesAnotherAttemptIsWorthItsTimeIfHandlesAreWrong) {
  Meshing meshing;
  meshing.refined.mesh.tets.resize(1000);
  meshing.refined.turned = {{0, 0, 0}};
  EXPECT_FALSE(finer_may_help(meshing, false));
  meshing.loss_count = LossCount{1, 0};
  EXPECT_TRUE(finer_may_help(meshing, false));
}

TEST(MeshFaults, FarMoreSpotsOrFaultsThanTheBestAttemptHadAreTheLastOnes) {
  EXPECT_TRUE(is_worse_by_far({0, 11, 11, 0}, {0, 23, 23, 0}));
  EXPECT_FALSE(is_worse_by_far({0, 11, 11, 0}, {0, 22, 22, 0}));
  EXPECT_FALSE(is_worse_by_far({0, 2, 2, 0}, {0, 20, 20, 0})) << "few";
  EXPECT_TRUE(is_worse_by_far({8, 20, 100, 0}, {8, 20, 1001, 0})) << "all around the same spots";
  EXPECT_FALSE(is_worse_by_far({8, 20, 101, 0}, {8, 20, 1001, 0}));
  EXPECT_FALSE(is_worse_by_far({8, 20, 10, 0}, {8, 20, 1000, 0})) << "few";
}

TEST(MeshFaults, ManyLossesAloneThatHardlyBecomeFewerAreTheLastOnes) {
  EXPECT_TRUE(has_only_lost(faults(kLost, 1), faults(kLost - 5, 0)));
  EXPECT_FALSE(has_only_lost(faults(kLost, 1), faults(kLost - 5, 1))) << "elements can still be mended";
  EXPECT_FALSE(has_only_lost(faults(kLost, 1), faults(kLost / 2, 0))) << "far fewer";
  EXPECT_FALSE(has_only_lost(faults(3, 0), faults(3, 0))) << "few have places";
}

}  // namespace
}  // namespace scantet
