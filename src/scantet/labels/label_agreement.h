// What is put right in smoothed fields: that cells agree on their faces.
#pragma once

#include <cstddef>

#include "scantet/labels/label_nodes.h"
#include "scantet/labels/label_values.h"

namespace scantet {

/// Lowers values so that on no face of a cell a label has the largest field that is at none of its corners, so that the
/// cells on both sides agree on the face. A node's own label keeps its value. Return: how many values were lowered,
/// each counted as often as it was.
std::size_t agree_on_faces(const LabelNodes& nodes, LabelValues& values);

}  // namespace scantet
