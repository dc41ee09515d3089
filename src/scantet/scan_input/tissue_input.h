// Probability maps, as what a job meshes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/field/scan.h"
#include "scantet/labels/probability_field.h"
#include "scantet/plugin/input_plugin.h"
#include "scantet/reading/simplify.h"
#include "scantet/scan_input/label_input.h"

namespace scantet {

/// Probability maps on one grid: the n-th that is added is tissue n + 1, and a region of that number.
struct TissueMaps {
  std::vector<Scan> maps;
  MapUnits units{};               ///< set by choose()
  std::vector<Region> regions{};  ///< of each map; several may share one
  std::map<Region, std::string> names{};
  std::map<Region, Color> colors{};
  std::size_t dropped = 0;  ///< tissues that are background

  /// Adds the maps that a file holds. They are called after it, and numbered if it has several, but for what the
  /// file's header says.
  void add(std::vector<Scan> volumes, const std::string& file);
  /// Finds out what the values mean, and keeps the tissues that are to be meshed, as the regions and under the names
  /// that the options say, with tissues for labels. To be called once, after all are added. Throws Error: as
  /// find_map_units() and chosen_labels(), and usage.labels (none is left).
  void choose(const LabelOptions& options);
  /// Throws Error: as simplified().
  void simplify(const Simplification& how);
  /// The maps go on beyond the planes as continued_beyond() has it.
  void go_on_beyond(const std::vector<CutPlane>& planes);
};

/// All that a job wants to know of them but the files; notes tell of tissues that are nowhere the most likely. Empty if
/// cancelled. Pre: tissues.choose() was called. Throws Error: as make_probability_field().
OpenedDomain open_tissues(const TissueMaps& tissues, Progress& progress);

/// What there is to know of them: of each tissue, also without a voxel, its name, and as describe_labels(). Empty if
/// cancelled. Pre and throws: as open_tissues().
InfoSection describe_tissues(const TissueMaps& tissues, Progress& progress);

}  // namespace scantet
