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

namespace scantet {

/// Probability maps on one grid, each a tissue: the n-th is region n + 1.
struct TissueMaps {
  std::vector<Scan> maps;
  MapUnits units{};  ///< set by simplify()
  std::map<Region, std::string> names{};
  std::map<Region, Color> colors{};

  /// Adds the maps that a file holds. They are called after it, and numbered if it has several, but for what the
  /// file's header says.
  void add(std::vector<Scan> volumes, const std::string& file);
  /// Finds out what the values mean, and then makes the maps simpler. To be called once, after all are added. Throws
  /// Error: as find_map_units() and simplified().
  void simplify(const Simplification& how);
  /// The maps go on beyond the planes as continued_beyond() has it.
  void go_on_beyond(const std::vector<CutPlane>& planes);
  /// Names and colours of regions from a table, which overrule others. Throws Error: as read_label_table().
  void rename(const std::string& table);
};

/// All that a job wants to know of them but the files; notes tell of tissues that are nowhere the most likely. Empty if
/// cancelled. Pre: tissues.simplify() was called. Throws Error: as make_probability_field().
OpenedDomain open_tissues(const TissueMaps& tissues, Progress& progress);

/// What there is to know of them: of each tissue, also without a voxel, its name, and as describe_labels(). Empty if
/// cancelled. Pre and throws: as open_tissues().
InfoSection describe_tissues(const TissueMaps& tissues, Progress& progress);

}  // namespace scantet
