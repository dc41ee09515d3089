// Private to check/: where the nodes of a grid of regions lie in a mesh.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
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

/// Nodes of a set of joined nodes that a component of the mesh holds.
struct Meeting {
  std::size_t first_node = 0;
  std::uint64_t nodes = 0;  ///< those on faces count for each tet
};

/// Which components of the mesh hold nodes of which sets of joined nodes.
class Meetings {
 public:
  using Key = std::pair<std::uint32_t, std::uint32_t>;  // set, component

  void add(const Key& key, std::size_t node) { add(key, Meeting{node, 1}); }
  void add(const Meetings& others);
  const std::map<Key, Meeting>& all() const { return meetings_; }

 private:
  void add(const Key& key, const Meeting& meeting);

  std::map<Key, Meeting> meetings_;
  std::pair<const Key, Meeting>* last_ = nullptr;
};

/// Which nodes of a grid lie in tets of their region, and which of those of kOutside in none.
class GridNodes {
 public:
  /// What the arguments of find() refer to must outlive this.
  GridNodes(const TetMesh& mesh, const RegionGrid& grid, const GridParts& parts);

  /// component_of: as list_components() gives it. Return: of nodes in tets of their region.
  Meetings find(const FaceMatch& match, const std::vector<std::uint32_t>& component_of);

  /// The nodes of these meetings, ascending.
  std::map<Meetings::Key, std::vector<std::size_t>> nodes_of(const std::set<Meetings::Key>& keys,
                                                             const std::vector<std::uint32_t>& component_of);

  /// The set of joined nodes that a node is in; kNone: it is of kOutside.
  std::uint32_t set_of(std::size_t node) const;
  Region region_of(std::size_t node) const;
  Region region_at(int i, int j, int k) const { return region_of(node(i, rows_.row(j, k))); }

  /// Whether the node is in a tet of its region, or on a face of one; of kOutside, whether it is in none, or on a face
  /// of the outside.
  bool is_kept(int i, int j, int k, Region region) const;

  /// take(i, region): is called for each node (i, j, k) that is not kept, with its region.
  template <class Take>
  void each_lost(int j, int k, const Take& take) const {
    const std::size_t row = rows_.row(j, k);
    std::size_t run = rows_.begin(row);
    for (int i = 0; i < grid_.size[0]; ++i) {
      while (run < rows_.end(row) && grid_.runs[run].end <= i) ++run;
      const bool is_in_run = run < rows_.end(row) && grid_.runs[run].begin <= i;
      const Region region = is_in_run ? grid_.parts[grid_.runs[run].part].region : kOutside;
      if (!is_kept(i, j, k, region)) take(i, region);
    }
  }

  /// Of a node of kOutside: whether it is on no face of a tet, nor in one.
  bool is_clearly_outside(int i, int j, int k) const;

 private:
  struct Planes;
  /// The run that a node is in; none if it is of kOutside.
  std::optional<std::size_t> run_of(std::size_t node) const;
  template <class Meet>
  void mark_tet(std::size_t tet, const Meet& meet);
  template <class Meet>
  void mark_row(const Planes& planes, std::array<int, 2> ends, std::array<int, 2> row, Region region, const Meet& meet);
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

/// Adds the nodes of a run, all of the region, to what is kept and lost of it. nodes: after find(). Return: how many
/// are kept.
std::uint64_t count_nodes(const GridNodes& nodes, const RegionGrid& grid, const GridRun& run, KeptRegion& region);

/// "1 voxel", "7 voxels".
std::string counted_voxels(std::uint64_t nodes);

/// Of a node, world mm.
inline Point world_place(const RegionGrid& grid, const std::array<int, 3>& node) {
  return grid.frame.to_world({double(node[0]), double(node[1]), double(node[2])});
}

}  // namespace scantet::auditing
