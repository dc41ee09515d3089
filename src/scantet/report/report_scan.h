// The scan that a mesh is of, as much of it as a page shows beside the mesh.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/frame.h"
#include "scantet/base/geometry.h"
#include "scantet/base/stratum.h"
#include "scantet/field/scan.h"

namespace SCANTET_API scantet {

/// Voxels in 65,536 grey levels, or the regions that they are of.
struct ReportScan {
  std::array<int, 3> size{};
  Frame frame;                        ///< of these voxels, index to world, mm
  std::vector<std::uint16_t> values;  ///< x fastest; 0 is low, 65535 high; of a label map: places in `regions`
  double low = 0;                     ///< the smallest and the largest value that is shown
  double high = 1;
  std::vector<double> levels;   ///< of the mesh
  std::vector<Region> regions;  ///< of a label map, ascending; low, high and levels mean nothing then
  std::string note;             ///< what of the scan is not shown; empty: nothing
};

/// More voxels make a page that browsers are slow to open.
inline constexpr std::int64_t kMostVoxelsInPage = 8'000'000;

/// The voxels of a scan around a mesh. If the scan has more than `most` voxels, those far from the box are left out; if
/// that does not do, every second voxel along each axis is shown, or every third, and so on; the note says so.
ReportScan report_scan(const Scan& scan, const Box& around, std::vector<double> levels,
                       std::int64_t most = kMostVoxelsInPage);

/// The same of a label map. region_of: every label of the scan.
ReportScan report_labels(const Scan& scan, const std::map<std::int64_t, Region>& region_of, const Box& around,
                         std::int64_t most = kMostVoxelsInPage);

}  // namespace scantet
