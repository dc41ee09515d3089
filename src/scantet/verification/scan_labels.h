// A label map as the verifier wants it.
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/field/scan.h"
#include "scantet/labels/label_settings.h"
#include "scantet/verify/label_source.h"

namespace scantet {

/// The labels of a scan as regions. Voxels are read here, and without smoothing so are the fields, 1 at a label's
/// voxels and 0 at others; the values of smoothed fields, which define what is meshed, are those of labels/, and after
/// a Gaussian a voxel's region is the one that has most there. Null if cancelled. Throws Error: as make_label_field().
std::unique_ptr<LabelSource> scan_labels(const Scan& scan, const LabelSettings& settings, const Progress& progress);

/// What the fields are at a voxel's centre, by region: of those that have a voxel in a cell around it with several
/// regions. None where no such cell is.
std::vector<std::pair<Region, double>> values_at(const LabelSource& labels, const std::array<int, 3>& voxel);

}  // namespace scantet
