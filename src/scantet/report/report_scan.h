// The scan that a mesh is of, as much of it as a page shows beside the mesh.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/frame.h"
#include "scantet/base/geometry.h"
#include "scantet/base/stratum.h"
#include "scantet/field/scan.h"

namespace SCANTET_API scantet {

/// The value that the field of a region has at a voxel: the regions and values are those of a label map's field that
/// its cells have there.
struct ReportFieldValue {
  std::uint32_t voxel = 0;   ///< of those shown, x fastest
  std::uint16_t region = 0;  ///< its place in ReportScan::regions
  std::uint16_t value = 0;   ///< all values of all fields on one scale, from 0 for the least to 65535
};

/// Voxels in 65,536 grey levels, or the regions that they are of.
struct ReportScan {
  std::array<int, 3> size{};          ///< voxels shown, along each axis
  Frame frame;                        ///< of these voxels, index to world, mm
  std::vector<std::uint16_t> values;  ///< x fastest; 0 is low, 65535 high; of a label map: places in `regions`
  double low = 0;                     ///< the smallest and the largest value of the whole scan
  double high = 1;
  std::vector<double> levels;   ///< of the mesh
  std::vector<Region> regions;  ///< of a label map, ascending; low, high and levels mean nothing then
  /// Of a label map with smoothed fields: at voxels where regions meet, ascending. Else a region's field is 1 at its
  /// voxels and 0 at others.
  std::vector<ReportFieldValue> field;
  std::string note;  ///< what of the scan is not shown; empty: nothing
};

/// More voxels make a page that browsers are slow to open.
inline constexpr std::int64_t kMostVoxelsInPage = 8'000'000;

/// More values of fields do, too.
inline constexpr std::size_t kMostFieldValuesInPage = 3'000'000;

/// Of a voxel (i, j, k) of the scan: the regions that may be there and the values of their fields; none where the cells
/// around it have one region alone. Asked on several threads.
using FieldValuesAt = std::function<std::vector<std::pair<Region, double>>(int i, int j, int k)>;

/// The voxels of a scan around a mesh, copied. around: the mesh's box, world mm; empty: none is left out for it.
/// levels: of the mesh, in the scan's values. most: less than 1 counts as 1. If the scan has more than `most` voxels,
/// only those in the box and two or three around it are kept; if that does not do, every second voxel along each axis
/// is shown, or every third, and so on; the note says so. Of a scan of one value, low and high are that value, and all
/// values 0.
ReportScan report_scan(const Scan& scan, const Box& around, std::vector<double> levels,
                       std::int64_t most = kMostVoxelsInPage);

/// The same of a label map. region_of: of every label of the scan, at most 65,536 regions; values of `field` in regions
/// that it has not are left out. field: of smoothed fields, else null; it is called in this function alone. If there
/// are more than `most_values` of it, or voxels are left out between those shown, it is left out; the note says so.
/// Pre: the scan's voxels are whole numbers.
ReportScan report_labels(const Scan& scan, const std::map<std::int64_t, Region>& region_of, const FieldValuesAt& field,
                         const Box& around, std::size_t most_values = kMostFieldValuesInPage,
                         std::int64_t most = kMostVoxelsInPage);

}  // namespace scantet
