// Components, cavities and narrow places of a trilinear level set, exactly.
#pragma once

#include <memory>
#include <vector>

#include "scantet/image/level_set.h"

namespace scantet {

/// What the level set consists of. Built once by a sweep over the scan; then immutable.
class LevelTopology {
 public:
  /// Sweeps the scan. settings as for make_level_set, already checked.
  LevelTopology(const Scan& scan, const LevelSetSettings& settings);
  ~LevelTopology();
  LevelTopology(LevelTopology&&) noexcept;
  LevelTopology& operator=(LevelTopology&&) noexcept;

  /// Components of the inside (region 1), largest first, then cavities (region kOutside), largest first.
  const std::vector<Component>& components() const;

  /// Places where the level set is thinner than about a voxel: small components and cavities, and necks and gaps at the
  /// saddles of the field (Domain::features). Radii in mm.
  const std::vector<Feature>& features() const;

  /// The component of the level set that passes through `index`, a point on it (voxel units): the pair of the inside
  /// and the outside component there.
  BoundaryId boundary_at(const Vec& index) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scantet
