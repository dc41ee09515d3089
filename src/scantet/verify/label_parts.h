// What the regions of a label map consist of: parts that hold a voxel's centre.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/verify/findings.h"
#include "scantet/verify/label_source.h"

namespace scantet::verify {

/// Connected parts of regions that hold the centre of a voxel. Voxels of one part here are proved to be of one part;
/// parts here may be one where `may_join` says so, and nowhere else.
struct LabelParts {
  std::vector<std::uint32_t> part_of;  ///< of nodes, the layer around the image included, x fastest
  struct Part {
    Region region = kOutside;
    std::uint64_t voxels = 0;   ///< in the image
    std::array<int, 3> node{};  ///< one of them, or a node of the layer
    std::uint32_t group = 0;    ///< of parts that may be one: the least of them
  };
  std::vector<Part> parts;
};

/// Adds to `faults` where nodes do not have their labels in the fields, or cells may not agree on the face between
/// them. Throws Error: input.too_large (2^32 nodes or more).
LabelParts label_parts(const LabelSource& labels, std::vector<VerifyFinding>& faults, const Progress& progress);

}  // namespace scantet::verify
