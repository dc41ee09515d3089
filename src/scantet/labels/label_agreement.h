// What is put right in smoothed fields: volumes, and that cells agree on their faces.
#pragma once

#include "scantet/labels/label_values.h"

namespace scantet {

/// Adds a number to each label's values so that its volume is that of its voxels, as nearly as may be: at most 0.25,
/// so that nodes keep their labels where these win by a margin of 1.
void keep_volumes(const LabelNodes& nodes, LabelValues& values);

/// Lowers values so that on no face of a cell a label has the largest field that is at none of its corners, so that the
/// cells on both sides agree on the face. A node's own label keeps its value. Return: how many values were lowered,
/// each counted as often as it was.
std::size_t agree_on_faces(const LabelNodes& nodes, LabelValues& values);

}  // namespace scantet
