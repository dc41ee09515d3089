// The object in a scan, as what a job meshes.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/field/scan.h"
#include "scantet/image/kept_components.h"
#include "scantet/image/nested_level_sets.h"
#include "scantet/plugin/input_plugin.h"
#include "scantet/scan_input/handle_option.h"

namespace scantet {

/// The level sets of the components that are kept.
struct ScanObject {
  std::unique_ptr<Domain> domain;            ///< null if cancelled
  std::optional<DroppedComponents> dropped;  ///< if the choice may leave out some
  SmallCavities cavities;                    ///< of less than the choice's volume
  FilledCavities filled;
};

/// choice: none: all components are kept. Throws Error: as make_nested_level_sets() and keep_components().
ScanObject find_object(const Scan& scan, const NestedLevelSettings& settings,
                       const std::optional<ComponentChoice>& choice, const Progress& progress);

/// The same after clear_levels(), and handles closed as asked, with all that a job wants to know of it but
/// the files. settings: the levels become those that are meshed. Empty if cancelled. Throws Error: as
/// without_thin_handles() and find_object().
OpenedDomain open_object(const Scan& scan, NestedLevelSettings& settings, const HandleOption& handles,
                         const std::optional<ComponentChoice>& choice, Progress& progress);

/// Throws Error (input.labels) if the scan is a label map. name: of the scan, in the message. remedy: what to do
/// instead of asking for a level of it.
void refuse_labels(const Scan& scan, const std::string& name, const std::string& remedy);

}  // namespace scantet
