// What a written file cannot hold of a mesh, for people to be told.
#pragma once

#include <array>
#include <string>

#include "scantet/base/api.h"
#include "scantet/base/tet_mesh.h"

namespace SCANTET_PROGRAM_API scantet {

/// The fields that carry materials where a format has none: the number of a tet's material, counted from 1, and its
/// constants.
inline constexpr std::array<const char*, 3> kMaterialFields{"material", "youngs_modulus_mpa", "density_tonne_per_mm3"};

/// "a.mesh holds no sets (foot) and no fields (hu, spread)": the mesh's sets, fields and materials that a file of this
/// path's format cannot hold; with_names: names of regions, too, but for formats without regions. Empty if it holds all
/// of them, or writes no meshes. path: as it is to stand in the text, with its extension.
std::string loss_text(const TetMesh& mesh, const std::string& path, bool with_names);

}  // namespace scantet
