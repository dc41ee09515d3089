// Segmentations whose segments overlap, in several layers. Internal to the reader.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scantet/reading/image_source_impl.h"

namespace scantet {

/// The segments that the header of a segmentation of 3D Slicer (.seg.nrrd) names, "Segment0_Name:=lung" and so on, in
/// the order of their numbers; none if it names none. layers: that the file has. Files of old, without labels and
/// layers, have a segment a layer, of label 1. Throws Error: input.labels (a label or a layer that cannot be).
std::vector<HeaderSegment> segments_of_slicer(const std::string& path, std::int64_t layers);

/// Layers of a segmentation as one label map. A voxel in several segments is in the last of them, as in 3D Slicer.
/// layers: of `voxels`, the values of a voxel side by side, or, if not interleaved, layer after layer. The merged scan
/// has the segments' labels if these are all different, else their numbers from 1 on, and counts the voxels of each
/// segment and those of them that later ones cover. path: for messages. may_be_constant: whether one label in all
/// voxels will do. Pre: at least two voxels along each axis. Throws Error: input.labels (voxels of a value that no
/// segment of their layer has; voxels are no whole numbers), input.constant (unless may_be_constant).
Scan merge_layers(const VoxelPointer& voxels, const std::array<int, 3>& size, const Frame& frame,
                  const std::vector<HeaderSegment>& segments, std::int64_t layers, bool interleaved,
                  const std::string& path, bool may_be_constant);

/// That the voxels of a segmentation in one layer are 0, or labels of its segments. path: for messages. Throws Error:
/// input.labels.
void check_labels(const Scan& scan, const std::string& path);

}  // namespace scantet
