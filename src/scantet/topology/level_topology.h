// Components, cavities and narrow places of a trilinear level set, exactly.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/progress.h"
#include "scantet/domain/domain.h"
#include "scantet/field/height_grid.h"
#include "scantet/field/level_settings.h"

namespace SCANTET_API scantet {

/// What the level set consists of. Built once by three sweeps over the scan, on several threads, then immutable: const
/// methods may be called from many threads. Where progress.cancelled() became true while it was built, nothing may be
/// asked of it.
///
/// A component is one of {h > 0} or of {h < 0}, h the height of the trilinear field above the level (below it with
/// InsideSide::below), continued to the outside value one voxel beyond the image: not of a voxel count. Nodes at the
/// level belong to none, but for those of cells that lie in it wholly, which are outside. So joins and walls without
/// width do not count (level_joins.cpp).
class LevelTopology {
 public:
  /// Sweeps the scan, whose voxels it keeps alive. settings: as for make_level_set, already checked (check_level(), and
  /// an outside value on the outside of the level).
  /// Memory while it runs: three layers of runs for each thread, four bytes for each run that begins without a
  /// neighbour before it, about 90 for each component of each slab of 32 layers, and what it keeps a second time.
  LevelTopology(const Scan& scan, const LevelSetSettings& settings, const Progress& progress = Progress());
  /// The same of any grid of heights, not null, which it keeps. frame: of its nodes, index to world, mm.
  LevelTopology(std::unique_ptr<HeightGrid> heights, const Frame& frame, const Progress& progress = Progress());
  ~LevelTopology();
  /// Movable; nothing may be asked of what was moved from.
  LevelTopology(LevelTopology&&) noexcept;
  /// As the move constructor.
  LevelTopology& operator=(LevelTopology&&) noexcept;

  /// Components of the inside (region 1), then cavities (region kOutside): largest first by the number of their nodes,
  /// of equals the one whose witness has the smaller index (x first). The witness is the highest node, a cavity's the
  /// lowest; the box spans the nodes, the volume is that of their voxels. A component touches the border if it has a
  /// node in the outermost layer of voxels. Its Euler number is exact, with ties as components have them; not known of
  /// any if the field is at the level in such a way that both sides do not give the same (parts that meet in a face
  /// whose four nodes are at the level, say, of which each reaches a share of it only).
  const std::vector<Component>& components() const;

  /// Calls visit(begin, end, j, k) for stretches of nodes along x, begin ≤ i < end, that together are the nodes of the
  /// components from components()[first] on: the inside ones of these, or the cavities if that is one. In the order of
  /// their indices, x fastest. Pre: 1 ≤ first < components().size().
  void visit_nodes_from(std::size_t first, const std::function<void(int, int, int, int)>& visit) const;

  /// Places where the level set is thinner than a voxel, for Domain::size_hints(), found anew at each call by one more
  /// sweep: saddles of the field at nodes, on faces and in cells, whose distance to the level set is estimated as less
  /// than the smallest voxel spacing, and nodes whose six neighbours are on the other side. Components and cavities of
  /// at most 27 nodes have one at their witness, if thin there. World mm; in the order of the sweep.
  std::vector<SizeHint> size_hints() const;

  /// What Domain::narrow_ways() tells of the field, found anew at each call: ways in region 1 or kOutside. World mm;
  /// always in the same order.
  void narrow_ways(LevelGround ground, const NarrowWaySink& sink) const;
  /// What Domain::misplaced() tells of the field, found anew at each call: nodes up to two voxels from one of the other
  /// side. World mm; group by group, always in the same order.
  std::vector<Misplaced> misplaced(const TriangleSurface& boundary, const PlaceFilter& is_asked) const;

  /// The component of the level set that passes through `index`, a point on it up to rounding (voxel units): the
  /// outside component there and the inside one, as Patch::components, with 0 for the unbounded outside and for the
  /// largest inside component. The pair tells the components of the boundary apart: each closed surface parts space in
  /// two. Where several meet at the point, one of them.
  std::array<ComponentId, 2> components_at(const Vec& index) const;

  /// Bytes that it keeps beyond the grid of heights.
  std::size_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scantet
