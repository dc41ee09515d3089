// The labels in a scan, as what a job meshes.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scantet/base/options.h"
#include "scantet/base/progress.h"
#include "scantet/field/scan.h"
#include "scantet/labels/label_choice.h"
#include "scantet/plugin/input_plugin.h"

namespace scantet {

/// The options that say what becomes of the labels of a segmentation.
struct LabelOptions {
  std::string labels;  ///< as read_label_choice() takes it
  std::string names;   ///< a table of names; empty: what is beside the image or in its header

  std::string smoothing = "keep";  ///< or the width of a Gaussian in mm; empty: none

  std::vector<std::string> tissues;  ///< files of probability maps beside the input

  /// Declares --tissue, --labels, --label-names and --label-smoothing under a heading of their own.
  void declare(OptionSet& options);
  /// Whether any was given: then the image is a label map, whatever it looks like.
  bool any() const { return !labels.empty() || !names.empty(); }
  /// What they mean for a scan that was read from `input`, whose labels are these. Throws Error: as
  /// read_label_choice(), settings_of() and read_label_table().
  LabelSettings settings(const std::string& input, const std::vector<LabelCount>& labels) const;
};

/// All that a job wants to know of a segmentation, of these settings. Empty if cancelled. Throws Error: as
/// make_label_object().
OpenedDomain open_label_scan(const Scan& scan, const LabelSettings& settings, Progress& progress);

/// All that a job wants to know of a label map but the files. Empty if cancelled. Throws Error: as
/// LabelOptions::settings() and make_label_field().
OpenedDomain open_labels(const Scan& scan, const std::string& input, const LabelOptions& options, Progress& progress);

/// The same of probability maps, which files are named after. Throws Error: as make_tissue_object().
OpenedDomain open_tissues(const std::vector<Scan>& maps, const std::vector<std::string>& files, Progress& progress);

/// Of a label map: why it is one, its regions with their names, voxels and volumes.
InfoSection describe_labels(const Scan& scan, const std::string& reason, const std::string& input,
                            const LabelOptions& options);

}  // namespace scantet
