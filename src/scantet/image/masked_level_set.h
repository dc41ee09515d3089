// A level set of a scan without some of its components and cavities.
#pragma once

#include <memory>

#include "scantet/field/shared_cells.h"
#include "scantet/image/level_set.h"

namespace scantet {

/// A scan as one level sees it: whole components of the inside are left out, and whole cavities filled.
struct MaskedScan {
  /// The scan, or a copy in which the nodes of the components left out are outside, and those of the cavities filled
  /// inside. Its range of values is that of the scan as it was read.
  Scan scan;
  std::shared_ptr<const SharedCells> shared;  ///< null if there are none
};

/// The heights of a masked scan; in shared cells the field's are those of the scan as it was read. settings: checked.
std::unique_ptr<HeightGrid> make_masked_heights(const MaskedScan& masked, const LevelSetSettings& settings);

/// The open set of make_level_set() without the components left out, and with the cavities filled; region 1. All else
/// is as with make_level_set(): the boundary and its residuals are those of the scan as it was read, and components()
/// are exact. Throws Error: as make_level_set().
std::unique_ptr<Domain> make_masked_level_set(const MaskedScan& masked, const LevelSetSettings& settings,
                                              const Progress& progress = Progress());

}  // namespace scantet
