// What is worth knowing of a mesh's regions beside those of the segmentation it was made from.
#pragma once

#include <string>
#include <vector>

#include "scantet/check/audit.h"
#include "scantet/report/report_regions.h"

namespace scantet {

/// Of labels that have other components than in the input, or other volumes than their voxels by more than people can
/// overlook, or volumes that cannot be compared, and of voxels whose centres lie in other regions: none of that is a
/// fault. audit: complete, and that of the same mesh.
std::vector<std::string> notes_on_regions(const std::vector<ReportRegion>& regions, const AuditReport& audit);

}  // namespace scantet
