// A mesh of several regions in itself: what its regions consist of, and which voxels' centres they hold.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/verify/label_source.h"

namespace scantet::verify {

/// A face between tets of different regions, or of one tet.
struct RegionFace {
  std::array<VertexId, 3> corners;
  std::array<Region, 2> regions;  ///< ascending
};

/// The tets of each region, joined through faces.
struct MeshRegions {
  std::vector<std::uint32_t> part_of;  ///< one a tet
  std::vector<Region> parts;           ///< the region of each part
  std::vector<RegionFace> faces;
};

MeshRegions mesh_regions(const TetMesh& mesh);

/// Where the centre of a voxel is in the mesh.
struct VoxelPlace {
  static constexpr std::uint32_t kNoTet = 0xffffffff;
  std::uint32_t tet = kNoTet;  ///< a tet that holds it; kNoTet: none does
  bool is_on_face = false;     ///< it is on a face of the tet, and a part or the outside beyond may hold it as well
  bool has_label = false;      ///< a tet that holds it, boundary included, is of the voxel's region
};

/// Of all voxels of the image, x fastest. Exact, of the centres as doubles.
std::vector<VoxelPlace> voxel_places(const TetMesh& mesh, const LabelSource& labels, const Progress& progress);

}  // namespace scantet::verify
