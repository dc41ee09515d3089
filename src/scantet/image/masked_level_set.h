// A level set of a scan without some of its components.
#pragma once

#include <memory>

#include "scantet/field/shared_cells.h"
#include "scantet/image/level_set.h"

namespace scantet {

/// A scan as one level sees it: whole components of the inside are left out.
struct MaskedScan {
  /// The scan, or a copy in which the nodes of the components left out are outside. Its range of values is that of the
  /// scan as it was read.
  Scan scan;
  std::shared_ptr<const SharedCells> shared;  ///< null if there are none
};

/// The open set of make_level_set() without the components left out; region 1. All else is as with make_level_set():
/// the boundary and its residuals are those of the scan as it was read, and components() are exact. Throws Error: as
/// make_level_set().
std::unique_ptr<Domain> make_masked_level_set(const MaskedScan& masked, const LevelSetSettings& settings,
                                              const Progress& progress = Progress());

}  // namespace scantet
