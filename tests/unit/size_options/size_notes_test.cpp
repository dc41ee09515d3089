#include "scantet/size_options/size_notes.h"

#include <gtest/gtest.h>

namespace scantet {
namespace {

TEST(SizeNotes, SayWhereTheDefaultComesFrom) {
  EXPECT_EQ(note_on_default("1.5", "2 x the smallest voxel spacing"),
            "no --size given: size 1.5 mm, 2 x the smallest voxel spacing");
}

TEST(SizeNotes, SayHowFarOffAGridIs) {
  const SizeGrid grid({{}, 0.5, {2, 2, 2}}, std::vector<float>(8, 1.25F), 1.25);
  EXPECT_EQ(note_on_grid(grid).find("sizes from 1.25 mm on, made 1-Lipschitz, on a grid of 0.5 mm: at most "), 0U)
      << note_on_grid(grid);
}

TEST(SizeNotes, SayWhatAutoWentBy) {
  AutoSizes how;
  how.least_mm = 0.5;
  how.share = 0.3;
  const BoundaryCones cones{{{{}, 2}, {{}, 0.75}, {{}, 1}}, 0.25};
  EXPECT_EQ(note_on_auto(cones, how),
            "auto: sizes from 0.75 to 2 mm on the boundary, 0.3 x its distance to the medial axis, at least 0.5 mm, "
            "from a sample 0.25 mm apart: narrower places may be passed over");
  how.features.lipschitz_k = 0.2;
  EXPECT_NE(note_on_auto(cones, how).find("0.3 x its Lipschitz radius"), std::string::npos);
}

}  // namespace
}  // namespace scantet
