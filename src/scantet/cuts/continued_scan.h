// What lies in the voxels beyond a cut is not looked at any more, and need not be as the scan has it.
#pragma once

#include <vector>

#include "scantet/cuts/cut_plane.h"
#include "scantet/field/scan.h"

namespace scantet {

/// The scan as it is before the planes; beyond each that is parallel to layers of voxels, to a tenth of a step
/// across the image, it goes on as the last layer before the plane is. So interfaces of labels meet the plane at right
/// angles, where else they may run along it, within a voxel: sheets thinner than any size, which come and go with where
/// the plane is between two layers. No voxel before a plane changes. A layer in the plane, to a millionth of a step, is
/// beyond it, as what is there is cut off. Return: shares the voxels of `scan` where nothing changes; may have one
/// value alone.
Scan continued_beyond(const Scan& scan, const std::vector<CutPlane>& planes);

}  // namespace scantet
