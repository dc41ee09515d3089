// The scan that a mesh is of, as much of it as a page shows beside the mesh.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/frame.h"
#include "scantet/base/geometry.h"
#include "scantet/field/scan.h"

namespace SCANTET_API scantet {

/// Voxels in 65,536 grey levels.
struct ReportScan {
  std::array<int, 3> size{};
  Frame frame;                        ///< of these voxels, index to world, mm
  std::vector<std::uint16_t> values;  ///< x fastest; 0 is low, 65535 high
  double low = 0;                     ///< the smallest and the largest value that is shown
  double high = 1;
  std::vector<double> levels;  ///< of the mesh
  std::string note;            ///< what of the scan is not shown; empty: nothing
};

/// More voxels make a page that browsers are slow to open.
inline constexpr std::int64_t kMostVoxelsInPage = 8'000'000;

/// The voxels of a scan around a mesh. If the scan has more than `most` voxels, those far from the box are left out; if
/// that does not do, every second voxel along each axis is shown, or every third, and so on; the note says so.
ReportScan report_scan(const Scan& scan, const Box& around, std::vector<double> levels,
                       std::int64_t most = kMostVoxelsInPage);

}  // namespace scantet
