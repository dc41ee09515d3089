// The certificate of a label map's mesh: what of it is proved. docs/certificate.md, "Label maps", has the argument.
#pragma once

#include "scantet/base/api.h"
#include "scantet/verify/label_source.h"
#include "scantet/verify/verify.h"

namespace SCANTET_API scantet {

/// Verifies a mesh of regions against a label map: Certificate::regions says what is proved of each. Bounded at the
/// most. mesh: world mm, one region a tet. labels: asked from several threads. options: only max_distance_mm is used.
/// progress: reported to as stage "verify", and polled.
/// Throws Error: input.no_tets, mesh.inconsistent (Fault::internal: not one region a tet, or a vertex that is not
/// there), input.range (coordinates beyond 1e50 mm), input.frame (axes that do not span space to rounding),
/// input.too_large (2^32 voxels or more). If progress.cancelled() became true, the outcome means nothing. Several
/// threads; the outcome does not depend on how many. Source: docs/certificate.md.
Certificate verify_labels(const TetMesh& mesh, const LabelSource& labels, const VerifyOptions& options,
                          Progress& progress);

}  // namespace scantet
