// The labels in a scan, as what a job meshes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/options.h"
#include "scantet/base/progress.h"
#include "scantet/field/scan.h"
#include "scantet/labels/label_settings.h"
#include "scantet/plugin/input_plugin.h"

namespace SCANTET_API scantet {

struct LabelCount;  // labels/label_count.h

/// The options that say what becomes of the labels of a segmentation.
struct LabelOptions {
  std::string labels;              ///< all, a list or the file of a table; empty: all
  std::string names;               ///< a table of names; empty: what is beside the image or in its header
  std::uint64_t background = 0;    ///< the label that is not meshed
  std::string smoothing = "keep";  ///< or the width of a Gaussian in mm; empty: none

  /// Declares --labels, --background, --label-names and --label-smoothing under the heading `group`. has_names: the
  /// third, too; has_background: the second, too.
  void declare(OptionSet& options, const std::string& group, bool has_names = true, bool has_background = true);
  /// Whether any was given that makes an image a label map, whatever it looks like.
  bool any() const { return !labels.empty() || background != 0 || !names.empty(); }
  /// For inputs that are none: throws Error (usage.no_effect) if labels are to be smoothed. input: its name.
  void refuse_idle_smoothing(const std::string& input) const;
  /// The files that are read for them beside the image of this name.
  std::vector<std::string> files(const std::string& image) const;
};

/// Why the scan is taken for a label map, as the end of "… is a label map: "; nullopt if it is not.
std::optional<std::string> reason_for_labels(const Scan& scan, const LabelOptions& options);

/// What they mean for a scan with these labels. input: the image's name, beside which tables are looked for. Throws
/// Error: usage.labels, usage.value, usage.no_effect, input.missing.
LabelSettings label_settings(const Scan& scan, const std::string& input, const std::vector<LabelCount>& counts,
                             const LabelOptions& options);

/// All that a job wants to know of a segmentation, of these settings. Empty if cancelled. Throws Error: as
/// make_label_object().
OpenedDomain open_label_scan(const Scan& scan, const LabelSettings& settings, Progress& progress);

/// All that a job wants to know of a label map but the files. input: the image's name, beside which tables are looked
/// for. Empty if cancelled. Throws Error: usage.labels, usage.value, input.missing, and as make_label_object().
OpenedDomain open_labels(const Scan& scan, const std::string& input, const LabelOptions& options, Progress& progress);

/// Of a label map: why it is one; of each region its name, voxels, volume, connected parts (by
/// faces of voxels) and neighbours. Empty if
/// cancelled. Throws Error: as open_labels().
InfoSection describe_labels(const Scan& scan, const std::string& reason, const std::string& input,
                            const LabelOptions& options, Progress& progress);

}  // namespace scantet
