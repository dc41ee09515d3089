// Fields of labels that are given as shares: how much of each place is which label's.
#pragma once

#include <array>
#include <functional>
#include <span>

#include "scantet/base/progress.h"
#include "scantet/labels/label_values.h"

namespace scantet {

/// Labels by the largest share, and their fields.
struct SharedLabels {
  LabelNodes nodes;    ///< each node has the label whose share is largest there; of several the first one
  LabelValues values;  ///< shares, at the nodes of cells where labels meet
};

/// Takes a label's shares at the nodes (i, j, k), (i + 1, j, k), … of the padded grid.
using ShareRow = std::function<void(int i, int j, int k, std::span<const float> shares)>;
/// Hands on a label's shares, each node at most once, the same whenever it is called, from any number of threads; where
/// it hands on none they are 0.
using ShareSource = std::function<void(LabelRank, const ShareRow&)>;

/// The fields of labels from 1 on are their shares, that of the background (rank 0) is what these leave of 1. On a face
/// of a cell no label that is at none of its corners has the largest field. size: of the grid without its padding;
/// ranks: how many labels there are, with the background. Empty if progress.cancelled() became true. Memory while it
/// works: 10 bytes a node.
SharedLabels share_labels(const std::array<int, 3>& size, std::size_t ranks, const ShareSource& source,
                          const Progress& progress);

}  // namespace scantet
