// The labels in a scan, as what a job meshes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/options.h"
#include "scantet/base/progress.h"
#include "scantet/cuts/cut_plane.h"
#include "scantet/field/scan.h"
#include "scantet/labels/label_settings.h"
#include "scantet/plugin/input_plugin.h"

namespace SCANTET_API scantet {

struct LabelCount;  // labels/label_count.h

/// The options that say what becomes of the labels of a segmentation.
struct LabelOptions {
  std::string labels;              ///< "all", a list such as "1,3,7-12" or the file of a table; empty: all
  std::string names;               ///< the file of a table of names; empty: what is beside the image or in its header
  std::uint64_t background = 0;    ///< the label that is not meshed, up to 2147483647
  std::string smoothing = "keep";  ///< "keep", "none" or the width of a Gaussian in mm, > 0; empty: none

  /// Declares --labels, --background, --label-names and --label-smoothing under the heading `group`, with fields of
  /// this object as targets: `options` is not used once it is gone. has_names: whether the third, too; has_background:
  /// whether the second, too.
  void declare(OptionSet& options, const std::string& group, bool has_names = true, bool has_background = true);
  /// Whether any was given that makes an image a label map, whatever it looks like.
  bool any() const { return !labels.empty() || background != 0 || !names.empty(); }
  /// For inputs that are none. input: its name, for the message. Throws Error: usage.no_effect (`smoothing` is not
  /// "keep", as it is by default).
  void refuse_idle_smoothing(const std::string& input) const;
  /// The files that are read for them beside the image of this name: MRIcron's tables, that of `labels` and that of
  /// `names`, those of them that are there.
  std::vector<std::string> files(const std::string& image) const;
};

/// Why the scan is taken for a label map, as the end of "… is a label map: "; nullopt if it is not. It is one if its
/// header or its values say so, or if options.any().
std::optional<std::string> reason_for_labels(const Scan& scan, const LabelOptions& options);

/// What they mean for a scan with these labels. input: the image's name, beside which tables are looked for. counts: of
/// the scan; for callers within the library, as others have no LabelCount: open_labels() counts by itself.
/// Throws Error: usage.labels (options.labels cannot be read or contradicts itself; the image has not a label that it
/// names, or the background), usage.no_effect (a background beside a choice of labels), usage.value
/// (options.smoothing), input.missing (a table of names that is not there), input.not_a_file (a table that is a pipe, a
/// device or a socket), input.labels (a table that names nothing; no number is left for the region of the label 0).
LabelSettings label_settings(const Scan& scan, const std::string& input, const std::vector<LabelCount>& counts,
                             const LabelOptions& options);

/// All that a job wants to know of a segmentation, of these settings, but the files. If there is OpenedDomain::fit, to
/// be fitted before it is meshed: until then junctions are traced when they are asked for, and those that cross are not
/// parted. cuts: planes that it will be cut by; it is as continued_beyond() has it. The scan's voxels are not needed
/// afterwards. If cancelled, without a domain. Throws Error: as make_label_object(), and input.cut (the cuts leave no
/// label).
OpenedDomain open_label_scan(const Scan& scan, const LabelSettings& settings, const std::vector<CutPlane>& cuts,
                             Progress& progress);

/// All that a job wants to know of a label map but the files. input: the image's name, beside which tables are looked
/// for. If cancelled, without a domain. Throws Error: as label_settings() and open_label_scan().
OpenedDomain open_labels(const Scan& scan, const std::string& input, const LabelOptions& options,
                         const std::vector<CutPlane>& cuts, Progress& progress);

/// Of a label map: why it is one, how many values and regions it has, which segments overlap or are hidden; of each
/// region its name, voxels, volume, connected parts (by faces of voxels) and neighbours, of voxels as they are, without
/// smoothing. reason: reason_for_labels(). input: as of open_labels(). Empty if cancelled. Throws Error: as
/// open_labels(), but not usage.smooth.
InfoSection describe_labels(const Scan& scan, const std::string& reason, const std::string& input,
                            const LabelOptions& options, Progress& progress);

}  // namespace scantet
