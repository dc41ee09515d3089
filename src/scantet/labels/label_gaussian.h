// Fields of labels by a Gaussian: what most programs do, and it does not keep labels.
#pragma once

#include <array>

#include "scantet/base/progress.h"
#include "scantet/labels/label_shares.h"

namespace scantet {

/// Each label's share of its surroundings, weighted by a Gaussian of these standard deviations along the axes, voxels,
/// cut off at 3.5 of them; beyond the image all is background. Thin parts, small ones and narrow gaps can vanish.
/// ranks: how many labels there are. Empty if progress.cancelled() became true. The outcome does not depend on the
/// number of threads. Memory while it works: as share_labels(), and 8 bytes for each voxel of the box around the
/// largest label.
SharedLabels blur_labels(const LabelNodes& nodes, std::size_t ranks, const std::array<double, 3>& sigma,
                         const Progress& progress);

}  // namespace scantet
