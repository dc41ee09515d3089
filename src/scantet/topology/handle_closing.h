// Thin handles of a level set cut, and thin tunnels filled.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "scantet/base/progress.h"
#include "scantet/field/level_settings.h"
#include "scantet/field/scan.h"

namespace scantet {

/// A scan without the thin handles that its level set had, and what that took.
struct ClosedHandles {
  Scan scan;                        ///< the scan itself, sharing its voxels, if nothing has been changed
  std::optional<std::int64_t> had;  ///< handles of all components before; none if not known: nothing is changed then
  std::int64_t left = 0;            ///< of these, how many are left
  std::size_t cut = 0;              ///< places where handles were cut
  std::size_t filled = 0;           ///< places where tunnels were filled
  std::size_t voxels = 0;           ///< whose values were changed
  std::size_t wide = 0;             ///< places as thin where it would take a wider cut or filling: not made
  bool only_fills = false;          ///< no value of the scan is on the outside of the level, so that nothing can be cut
  std::size_t taken_back = 0;  ///< cuts and fillings that were made, but taken back: the count did not bear them out
};

/// Changes single voxels of a scan so that handles of the level set that are thinner than thinner_mm, > 0, vanish:
/// inside nodes across a handle are put on the outside, or outside nodes across a tunnel on the inside, whichever takes
/// the thinner cut. A cut is as wide as its nodes are apart, and as far as these are from the level set
/// (level_distances()). A value becomes that which mirrors it at the level, within the range of the scan's values, in
/// the scan's own type; if that is too near to the level (a unit, or a thousandth of the range), it is as far off.
///
/// settings: checked. Return: the same for any number of threads; of no use once progress.cancelled() became true.
/// Throws Error: input.too_large (more than 4·10⁹ voxels). Guarantees: components and cavities, as LevelTopology has
/// them, are those of the scan as it was: all nodes that have not been changed are in the same ones; and there are no
/// more handles than before, counted by LevelTopology. What does not bear this out is taken back. Memory beyond a copy
/// of the voxels: about 25 bytes a voxel. Source: after Han, Xu, Braga-Neto and Prince, "Topology correction in brain
/// cortex segmentation using a multiscale, graph-based algorithm", IEEE Transactions on Medical Imaging 21 (2002).
ClosedHandles close_handles(const Scan& scan, const LevelSetSettings& settings, double thinner_mm,
                            const Progress& progress = Progress());

}  // namespace scantet
