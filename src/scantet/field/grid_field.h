// A scan and what its field is beyond it.
#pragma once

#include <optional>

#include "scantet/base/api.h"
#include "scantet/field/scan.h"

namespace SCANTET_API scantet {

/// A field that is trilinear between voxels.
struct GridField {
  Scan scan;
  std::optional<double> outside{};  ///< its value from one voxel beyond the scan on; none: the scan says nothing of it
};

}  // namespace scantet
