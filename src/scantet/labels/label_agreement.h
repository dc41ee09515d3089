// What is put right in smoothed fields: that cells agree on their faces.
#pragma once

#include <cstddef>

#include "scantet/labels/label_nodes.h"
#include "scantet/labels/label_values.h"

namespace scantet {

/// Lowers values so that on no face of a cell a label has the largest field that is at none of its corners, so that the
/// cells on both sides agree on the face. below: > 0, by how much it is less than the mean of the face's labels at each
/// corner. A node's own label keeps its value. Return: how many values were lowered, each counted as often as it was.
std::size_t agree_on_faces(const LabelNodes& nodes, float below, LabelValues& values);

}  // namespace scantet
