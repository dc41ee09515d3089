// Meshes of second order, seen as meshes of first order.
#pragma once

#include "scantet/base/api.h"
#include "scantet/base/tet_mesh.h"

namespace SCANTET_API scantet {

/// The corners of a mesh of second order and the straight tets between them: what is measured, audited and verified of
/// such a mesh. The boundary and the curves where patches meet are derived anew; regions and these curves keep their
/// names, and sharp curves stay. A pair of regions that had several patches keeps them, if the mesh's facets are those
/// that its tets have. Sets, fields, materials and other_solids are left out.
///
/// mesh: of second order, or of first, which loses as much. Return: a mesh of first order; tets keep their order, and
/// corners theirs, but vertices that are no tet's corner are gone, so that ids change.
/// Pre: vertex ids of tets, facets and curve edges exist, as do their patches and curves; one region a tet. Throws
/// Error: input.too_large (2^30 tets or more).
TetMesh first_order(const TetMesh& mesh);

}  // namespace scantet
