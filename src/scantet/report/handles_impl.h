// Handles of boundaries: what their Euler numbers mean.
#pragma once

#include <cstdint>
#include <optional>

#include "scantet/check/audit.h"

namespace scantet {

/// Handles of a surface of a manifold boundary: 1 - euler / 2.
inline std::int64_t handles_of(const MeshSurface& surface) {
  return 1 - surface.euler / 2;
}

/// Handles of the whole boundary; none if it is not manifold, or lies between several regions, which share surfaces.
inline std::optional<std::int64_t> handles_of(const AuditReport& audit) {
  if (!audit.manifold() || audit.interfaces.size() > 1) return std::nullopt;
  std::int64_t sum = 0;
  for (const MeshSurface& surface : audit.surfaces) sum += handles_of(surface);
  return sum;
}

/// Whether the audit had a domain to compare handles with, known or not.
inline bool has_domain(const AuditReport& audit) {
  return audit.circumcentres_astray.has_value();
}

/// Whether it compared components and cavities with a domain, or parts of labels with a grid.
inline bool knows_parts(const AuditReport& audit) {
  return audit.ledger.has_value() || audit.region_ledger.has_value();
}

}  // namespace scantet
