// What people call labels, and the colours they have: tables.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "scantet/base/color.h"
#include "scantet/field/scan.h"

namespace scantet {

/// Names by label.
using LabelNames = std::map<std::int64_t, std::string>;

/// Names and colours by label; either may lack any.
struct LabelTable {
  LabelNames names{};
  std::map<std::int64_t, Color> colors{};

  /// Adds what is in the other one of labels that this has no name of, or no colour.
  void merge(LabelTable other) {
    names.merge(other.names);
    colors.merge(other.colors);
  }
};

/// A table, a label a line (docs/formats.md, "Tables of labels"): those of FreeSurfer, ITK-SNAP, BIDS (dseg.tsv),
/// MRIcron and plain ones, "label name"; the first three have colours. The last line of a label counts. Throws Error:
/// input.missing, input.not_a_file, input.labels (no line of the file is one of these).
LabelTable read_label_table(const std::string& path);

/// What MRIcron keeps beside an image: names in "aal.nii.txt", colours in "aal.nii.lut" beside "aal.nii.gz"; empty if
/// there are none.
LabelTable table_beside(const std::string& image);
/// The names of these two files, whether they are there or not.
std::vector<std::string> tables_beside(const std::string& image);

/// What the header of a segmentation says.
LabelTable table_of_segments(const std::vector<ScanSegment>& segments);

}  // namespace scantet
