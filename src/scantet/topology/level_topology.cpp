// Three sweeps with the same labels, each in slabs side by side. Two find and measure the components (level_slabs.h).
// The third keeps, as runs along x, where each component is, except for the two that are nearly everywhere: the largest
// inside and the unbounded outside. A label per voxel never exists.
//
// A trilinear function has no extremum inside a cell, face or edge. So every component holds a node, and from any point
// one gets to a node of its component by walking along the axes uphill (inside) or downhill (outside), on lines on
// which the function is linear.
#include "scantet/topology/level_topology.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scantet/base/neighbors.h"
#include "scantet/base/parallel.h"
#include "scantet/topology/level_slabs.h"
#include "scantet/topology/level_ties.h"
#include "scantet/topology/misplaced_nodes.h"
#include "scantet/topology/narrow_places.h"
#include "scantet/topology/narrow_ways.h"

namespace scantet {
namespace {

using NodeIndex = std::array<int, 3>;

constexpr std::int64_t kSmallComponent = 27;  // nodes
constexpr int kBlockShift = 2;                // blocks of cells: 2^kBlockShift along each axis
constexpr double kNeighborTolerance = 1e-3;   // how far off its cell a point may be, voxel units

/// True if the six neighbours of a node have the other sign.
bool is_island(const HeightGrid& heights, const NodeIndex& node) {
  const auto inside = [&](const NodeIndex& n) { return heights.height(n[0], n[1], n[2]) > 0; };
  for (int direction = 0; direction < 6; ++direction) {
    if (inside(axis_neighbor(node, direction)) == inside(node)) return false;
  }
  return true;
}

/// The corner at the end of the walk along the axes from u that rises (direction +1) or falls (-1) most at each step.
int walk_to_corner(const CellHeights& heights, Vec u, double direction) {
  int corner = 0;
  for (unsigned left = 7; left != 0;) {
    double best = 0;
    int best_axis = -1;
    double best_end = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if ((left >> axis & 1) == 0) continue;
      for (double end : {0.0, 1.0}) {
        Vec there = u;
        there[axis] = end;
        const double value = direction * trilinear(heights, there);
        if (best_axis >= 0 && value <= best) continue;
        best = value;
        best_axis = axis;
        best_end = end;
      }
    }
    u[best_axis] = best_end;
    left &= ~(1U << best_axis);
    if (best_end > 0) corner |= 1 << best_axis;
  }
  return corner;
}

}  // namespace

struct LevelTopology::Impl {
  struct Run {
    std::int32_t begin;
    std::int32_t end;
    std::uint32_t label;
  };

  Frame frame;
  std::unique_ptr<HeightGrid> heights;
  std::vector<Component> components;
  std::uint32_t insides = 0;                // of these, which come first
  std::vector<NodeIndex> small_components;  // witnesses of those that are no island of one node
  std::vector<std::uint32_t> row_begin;     // first run of each row (k·size[1] + j), and the end
  std::vector<Run> runs;                    // absent: the largest inside component or the unbounded outside
  NodeIndex blocks{};                       // of cells, along each axis
  std::vector<bool> has_runs;               // of each block: whether reached_label() may meet a run from its cells

  void store_runs(const std::vector<LevelSlab>& slabs, const std::vector<std::uint32_t>& rank,
                  const Progress& progress);
  void mark_blocks();
  std::size_t block_of(const NodeIndex& cell) const;
  void set_euler_numbers(const std::vector<LevelSlab>& slabs, std::vector<std::int64_t> eighths,
                         const Progress& progress);
  std::uint32_t label_at(const NodeIndex& node) const;
  NodeIndex cell_at(const Vec& index) const;
  std::uint32_t reached_label(const Vec& index, bool inside) const;
};

void LevelTopology::Impl::store_runs(const std::vector<LevelSlab>& slabs, const std::vector<std::uint32_t>& rank,
                                     const Progress& progress) {
  struct Part {
    std::vector<std::uint32_t> row_begin;
    std::vector<Run> runs;
  };
  std::vector<Part> parts(slabs.size());
  parallel_for(slabs.size(), 1, [&](std::size_t n, std::size_t) {
    Part& part = parts[n];
    visit_runs(*heights, slabs[n].first, slabs[n].last, progress,
               [&](int begin, int end, int, int, int, std::uint32_t label) {
                 if (begin == 0) part.row_begin.push_back(static_cast<std::uint32_t>(part.runs.size()));
                 const std::uint32_t ranked = rank[slabs[n].number_of[label]];
                 if (ranked != 0) part.runs.push_back({begin, end, ranked});
               });
  });
  std::size_t total = 0;
  for (const Part& part : parts) total += part.runs.size();
  runs.reserve(total);
  row_begin.reserve(static_cast<std::size_t>(heights->size()[1]) * heights->size()[2] + 1);
  for (Part& part : parts) {
    const auto before = static_cast<std::uint32_t>(runs.size());
    for (const std::uint32_t begin : part.row_begin) row_begin.push_back(before + begin);
    runs.insert(runs.end(), part.runs.begin(), part.runs.end());
    part = {};
  }
  row_begin.push_back(static_cast<std::uint32_t>(runs.size()));
}

std::size_t LevelTopology::Impl::block_of(const NodeIndex& cell) const {
  const auto along = [&](int axis) { return static_cast<std::size_t>((cell[axis] + 1) >> kBlockShift); };
  return (along(2) * blocks[1] + along(1)) * blocks[0] + along(0);
}

/// Most of a scan has no run near it, and no label to be looked for.
void LevelTopology::Impl::mark_blocks() {
  constexpr int kSide = 1 << kBlockShift;
  const std::array<int, 3>& size = heights->size();
  for (int axis = 0; axis < 3; ++axis) blocks[axis] = (size[axis] >> kBlockShift) + 1;
  has_runs.assign(static_cast<std::size_t>(blocks[0]) * blocks[1] * blocks[2], false);
  // From a cell the corners of it and of its neighbours may be reached: nodes from one before it to two after it.
  const auto first_cell = [](int node) { return std::max(-1, node - 2); };
  const auto last_cell = [&](int node, int axis) { return std::min(size[axis] - 1, node + 1); };
  for (std::size_t row = 0; row + 1 < row_begin.size(); ++row) {
    const int j = static_cast<int>(row) % size[1];
    const int k = static_cast<int>(row) / size[1];
    for (std::uint32_t n = row_begin[row]; n < row_begin[row + 1]; ++n) {
      const std::size_t last = block_of({last_cell(runs[n].end - 1, 0), -1, -1});
      for (const int z : {first_cell(k), last_cell(k, 2)}) {
        for (const int y : {first_cell(j), last_cell(j, 1)}) {
          static_assert(kSide >= 4, "the cells from which a node is reached are in no more than two blocks");
          const std::size_t first_of_row = block_of({-1, y, z});
          for (std::size_t b = block_of({first_cell(runs[n].begin), -1, -1}); b <= last; ++b) {
            has_runs[first_of_row + b] = true;
          }
        }
      }
    }
  }
}

/// eighths: of the Euler number of each component, then of the unbounded outside (less one), as cells have them. The
/// two sides of the level have the same boundary, so their sums are the same; if not, the numbers are not known.
void LevelTopology::Impl::set_euler_numbers(const std::vector<LevelSlab>& slabs, std::vector<std::int64_t> eighths,
                                            const Progress& progress) {
  struct Tie {
    std::size_t component;
    int eighths;
  };
  std::vector<std::vector<Tie>> ties(slabs.size());
  parallel_for(slabs.size(), 1, [&](std::size_t n, std::size_t) {
    if (!slabs[n].has_zeros) return;
    count_ties(*heights, slabs[n].first, slabs[n].last, progress, [&](const NodeIndex& node, int share) {
      const std::size_t label = label_at(node);
      const bool inside = heights->height(node[0], node[1], node[2]) > 0;
      ties[n].push_back({inside ? label : label == 0 ? components.size() : insides + label - 1, share});
    });
  });
  for (const std::vector<Tie>& slab : ties) {
    for (const Tie& tie : slab) eighths[tie.component] += tie.eighths;
  }
  std::int64_t difference = 0;
  for (std::size_t n = 0; n < eighths.size(); ++n) {
    if (eighths[n] % 8 != 0) return;
    difference += n < insides ? eighths[n] : -eighths[n];
  }
  if (difference != 0) return;
  for (std::size_t n = 0; n < components.size(); ++n)
    components[n].euler = eighths[n] / 4;  // the boundary has twice it
}

std::uint32_t LevelTopology::Impl::label_at(const NodeIndex& node) const {
  const std::array<int, 3>& size = heights->size();
  for (int axis = 0; axis < 3; ++axis) {
    if (node[axis] < 0 || node[axis] >= size[axis]) return 0;
  }
  const std::size_t row = static_cast<std::size_t>(node[2]) * size[1] + node[1];
  const auto begin = runs.begin() + row_begin[row];
  const auto after = std::upper_bound(begin, runs.begin() + row_begin[row + 1], node[0],
                                      [](int i, const Run& run) { return i < run.begin; });
  return after != begin && node[0] < std::prev(after)->end ? std::prev(after)->label : 0;
}

NodeIndex LevelTopology::Impl::cell_at(const Vec& index) const {
  NodeIndex cell;
  for (int axis = 0; axis < 3; ++axis) {
    cell[axis] = static_cast<int>(std::clamp(std::floor(index[axis]), -1.0, heights->size()[axis] - 1.0));
  }
  return cell;
}

/// Label of the inside (or outside) component at a point on the level set. Rounding may have moved the point across a
/// face into a cell that has no corner on that side; then a neighbour has.
std::uint32_t LevelTopology::Impl::reached_label(const Vec& index, bool inside) const {
  const NodeIndex cell = cell_at(index);
  NodeIndex aside{};
  for (int axis = 0; axis < 3; ++axis) {
    const double u = index[axis] - cell[axis];
    if (u < kNeighborTolerance && cell[axis] > -1) aside[axis] = -1;
    if (u > 1 - kNeighborTolerance && cell[axis] < heights->size()[axis] - 1) aside[axis] = 1;
  }
  for (unsigned choice = 0; choice < 8; ++choice) {
    NodeIndex at = cell;
    bool exists = true;
    Vec u;
    for (int axis = 0; axis < 3; ++axis) {
      if (choice >> axis & 1) {
        exists = exists && aside[axis] != 0;
        at[axis] += aside[axis];
      }
      u[axis] = std::clamp(index[axis] - at[axis], 0.0, 1.0);
    }
    if (!exists) continue;
    const CellHeights corners = heights->field_corners(at[0], at[1], at[2]);
    const int corner = walk_to_corner(corners, u, inside ? 1 : -1);
    const NodeIndex node{at[0] + (corner & 1), at[1] + (corner >> 1 & 1), at[2] + (corner >> 2)};
    if ((heights->height(node[0], node[1], node[2]) > 0) != inside) continue;
    if (const std::uint32_t label = label_at(node); corners[corner] != 0 || label != 0) return label;
  }
  return 0;  // not a point on the level set
}

LevelTopology::LevelTopology(const Scan& scan, const LevelSetSettings& settings, const Progress& progress)
    : LevelTopology(make_height_grid(scan, settings), scan.frame, progress) {}

LevelTopology::LevelTopology(std::unique_ptr<HeightGrid> height_grid, const Frame& frame, const Progress& progress)
    : impl_(std::make_unique<Impl>()) {
  impl_->frame = frame;
  impl_->heights = std::move(height_grid);
  const HeightGrid& heights = *impl_->heights;
  std::vector<LevelSlab> slabs = make_level_slabs(heights, progress);
  if (progress.cancelled()) return;
  const std::vector<Measure> measures = sew(slabs);
  SurfaceList surfaces;
  for (const LevelSlab& slab : slabs) surfaces.add(slab.surfaces);
  const std::vector<std::uint32_t> surface_counts = surfaces.count(measures.size());
  std::vector<std::uint32_t> order;
  for (std::uint32_t n = 1; n < measures.size(); ++n) order.push_back(n);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Measure& first = measures[a];
    const Measure& second = measures[b];
    if (first.inside != second.inside) return first.inside;
    return first.nodes != second.nodes ? first.nodes > second.nodes : first.witness < second.witness;
  });
  std::vector<std::uint32_t> rank(measures.size(), 0);
  std::uint32_t cavities = 0;
  std::vector<std::int64_t> eighths;
  impl_->components.reserve(order.size());
  for (std::uint32_t n : order) {
    const Measure& measure = measures[n];
    rank[n] = measure.inside ? impl_->insides++ : ++cavities;  // 0 is the largest inside, and the unbounded outside
    impl_->components.push_back(measure.component(frame));
    if (!surface_counts.empty()) impl_->components.back().surfaces = surface_counts[n];
    eighths.push_back(measure.eighths);
    if (measure.nodes <= kSmallComponent && !is_island(heights, measure.witness)) {
      impl_->small_components.push_back(measure.witness);
    }
  }
  eighths.push_back(measures[0].eighths);
  impl_->store_runs(slabs, rank, progress);
  impl_->mark_blocks();
  impl_->set_euler_numbers(slabs, std::move(eighths), progress);
  impl_->small_components.shrink_to_fit();
}

LevelTopology::~LevelTopology() = default;
LevelTopology::LevelTopology(LevelTopology&&) noexcept = default;
LevelTopology& LevelTopology::operator=(LevelTopology&&) noexcept = default;

const std::vector<Component>& LevelTopology::components() const {
  return impl_->components;
}

void LevelTopology::visit_nodes_from(std::size_t first, const std::function<void(int, int, int, int)>& visit) const {
  const bool inside = first < impl_->insides;
  const std::size_t label = inside ? first : first - impl_->insides + 1;  // 0 is the unbounded outside
  const HeightGrid& heights = *impl_->heights;
  for (std::size_t row = 0; row + 1 < impl_->row_begin.size(); ++row) {
    const int j = static_cast<int>(row) % heights.size()[1];
    const int k = static_cast<int>(row) / heights.size()[1];
    for (std::uint32_t n = impl_->row_begin[row]; n < impl_->row_begin[row + 1]; ++n) {
      const Impl::Run& run = impl_->runs[n];
      if (run.label >= label && (heights.height(run.begin, j, k) > 0) == inside) visit(run.begin, run.end, j, k);
    }
  }
}

std::vector<SizeHint> LevelTopology::size_hints() const {
  return narrow_places(*impl_->heights, impl_->frame, impl_->small_components);
}

void LevelTopology::narrow_ways(LevelGround ground, const NarrowWaySink& sink) const {
  scantet::narrow_ways(*impl_->heights, impl_->frame, ground, sink);
}

std::vector<Misplaced> LevelTopology::misplaced(const TriangleSurface& boundary, const PlaceFilter& is_asked) const {
  return misplaced_nodes(*impl_->heights, impl_->frame, boundary, is_asked);
}

std::array<ComponentId, 2> LevelTopology::components_at(const Vec& index) const {
  if (!impl_->has_runs[impl_->block_of(impl_->cell_at(index))]) return {0, 0};
  return {impl_->reached_label(index, false), impl_->reached_label(index, true)};
}

std::size_t LevelTopology::memory_bytes() const {
  return sizeof(Impl) + impl_->components.capacity() * sizeof(Component) +
         impl_->small_components.capacity() * sizeof(NodeIndex) + impl_->row_begin.capacity() * sizeof(std::uint32_t) +
         impl_->runs.capacity() * sizeof(Impl::Run) + impl_->has_runs.capacity() / 8;
}

}  // namespace scantet
