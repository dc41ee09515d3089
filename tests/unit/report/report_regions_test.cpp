// What reports say of regions.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "unit/report/report_test_support.h"

namespace scantet {
namespace {

/// A cube of two regions, and a grid that has a third one.
Report report_of(const TetMesh& mesh) {
  Report report = plain_report(mesh, "a.vtu");
  RegionLedger ledger;
  ledger.regions = {{{kOutside, 50, 0}, 0, 50, {}},
                    {{1, 10, 0.4}, 1, 10, {}},
                    {{2, 20, 0.5}, 3, 18, {{1, 2, 3}, {4, 5, 6}}},
                    {{7, 5, 0.1}, 1, 0, {{9, 9, 9}}}};
  report.audit->region_ledger = ledger;
  report.regions = report_regions(mesh, *report.quality, *report.audit, {{2, {255, 0, 16}}}, 0.025);
  return report;
}

TEST(ReportRegions, JsonHasAllOfEachRegion) {
  TetMesh mesh = make_cube(4, 1, 2);
  mesh.region_names[2] = "left lung";
  const Report report = report_of(mesh);
  const nlohmann::json regions = nlohmann::json::parse(json_report(report))["regions"];
  ASSERT_EQ(regions.size(), 4U);
  EXPECT_EQ(regions[0]["name"], "background");
  EXPECT_EQ(regions[0]["voxels_kept"], 50);
  EXPECT_EQ(regions[1]["name"], "region_1");
  EXPECT_EQ(regions[2]["name"], "left lung");
  EXPECT_EQ(regions[2]["color"], "#ff0010");
  EXPECT_EQ(regions[2]["voxels"], 20);
  EXPECT_EQ(regions[2]["voxels_mm3"], 0.5);
  EXPECT_EQ(regions[2]["field_components"], 3);
  EXPECT_EQ(regions[2]["lost_voxels_mm"], nlohmann::json::parse("[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]"));
  EXPECT_EQ(regions[3]["tets"], 0);
  EXPECT_TRUE(regions[3]["min_dihedral_deg"].is_null());
  const RegionVolume& first = report.quality->regions[0];
  EXPECT_EQ(regions[1]["volume_mm3"], first.volume_mm3);
  EXPECT_DOUBLE_EQ(regions[1]["off_voxels_percent"].get<double>(), 100 * (first.volume_mm3 / 0.25 - 1));
  EXPECT_DOUBLE_EQ(regions[1]["off_field_percent"].get<double>(), 100 * (first.volume_mm3 / 0.4 - 1));
  ASSERT_EQ(regions[1]["neighbors"].size(), 2U);
  EXPECT_EQ(regions[1]["neighbors"][0]["region"], 0);
  EXPECT_EQ(regions[1]["neighbors"][1]["region"], 2);
  EXPECT_EQ(regions[1]["neighbors"][1]["area_mm2"], regions[2]["neighbors"][1]["area_mm2"]);
  double least = 180;
  for (const RegionVolume& region : report.quality->regions) least = std::min(least, region.min_dihedral_deg);
  EXPECT_EQ(least, report.quality->min_dihedral_deg());
}

TEST(ReportRegions, TextNamesWhatIsOff) {
  const std::string text = text_report(report_of(make_cube(4, 1, 2)), {200, true});
  EXPECT_NE(text.find("regions    1: "), std::string::npos) << text;
  EXPECT_NE(text.find("1 component (the input has 3)"), std::string::npos) << text;
  EXPECT_NE(text.find("7: not in the mesh, 5 voxels"), std::string::npos) << text;
  EXPECT_NE(text.find("78 of 85 centres are in the region of their label (91.76 %), 7 are not"), std::string::npos)
      << text;
}

TEST(ReportRegions, ColoursOfNumbersAreApart) {
  std::set<std::string> colors;
  for (Region region = 1; region <= 200; ++region) colors.insert(color_text(region_color(region)));
  EXPECT_GT(colors.size(), 195U);
  const auto squared = [](Region a, Region b) {
    const Color p = region_color(a);
    const Color q = region_color(b);
    const auto part = [](int x, int y) { return (x - y) * (x - y); };
    return part(p.red, q.red) + part(p.green, q.green) + part(p.blue, q.blue);
  };
  for (Region region = 1; region < 200; ++region) EXPECT_GT(squared(region, region + 1), 60 * 60) << region;
}

}  // namespace
}  // namespace scantet
