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
/// field_tolerance. difference: all but its reasons. meshes: as they were read, for the names of their sets and fields.
std::vector<std::string> reasons_to_differ(const ReportDifference& difference,
                                           const std::array<const TetMesh*, 2>& meshes,
                                           std::span<const Report> reports);

}  // namespace scantet
