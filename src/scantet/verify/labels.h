// The certificate of a label map's mesh: what of it is proved. docs/certificate.md, "Label maps", has the argument.
#pragma once

#include "scantet/base/api.h"
#include "scantet/verify/label_source.h"
#include "scantet/verify/verify.h"

namespace SCANTET_API scantet {

/// Verifies a mesh of regions against a label map: Certificate::regions says what is proved of each. Bounded at the
/// most. Of the options, max_distance_mm and most_places are used. Throws Error: input.range, input.no_tets,
/// mesh.inconsistent, input.frame, input.too_large (2^32 voxels or more). If progress.cancelled() became true, the
/// outcome means nothing. Several threads; the outcome does not depend on how many.
Certificate verify_labels(const TetMesh& mesh, const LabelSource& labels, const VerifyOptions& options,
                          Progress& progress);

}  // namespace scantet
