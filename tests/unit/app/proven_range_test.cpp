#include "scantet/app/proven_range.h"

#include <gtest/gtest.h>

namespace scantet {
namespace {

MesherOptions bounds(double alpha, double facet, double cell) {
  MesherOptions options;
  options.bounds.alpha = alpha;
  options.bounds.facet_radius_edge = facet;
  options.bounds.cell_radius_edge = cell;
  options.bounds.small_slack = 1;
  return options;
}

std::string note_of(const MesherOptions& mesher, const SizeOptions& sizes = {}) {
  const auto theory = beyond_proofs(mesher, sizes);
  return theory ? theory_note(*theory) : "";
}

TEST(ProvenRange, SaysNothingWithinTheorem3) {
  EXPECT_EQ(note_of(bounds(0.03, 1 / 0.97, 4 / 0.85)), "");
  EXPECT_EQ(note_of(bounds(0.1, 1 / 0.9, 8)), "");
  EXPECT_EQ(note_of(bounds(0.01, 2, 5)), "") << "gamma is at least 0.03";
}

TEST(ProvenRange, SaysWhichBoundsWouldBeNeeded) {
  const std::string note = note_of(bounds(1, 1, 2));
  EXPECT_NE(note.find("Theorem 3"), std::string::npos) << note;
  EXPECT_NE(note.find("--alpha under 0.2 (here 1), "), std::string::npos) << note;
  EXPECT_NE(note.find("--facet-radius-edge at least 1.031 (here 1) and "), std::string::npos) << note;
  EXPECT_NE(note.find("--cell-radius-edge at least 4.706 (here 2); "), std::string::npos) << note;
  EXPECT_EQ(note_of(bounds(0.1, 1.2, 7.5)).find("--alpha"), std::string::npos);
  EXPECT_NE(note_of(bounds(0.1, 1.2, 7.5)).find("at least 8 (here 7.5)"), std::string::npos);
  EXPECT_NE(note_of(bounds(0.2, 2, 100)).find("--alpha under 0.2 (here 0.2)"), std::string::npos);
}

TEST(ProvenRange, AutoAsksForASmallShare) {
  SizeOptions sizes;
  sizes.size = "auto";
  sizes.feature_share = 0.9;
  EXPECT_EQ(note_of(bounds(0.1, 1.2, 8), sizes), "");
  sizes.feature_share = 1;
  EXPECT_NE(note_of(bounds(0.1, 1.2, 8), sizes).find("--feature-share x --alpha at most 0.09 (here 0.1)"),
            std::string::npos);
  sizes.boundary_size = "1";  // goes before auto inside
  EXPECT_EQ(note_of(bounds(0.1, 1.2, 8), sizes), "");
}

TEST(ProvenRange, Theorem5BoundsTheFacetsFromAboveToo) {
  SizeOptions sizes;
  sizes.size = "auto";
  sizes.feature_share = 0.09;
  sizes.lipschitz_k = 0.2;  // 11.3°: sin 48.7° / (2 sin 11.3°) = 1.915
  EXPECT_EQ(note_of(bounds(0.1, 1.5, 8), sizes), "");
  const std::string note = note_of(bounds(0.1, 2, 8), sizes);
  EXPECT_NE(note.find("Theorem 5"), std::string::npos) << note;
  EXPECT_NE(note.find("--facet-radius-edge x --small-slack under 1.9"), std::string::npos) << note;
  sizes.lipschitz_k = 1;
  EXPECT_NE(note_of(bounds(0.1, 1.5, 8), sizes).find("--lipschitz under 0.336"), std::string::npos);
}

}  // namespace
}  // namespace scantet
