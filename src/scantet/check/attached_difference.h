// What two meshes have beside the straight tets between corners: nodes on edges, sets and fields.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scantet/base/tet_mesh.h"

namespace scantet {

/// How far the nodes on the edges of two meshes of second order are from each other, edge by edge.
struct EdgeNodeDifference {
  double largest_mm = 0;
  std::array<Point, 2> places{};  ///< the nodes of the first mesh and of the second that are so far apart
};

/// The members of one kind of a set that both meshes have.
struct SetDifference {
  std::string name;
  std::string of;  ///< "vertices", "facets" or "tets"
  std::array<std::uint64_t, 2> members{};
  std::optional<std::array<std::uint64_t, 2>> alone;  ///< that the other mesh's set has not; none: only counted
  std::optional<Point> place;                         ///< of one of those: the vertex, or the centroid

  bool is_same() const { return members[0] == members[1] && (!alone || (*alone)[0] + (*alone)[1] == 0); }
};

/// The values of a field that both meshes have, tet by tet. Two values that are no numbers are equal.
struct FieldDifference {
  std::string name;
  double largest = 0;              ///< in the field's unit; infinite where only one is a finite number
  double scale = 0;                ///< the greatest magnitude of all finite values of both
  Point place{};                   ///< the centroid of the tet with the largest difference
  std::array<double, 2> values{};  ///< there
};

/// All of it. What only one mesh has is left out.
struct AttachedDifference {
  bool is_paired = false;     ///< each tet has its like in the other mesh; else members are counted, and no more
  bool is_one_to_one = true;  ///< so have vertices; not, where tets share one in one mesh and have two in the other
  std::optional<EdgeNodeDifference> edge_nodes;  ///< if both are of second order, and paired
  std::vector<SetDifference> sets;               ///< kinds with members, as the first mesh has its sets
  std::vector<FieldDifference> fields;           ///< as the first mesh has them; none if not paired
};

/// Compares what hangs on tets, vertices and boundary facets. pairs: for each tet of the second mesh the one of the
/// first at the same place, as MeshDifference has them; empty: none are known. Meshes whose tets have the same numbers,
/// with no corner farther than tolerance_mm (>= 0) from its like, are paired by these. Pre: as TetMesh promises.
AttachedDifference compare_attached(const TetMesh& first, const TetMesh& second,
                                    const std::vector<std::uint32_t>& pairs, double tolerance_mm);

}  // namespace scantet
