// The parts that the regions of a domain consist of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/geometry.h"
#include "scantet/base/stratum.h"

namespace SCANTET_API scantet {

/// A connected component of a region, or a cavity in the inside: what must be found again in the mesh.
struct Component {
  Region region = kOutside;     ///< kOutside for a cavity
  Point witness;                ///< a point in it, world mm
  Box box_mm;                   ///< encloses it, up to one grid step
  double volume_mm3 = 0;        ///< approximate (a count of grid nodes); 0 if unknown
  bool touches_border = false;  ///< reaches the border of the image
  /// Euler number of its boundary, all of it: the sum of 2 - 2·handles over the closed surfaces around it and within.
  std::optional<std::int64_t> euler{};      ///< none if not known
  std::optional<std::uint64_t> surfaces{};  ///< closed surfaces that its boundary consists of; none if not known

  /// Handles of all surfaces of its boundary together; none if not known.
  std::optional<std::int64_t> handles() const {
    if (!euler || !surfaces) return std::nullopt;
    return static_cast<std::int64_t>(*surfaces) - *euler / 2;
  }
};

/// Components that the user asked to leave out of a domain. Those of region n > 1 are islands in region n - 1, which
/// takes them in.
struct DroppedComponents {
  std::size_t found = 0;              ///< components before any was dropped, of all regions
  std::vector<Component> components;  ///< those dropped, largest first

  /// Of all that were dropped together.
  double volume_mm3() const {
    double sum = 0;
    for (const Component& component : components) sum += component.volume_mm3;
    return sum;
  }
};

}  // namespace scantet
