// How two meshes differ: whether they are the same, how far their boundaries are from each other, and what each has of
// every region.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scantet/base/tet_mesh.h"
#include "scantet/check/distance.h"

namespace scantet {

/// How far two meshes are the same, from all to nothing.
enum class Sameness {
  arrays,     ///< vertices, tets and regions, each in the same order
  numbering,  ///< the same tets at the same places, but numbered in another order; regions too
  tets,       ///< likewise, but tets have other regions
  none        ///< some tet of one is not in the other
};

/// "the same vertices and tets in the same order" and its like.
const char* text_of(Sameness same);

/// One region in two meshes.
struct RegionDifference {
  /// What one mesh has of it; all 0 if it has none.
  struct Side {
    std::string name;  ///< that the mesh gives it; empty: none
    std::uint64_t tets = 0;
    double volume_mm3 = 0;
    double area_mm2 = 0;  ///< of the facets around it
  };
  Region region = kOutside;
  std::array<Side, 2> sides;  ///< in the first mesh and in the second
};

/// The facets between two regions in two meshes.
struct PatchDifference {
  std::array<Region, 2> regions{};  ///< {behind, in front}, as in TetMesh::facet_regions
  std::array<std::uint64_t, 2> facets{};
  std::array<double, 2> area_mm2{};
};

/// All that differs between two meshes.
struct MeshDifference {
  Sameness same = Sameness::none;
  std::array<std::uint64_t, 2> tets_alone{};  ///< tets that the other mesh has not at the same place
  /// For each tet of the second mesh the one of the first at the same place; empty if some tet has none.
  std::vector<std::uint32_t> pairs;
  OneWayDistance to_second;                          ///< from the boundary of the first mesh to that of the second
  OneWayDistance to_first;                           ///< the other way
  std::array<std::vector<double>, 2> facets_off_mm;  ///< of each facet the farthest corner from the other boundary
  std::vector<RegionDifference> regions;             ///< of either mesh, ascending
  std::vector<PatchDifference> patches;              ///< of either mesh, ascending
};

/// Compares two meshes. Facets are divided until upper bounds on distances are as DistanceOptions asks, or the parts
/// are 1/64 of them: then the distance is only known to lie between the bounds, which are apart by no more than the
/// length of such a part. Surfaces are compared as a whole, those between regions included, whatever regions they lie
/// between. Guarantees: does not depend on the number of threads. Pre: as TetMesh promises; coordinates are finite.
MeshDifference compare_meshes(const TetMesh& first, const TetMesh& second, const DistanceOptions& options = {});

}  // namespace scantet
