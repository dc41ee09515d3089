// The measures of each tet as fields of the mesh: what programs colour elements by.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/tet_mesh.h"

namespace SCANTET_API scantet {

/// What quality_fields() are called, in their order: min_dihedral_deg, max_dihedral_deg, radius_edge, inverse_aspect,
/// scaled_jacobian, stiffness_ratio, min_height_mm, circumradius_mm, volume_mm3. docs/fields.md says what they are.
/// Valid for ever.
std::span<const std::string_view> quality_field_names();

/// One field a measure, in the order of quality_field_names(), and in it one value a tet, in the order of mesh.tets:
/// what measure_quality() counts. Of second order: of the straight tets between the corners. Of flat tets radius_edge,
/// stiffness_ratio and circumradius_mm are infinite, and inverse_aspect, scaled_jacobian and min_height_mm 0.
/// Pre: the vertex ids of mesh.tets are those of vertices, whose coordinates are finite and at most 1e60 mm.
/// Guarantees: depends on the mesh only, not on the number of threads.
std::vector<MeshField> quality_fields(const TetMesh& mesh);

}  // namespace scantet
