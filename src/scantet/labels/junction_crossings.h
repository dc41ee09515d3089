// Points where junction curves cross, parted.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "scantet/labels/label_field.h"

namespace scantet {

/// A point where curves of the same three regions cross: one of these meets itself there, and no mesh is a manifold.
struct JunctionCrossing {
  Vec index;  ///< voxel units
  std::array<Region, 3> regions{};
};

/// The same field but for a little more of the region that meets itself, around each crossing: what it joins there
/// parts the curves. As far as nodes keep their regions by a margin; null if nothing can be changed.
std::shared_ptr<const LabelField> part_crossings(const LabelField& field, std::span<const JunctionCrossing> crossings);

}  // namespace scantet
