// Volumes of labels, and the numbers that make them right.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scantet/base/frame.h"
#include "scantet/domain/facet_sizes.h"
#include "scantet/labels/label_values.h"

namespace scantet {

/// Adds a number to each label's values so that its volume is that of its voxels, as nearly as may be: at most 0.25, so
/// that nodes keep their labels where these win by a margin of 1.
void keep_volumes(const LabelNodes& nodes, LabelValues& values);

/// The same for the volumes that facets of these sizes will leave to the labels: with their corners on an interface,
/// they cut off what is round. At most 1 is added, with what was added before; nodes keep their labels by 0.1 or more,
/// as their own values rise where need be. values.bends: known, as smooth_labels() leaves them. frame: of the nodes.
/// What the volumes of meshes are then: docs/algorithm.md.
void keep_volumes_of_facets(const LabelNodes& nodes, const Frame& frame, const FacetSizes& facets, LabelValues& values);

/// Whether facets of these sizes will leave a label of over 1,000 voxels 5 % more or less than its voxels' volume, or
/// worse. voxels: of each rank. The others: as above.
bool are_volumes_off(const LabelNodes& nodes, const Frame& frame, const FacetSizes& facets, const LabelValues& values,
                     std::span<const std::uint64_t> voxels);

/// Adds a number, at most 1 with those of earlier calls, to each label's values, so that as much volume moves between
/// labels as a mesh of the fields has too much of them. Nodes of cells where three labels or more meet, or two as on a
/// checkerboard, keep their values, so that junctions stay where they are and regions as they are joined; as do those
/// of the cells of `held` and next to these. Others keep their labels by 0.1 or more. excess_voxels: by rank, of each
/// that has values. held: in voxel units, in the grid.
void move_volumes(const LabelNodes& nodes, const std::vector<double>& excess_voxels, std::span<const Vec> held,
                  LabelValues& values);

}  // namespace scantet
