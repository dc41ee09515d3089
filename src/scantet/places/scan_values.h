// The values of a scan at points and over tets.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scantet/base/geometry.h"
#include "scantet/field/scan.h"

namespace scantet {

/// Trilinear between the voxel centres of a scan; beyond its border, the value at the nearest point of it. Immutable.
class ScanValues {
 public:
  /// Shares the scan's voxels.
  explicit ScanValues(Scan scan) : scan_(std::move(scan)) {}
  double at(const Point& p) const;
  const Scan& scan() const { return scan_; }

 private:
  Scan scan_;
};

/// Scans by the names under which places ask for them.
using ScanTable = std::map<std::string, ScanValues>;

}  // namespace scantet
