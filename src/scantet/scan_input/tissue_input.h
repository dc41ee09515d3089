// Probability maps, as what a job meshes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/field/scan.h"
#include "scantet/plugin/input_plugin.h"

namespace scantet {

/// Probability maps on one grid, each a tissue: the n-th is region n + 1.
struct TissueMaps {
  std::vector<Scan> maps;
  std::map<Region, std::string> names{};
  std::map<Region, Color> colors{};

  /// Adds the maps that a file holds. They are called after it, and numbered if it has several, but for what the
  /// file's header says.
  void add(std::vector<Scan> volumes, const std::string& file);
  /// Names and colours of regions from a table, which overrule others. Throws Error: as read_label_table().
  void rename(const std::string& table);
};

/// All that a job wants to know of them but the files. Empty if cancelled. Throws Error: as make_tissue_object().
OpenedDomain open_tissues(const TissueMaps& tissues, Progress& progress);

/// What there is to know of them: of each tissue its name, and as describe_labels(). Empty if cancelled. Throws Error:
/// as make_tissue_object().
InfoSection describe_tissues(const TissueMaps& tissues, Progress& progress);

}  // namespace scantet
