// What is put right in smoothed fields: that regions meet, or stay apart, by a margin.
#pragma once

#include <array>

#include "scantet/labels/label_nodes.h"
#include "scantet/labels/label_values.h"

namespace scantet {

/// Whether the diagonals of a face have no label in common. corners: one diagonal's are the first and the last.
inline bool has_pass(const std::array<LabelRank, 4>& corners) {
  const auto& [a, c, d, b] = corners;
  return a != c && a != d && b != c && b != d;
}

/// Changes values where regions end just before a face of the grid, nearly meet on an edge or a face of it, or are
/// hardly more than a node wide along an axis, as far as a few sweeps bring it about: so that on no face or edge a
/// label is the largest that is at none of its corners, by a margin (agree_on_faces()); on a face whose diagonals have
/// no label in common, as of a checkerboard, the labels that meet across one of them do so by a margin, of a tie those
/// with the smallest label; and a region between two others is at least 0.8 of a voxel thick at a node. For values of
/// which a node's own label exceeds the others by about 1. Values rise at their own label's nodes, and fall at others',
/// so nodes keep their labels. The outcome does not depend on the number of threads.
void keep_margins(const LabelNodes& nodes, LabelValues& values);

}  // namespace scantet
