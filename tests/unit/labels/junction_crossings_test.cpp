// Curves that cross in a point are parted.
#include "scantet/labels/junction_crossings.h"

#include <gtest/gtest.h>

#include "label_scan.h"
#include "scantet/labels/junctions.h"

namespace scantet {
namespace {

std::shared_ptr<const LabelField> noise(int size, LabelSmoothing smoothing, unsigned seed) {
  LabelSettings settings;
  settings.smoothing = smoothing;
  return make_label_field(test::label_noise({size, size, size}, 3, {}, seed), settings);
}

std::vector<JunctionCrossing> crossings_of(const LabelField& field) {
  Progress progress;
  return find_junctions(field, progress).crossings;
}

void expect_same_nodes(const LabelField& a, const LabelField& b) {
  LabelCell of_b;
  for (int k = 0; k < a.size()[2]; ++k) {
    for (int j = 0; j < a.size()[1]; ++j) {
      for (int i = 0; i < a.size()[0]; ++i) {
        ASSERT_EQ(a.region_of_node(i, j, k), b.region_of_node(i, j, k));
        b.cell(i, j, k, of_b);
        ASSERT_EQ(of_b.region_at({0, 0, 0}), a.region_of_node(i, j, k)) << "the largest field, too";
      }
    }
  }
}

TEST(JunctionCrossings, ArePartedByALittleOfOneRegion) {
  std::size_t found = 0;
  std::size_t left = 0;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const auto field = noise(18, LabelSmoothing::keep, seed);
    const std::vector<JunctionCrossing> crossings = crossings_of(*field);
    if (crossings.empty()) continue;
    found += crossings.size();
    const auto parted = part_crossings(*field, crossings);
    ASSERT_NE(parted, nullptr);
    expect_same_nodes(*field, *parted);
    left += crossings_of(*parted).size();
  }
  EXPECT_GT(found, 5U);
  EXPECT_LT(left, found / 4);
}

TEST(JunctionCrossings, OfFieldsWithoutValuesStay) {
  const auto field = noise(12, LabelSmoothing::none, 3);
  const std::vector<JunctionCrossing> crossings = crossings_of(*field);
  ASSERT_FALSE(crossings.empty());
  EXPECT_EQ(part_crossings(*field, crossings), nullptr);
  EXPECT_EQ(part_crossings(*noise(12, LabelSmoothing::keep, 3), {}), nullptr);
}

}  // namespace
}  // namespace scantet
