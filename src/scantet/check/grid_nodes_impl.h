// Private to check/: where the nodes of a grid of regions lie in a mesh.
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "scantet/check/audit_impl.h"
#include "scantet/domain/grid_parts.h"
#include "scantet/domain/region_grid.h"
#include "scantet/domain/run_rows.h"

namespace scantet::auditing {

/// What lies within this of a face, in voxels, lies on it.
inline constexpr double kNodeRounding = 1e-9;

/// One bit for each node of a grid, which any number of threads may change.
class NodeBits {
 public:
  explicit NodeBits(std::size_t count) : words_((count + 63) / 64) {}
  void set(std::size_t node);
  void clear(std::size_t node);
  bool test(std::size_t node) const { return (words_[node / 64] >> node % 64 & 1) != 0; }

 private:
  std::vector<std::uint64_t> words_;
};

/// Which components of the mesh hold nodes of which sets of joined nodes, each with the first such node.
class Meetings {
 public:
  using Key = std::pair<std::uint32_t, std::uint32_t>;  // set, component

  void add(const Key& key, std::size_t node);
  void add(const Meetings& others);
  const std::map<Key, std::size_t>& all() const { return first_node_; }

 private:
  std::map<Key, std::size_t> first_node_;
  std::pair<const Key, std::size_t>* last_ = nullptr;
};

/// Which nodes of a grid lie in tets of their region, and which of those of kOutside in none.
class GridNodes {
 public:
  /// What the arguments of find() refer to must outlive this.
  GridNodes(const TetMesh& mesh, const RegionGrid& grid, const GridParts& parts);

  /// component_of: as list_components() gives it. Return: of nodes in tets of their region.
  Meetings find(const FaceMatch& match, const std::vector<std::uint32_t>& component_of);

  /// Whether the node is in a tet of its region, or on a face of one; of kOutside, whether it is in none, or on a face
  /// of the outside.
  bool is_kept(int i, int j, int k, Region region) const;

  /// Of a node of kOutside: whether it is on no face of a tet, nor in one.
  bool is_clearly_outside(int i, int j, int k) const;

 private:
  struct Planes;
  void mark_tet(std::size_t tet, std::uint32_t component, Meetings& meetings);
  void mark_row(const Planes& planes, std::array<int, 2> ends, std::array<int, 2> row, Region region,
                std::uint32_t component, Meetings& meetings);
  void clear_face(const BoundaryFace& face);
  /// The first and the last node along an axis of those in a box.
  std::array<int, 2> nodes_in(const Box& box, int axis) const;
  std::size_t node(int i, std::size_t row) const { return row * extent(0) + static_cast<std::size_t>(i); }
  std::size_t extent(std::size_t axis) const { return static_cast<std::size_t>(grid_.size[axis]); }

  const TetMesh& mesh_;
  const RegionGrid& grid_;
  const GridParts& parts_;
  RunRows rows_;
  NodeBits found_;    // in a tet of its region, or on a face of one; of kOutside, in a tet
  NodeBits touched_;  // of kOutside: on a face of a tet
  NodeBits buried_;   // of these, on none of the outside
};

}  // namespace scantet::auditing
