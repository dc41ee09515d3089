// What a scan says of each tet of a mesh: its mean there, its spread, how much of the tet a label fills.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/field/scan.h"

namespace SCANTET_API scantet {

/// What is taken of a scan over a tet.
enum class FieldMeasure {
  mean,      ///< the integral of the scan, trilinear between voxel centres, over the tet, divided by the tet's volume
  std,       ///< the root of the mean of its squared difference from that mean
  min,       ///< the smallest value whose voxels' boxes together hold at least 1e-9 of the tet's volume
  max,       ///< the largest such value
  median,    ///< the least value such that voxels of at most this value hold half of the tet, each by the volume it
             ///< shares
  fraction,  ///< the share of the tet's volume that lies in the boxes of voxels of one value, 0 to 1
};

/// One measure.
struct FieldChoice {
  FieldMeasure measure = FieldMeasure::mean;
  double label = 0;  ///< of fraction: the voxels' value; else it is not looked at
};

/// A measure of a scan over each tet of a mesh.
struct ScanField {
  std::vector<double> values;      ///< one per tet, in their order; in the scan's unit, or a share
  std::uint64_t tets_outside = 0;  ///< tets that reach more than a millionth of a voxel beyond the voxels' boxes
  double total = 0;                ///< the sum of signed volume times value over all tets, in the unit times mm³
};

/// Integrates a scan over each tet of a mesh. Each tet is cut by the planes between the cells of the grid, and what is
/// integrated is a polynomial in each piece, integrated in closed form: nothing but rounding is lost. So the sum of
/// volume times mean over tets is the integral over the mesh, however it is cut into tets.
///
/// mesh: world mm, in the scan's frame (LPS); only vertices and the corners of tets are looked at, and the values do
/// not depend on the orientation of tets. scan: of any frame; its range of values is not looked at. Beyond the
/// outermost voxel centres the scan is what it is at the nearest point of the box that they span; beyond the voxels'
/// boxes a place belongs to the nearest voxel. Values of 64-bit integers are rounded to doubles. A tet without volume
/// gets what the scan is at its centroid, 0 for std, and for fraction 1 or 0: whether the voxel there has the value. On
/// several threads, with the same values for any number of them. Parallel loops may be ended by run_interruptible();
/// nothing is returned then.
ScanField scan_field(const TetMesh& mesh, const Scan& scan, const FieldChoice& choice = {});

}  // namespace scantet
