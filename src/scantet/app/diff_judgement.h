// What of all that differs between two meshes makes them count as different.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "scantet/base/tet_mesh.h"
#include "scantet/report/difference.h"
#include "scantet/report/report.h"

namespace scantet {

/// Sentences that say why two meshes are not the same; none: they are, within ReportDifference::tolerance_mm and
/// field_tolerance. Names in files of two formats are the same if both would be written alike: without blanks, or in
/// capitals, where one format has only such. What one of the formats cannot hold makes no difference.
/// difference: all but its reasons. What is not judged is added to its not_compared, and sets that have other names in
/// the other format are compared and added to attached, under the first mesh's names.
/// meshes: as they were read, for the names of their regions, sets and fields. reports: with the files' names.
std::vector<std::string> reasons_to_differ(ReportDifference& difference, const std::array<const TetMesh*, 2>& meshes,
                                           std::span<const Report> reports);

}  // namespace scantet
