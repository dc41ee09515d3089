// What people call labels: tables of names.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace scantet {

/// Names by label.
using LabelNames = std::map<std::int64_t, std::string>;

/// The names in a table, a label a line (docs/formats.md, "Tables of labels"): those of FreeSurfer, ITK-SNAP, BIDS
/// (dseg.tsv), MRIcron and plain ones, "label name". The last line of a label counts. Throws Error: input.missing,
/// input.not_a_file, input.labels (no line of the file is one of these).
LabelNames read_label_names(const std::string& path);

/// The names that MRIcron keeps beside an image, "aal.nii.txt" beside "aal.nii.gz"; none if there are none.
LabelNames names_beside(const std::string& image);

/// The names in the header of a segmentation of 3D Slicer (.seg.nrrd); none if there are none.
LabelNames names_of_segments(const std::string& image);

}  // namespace scantet
