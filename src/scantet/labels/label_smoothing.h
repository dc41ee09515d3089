// Fields of labels that are as smooth as may be while every node keeps its label.
#pragma once

#include "scantet/base/progress.h"
#include "scantet/labels/label_values.h"

namespace scantet {

/// Values for every node of a cell where labels meet: of each label in the cells around the node. Of all fields whose
/// largest at each node is that of the node's own label, by a margin over each other, these have about the least
/// bending energy, but for a number that is added to all values of a label to keep its volume.
///
/// Guarantees: each node's own label has the largest value there, by 0.1 or more; on a face of a cell no label that is
/// at none of its corners has the largest field. The outcome does not depend on the number of threads. Empty if
/// progress.cancelled() became true.
/// Memory while it works: about 90 bytes a value.
LabelValues smooth_labels(const LabelNodes& nodes, const Progress& progress);

}  // namespace scantet
