// Materials for the tets of a mesh.
#pragma once

#include <optional>
#include <vector>

#include "scantet/base/tet_mesh.h"
#include "scantet/materials/material_file.h"
#include "scantet/places/scan_values.h"

namespace scantet {

/// Gives each tet of the mesh one material: fills materials and tet_materials. First the places, then the regions with
/// constants, in the order of their numbers, then the bins of the scan's law, from the stiffest on. scans: has that of
/// the law and those of the places. Return: the conductivity of each material, if it has one. Throws Error
/// (usage.materials): a region has no material, or there is no such region; a place has nothing of its own; and as
/// items_in_place().
std::vector<std::optional<double>> assign_materials(const MaterialFile& file, const ScanTable& scans, TetMesh& mesh);

}  // namespace scantet
