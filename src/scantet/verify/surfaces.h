// The certificate of a mesh of what a closed surface bounds. docs/certificate.md, "Surfaces", has the argument.
#pragma once

#include "scantet/base/api.h"
#include "scantet/base/triangle_surface.h"
#include "scantet/verify/verify.h"

namespace SCANTET_API scantet {

/// Verifies a mesh against the closed surface of triangles whose inside it is to be; bounded at the most. mesh: world
/// mm, one region a tet, whichever. surface: nested surfaces are cavities, and islands in them, whichever way they are
/// turned; what is wrong with it is a finding, and leaves the outcome undecided. options: only max_distance_mm and
/// lists_facets are used. progress: reported to as stage "verify", and polled.
/// Throws Error: input.no_tets, mesh.inconsistent (Fault::internal: not one region a tet, or a vertex that is not
/// there), input.range (coordinates beyond 1e50 mm), input.surface (it has no facets, or names vertices that are not
/// there). If progress.cancelled() became true, the outcome means nothing. Several threads; the outcome does not depend
/// on how many. Source: docs/certificate.md.
Certificate verify_surface(const TetMesh& mesh, const TriangleSurface& surface, const VerifyOptions& options,
                           Progress& progress);

}  // namespace scantet
