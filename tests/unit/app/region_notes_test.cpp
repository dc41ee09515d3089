// What is said of regions that are not quite as in the segmentation.
#include "scantet/app/region_notes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace scantet {
namespace {

constexpr std::uint64_t kVoxels = 2000;  // of the label, of 1 mm³

/// A label that the mesh has just as it is in the input.
ReportRegion label_as_asked() {
  ReportRegion label;
  label.region = 7;
  label.name = "vessel";
  label.mesh = {7, 100, double{kVoxels}, 20, 120};
  label.components = 2;
  label.voxels_mm3 = double{kVoxels};
  label.grid = KeptRegion{{7, kVoxels, double{kVoxels}}, 2, kVoxels, {}};
  return label;
}

/// Of its components the second is the smallest of region 7.
AuditReport audit_of_mesh() {
  AuditReport audit;
  const auto component = [](Region region, double volume_mm3, const Point& at) {
    return MeshComponent{region, 10, volume_mm3, {at, at}, 1, 2};
  };
  audit.components = {component(7, 1990, {1, 1, 1}), component(7, 3, {4, 5, 6}), component(7, 7, {8, 8, 8}),
                      component(9, 1, {2, 2, 2})};
  return audit;
}

/// The note that has this in it; empty if there is none.
std::string note_with(const std::string& words, const std::vector<ReportRegion>& regions) {
  const std::vector<std::string> notes = notes_on_regions(regions, audit_of_mesh());
  const auto note =
      std::find_if(notes.begin(), notes.end(), [&](const auto& n) { return n.find(words) != std::string::npos; });
  return note == notes.end() ? "" : *note;
}

TEST(RegionNotes, AreNoneOfWhatIsAsInTheInput) {
  EXPECT_EQ(notes_on_regions({label_as_asked()}, audit_of_mesh()), std::vector<std::string>());
}

TEST(RegionNotes, TellOfPartsThatCameApart) {
  ReportRegion label = label_as_asked();
  label.components = 3;
  const std::string note = note_with("other parts than the input", {label_as_asked(), label});
  EXPECT_NE(note.find("of 1 label: vessel with 3 for 2, the smallest at (4, 5, 6) mm"), std::string::npos) << note;
  EXPECT_NE(note_with("2 labels, the first is vessel", {label, label}), "");
}

TEST(RegionNotes, SayNothingOfPartsThatAreCutOrLostWhole) {
  ReportRegion cut = label_as_asked();
  cut.components = 3;
  cut.grid->grid.volume_mm3 = std::numeric_limits<double>::quiet_NaN();
  ReportRegion lost = label_as_asked();
  lost.components = 0;
  EXPECT_EQ(note_with("other parts than the input", {cut, lost}), "") << "what is lost is a finding";
  EXPECT_NE(note_with("volumes are not held against", {cut}), "");
}

TEST(RegionNotes, TellOfVolumesThatAreOff) {
  ReportRegion label = label_as_asked();
  label.mesh.volume_mm3 = 1.004 * kVoxels;
  EXPECT_EQ(note_with("volume of", {label}), "");
  label.mesh.volume_mm3 = 1.02 * kVoxels;
  EXPECT_NE(note_with("most that of vessel, by 2%", {label}), "");
}

TEST(RegionNotes, TellOfVoxelsInOtherRegions) {
  AuditReport audit = audit_of_mesh();
  KeptRegion label = *label_as_asked().grid;
  label.kept -= 3;
  label.lost = {{1, 2, 3}};
  audit.region_ledger.emplace().regions = {KeptRegion{{kOutside, 50, 0}, 0, 50, {}}, label};
  const std::vector<std::string> notes = notes_on_regions({label_as_asked()}, audit);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].rfind("3 of 2050 voxel centres", 0), 0U) << notes[0];
  EXPECT_NE(notes[0].find("label 7, the first at (1, 2, 3) mm"), std::string::npos) << notes[0];
}

}  // namespace
}  // namespace scantet
