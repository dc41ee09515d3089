// When attempts at a mesh have ways across level ground, and keep them.
#include "scantet/app/level_ground.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace scantet {
namespace {

constexpr int kRounds = 30;
constexpr int kRoundsAgain = 8;

/// Of one way, and another one across level ground, if there is any; nothing else is asked for.
class Ways : public Domain {
 public:
  explicit Ways(bool have_level_ground) : count_{1, have_level_ground ? std::size_t{2} : std::size_t{1}} {}

  Box bounds() const override { return {}; }
  Region region_at(const Point&) const override { return kOutside; }
  void crossings(const Segment&, Crossings& out) const override { out.clear(); }
  void narrow_ways(LevelGround ground, const NarrowWaySink& sink) const override {
    const std::size_t count = ground == LevelGround::is_crossed ? count_[1] : count_[0];
    for (std::size_t n = 0; n < count; ++n) sink({1, {{0, 0, 0}, {1, 0, 0}}});
  }

 private:
  std::array<std::size_t, 2> count_;
};

/// What the next attempt has after a mesh with so many handles wrong.
class Attempt {
 public:
  explicit Attempt(bool has_level_ground) : ways_(has_level_ground), trial_(ways_, kRounds) { start_points(1); }

  void start_points(std::size_t count) {
    start = MeshResult();
    start->sample.resize(count);
    mesher.handle_rounds = kRoundsAgain;
  }
  void judge(std::uint64_t handles_wrong) {
    Meshing last;
    last.refined.wrong_handle_count = handles_wrong;
    const std::optional<LossCount> counted = LossCount{handles_wrong, 0};
    last.loss_count = counted;
    trial_.judge(last, mesh_faults(last, false), handles_wrong, mesher, start);
  }
  bool has_ways() const { return mesher.level_ground == LevelGround::is_crossed; }
  bool is_trial() const { return trial_.is_next(); }

  MesherOptions mesher;
  std::optional<MeshResult> start;

 private:
  Ways ways_;
  LevelGroundTrial trial_;
};

TEST(LevelGround, IsCrossedWhereSeveralHandlesAreWrongAndFromThenOnIfThatHelps) {
  Attempt attempt(true);
  attempt.judge(5);
  EXPECT_TRUE(attempt.is_trial());
  EXPECT_TRUE(attempt.has_ways());
  EXPECT_EQ(attempt.mesher.handle_rounds, kRounds) << "as many as the first ways had";
  attempt.start_points(2);
  attempt.judge(4);
  EXPECT_FALSE(attempt.is_trial());
  EXPECT_TRUE(attempt.has_ways());
  EXPECT_EQ(attempt.mesher.handle_rounds, kRoundsAgain);
  EXPECT_EQ(attempt.start->sample.size(), 2U) << "the points of the trial";
}

TEST(LevelGround, IsLeftAgainAndForGoodWhereThatDoesNotHelp) {
  Attempt attempt(true);
  attempt.judge(5);
  attempt.start_points(2);
  attempt.judge(5);
  EXPECT_FALSE(attempt.has_ways());
  EXPECT_EQ(attempt.start->sample.size(), 1U) << "the points from before";
  attempt.judge(5);
  EXPECT_FALSE(attempt.is_trial());
  EXPECT_FALSE(attempt.has_ways());
}

TEST(LevelGround, IsNotCrossedWhereHandlesAreRightOrWrongAllOver) {
  Attempt attempt(true);
  attempt.judge(0);
  EXPECT_FALSE(attempt.has_ways());
  attempt.judge(21);
  EXPECT_FALSE(attempt.has_ways());
  attempt.judge(1);
  EXPECT_TRUE(attempt.has_ways()) << "nothing else is wrong";
}

TEST(LevelGround, WhereNoWayEndsOnItChangesNothing) {
  Attempt attempt(false);
  attempt.judge(5);
  EXPECT_FALSE(attempt.is_trial());
  EXPECT_FALSE(attempt.has_ways());
  EXPECT_EQ(attempt.mesher.handle_rounds, kRoundsAgain);
}

}  // namespace
}  // namespace scantet
