// What people read of regions.
#pragma once

#include <string>
#include <vector>

#include "scantet/report/report_regions.h"

namespace scantet {

/// Units as the terminal can show them.
struct RegionUnits {
  std::string degrees;
  std::string square_mm;
  std::string cubic_mm;
};

/// A text for each region but kOutside; of many only for those that are farthest from what they should be, and how many
/// there are beside.
std::vector<std::string> region_rows(const std::vector<ReportRegion>& regions, const RegionUnits& units);

/// How many voxel centres are in the region of their label; empty if there are none.
std::string voxel_row(const std::vector<ReportRegion>& regions);

}  // namespace scantet
