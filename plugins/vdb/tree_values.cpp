// Leaves are looked at side by side, tiles one by one. Inactive voxels have values, too (a level set's inside is
// inactive): what counts is the value, and the background is where a voxel is inactive and has its value.
#include "tree_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/base/parallel.h"

namespace vdb {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using scantet::Error;
using scantet::Fault;
using scantet::number_text;

constexpr int kMostNodes = 8'192;  // along an axis: tables of rows and of coarse blocks grow with the box

/// What is found out about voxels on the way.
struct Found {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  CoordBBox box;
  std::int64_t not_finite = 0;
  Coord first_not_finite;

  /// place(): where it is.
  template <class Value, class Place>
  void add_value(Value value, const Place& place) {
    const auto number = static_cast<double>(value);
    if (!std::isfinite(number)) {
      if (not_finite++ == 0) first_not_finite = place();
      return;
    }
    min = std::min(min, number);
    max = std::max(max, number);
  }
  void merge(const Found& other) {
    min = std::min(min, other.min);
    max = std::max(max, other.max);
    box.expand(other.box);
    if (not_finite == 0) first_not_finite = other.first_not_finite;
    not_finite += other.not_finite;
  }
};

template <class LeafNode>
void look_at(const LeafNode& leaf, typename LeafNode::ValueType background, Found& found) {
  const auto* values = leaf.buffer().data();
  CoordBBox box;  // in the leaf
  for (openvdb::Index n = 0; n < LeafNode::SIZE; ++n) {
    found.add_value(values[n], [&] { return leaf.offsetToGlobalCoord(n); });
    if (leaf.isValueOn(n) || values[n] != background) box.expand(LeafNode::offsetToLocalCoord(n));
  }
  if (!box.empty()) found.box.expand(CoordBBox(leaf.origin() + box.min(), leaf.origin() + box.max()));
}

template <class Tree>
Found look_at_leaves(const std::vector<const typename Tree::LeafNodeType*>& leaves, const Tree& tree) {
  constexpr std::size_t kGrain = 1024;
  const auto parts = scantet::parallel_collect<Found>(leaves.size(), kGrain,
                                                      [&](std::size_t begin, std::size_t end, std::vector<Found>& out) {
                                                        Found& found = out.emplace_back();
                                                        for (std::size_t n = begin; n < end; ++n)
                                                          look_at(*leaves[n], tree.background(), found);
                                                      });
  Found all;
  for (const Found& part : parts) all.merge(part);
  return all;
}

/// The tiles that are active or differ from the background, in the grid's own index.
template <class Tree>
std::vector<std::pair<CoordBBox, typename Tree::ValueType>> tiles_of(const Tree& tree, Found& found) {
  std::vector<std::pair<CoordBBox, typename Tree::ValueType>> tiles;
  auto tile = tree.cbeginValueAll();
  tile.setMaxDepth(Tree::ValueAllCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    if (!tile.isValueOn() && *tile == tree.background()) continue;
    const CoordBBox box = tile.getBoundingBox();
    found.add_value(*tile, [&] { return box.min(); });
    found.box.expand(box);
    tiles.emplace_back(box, *tile);
  }
  return tiles;
}

void check(const Found& found, const std::string& where) {
  if (found.not_finite > 0) {
    const Coord& at = found.first_not_finite;
    throw Error(Fault::input, "input.nan",
                where + ": " + std::to_string(found.not_finite) + " values are not finite, the first at index (" +
                    std::to_string(at.x()) + ", " + std::to_string(at.y()) + ", " + std::to_string(at.z()) + ")",
                "replace them in the program that wrote the grid");
  }
  if (found.box.empty()) {
    throw Error(Fault::input, "input.grid", where + ": nothing in it but its background", "choose another grid");
  }
  constexpr double kLargestValue = 1e100;  // as of images
  if (std::max(std::abs(found.min), std::abs(found.max)) > kLargestValue) {
    throw Error(Fault::input, "input.range",
                where + ": it has values beyond 1e100: products of their differences are no numbers",
                "scale its values");
  }
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t nodes = std::int64_t{found.box.max()[axis]} - found.box.min()[axis] + 1;
    if (nodes <= kMostNodes - kBlockSide) continue;
    throw Error(Fault::input, "input.too_large",
                where + ": it spans " + std::to_string(nodes) + " voxels along " + "xyz"[axis] + ", and " +
                    std::to_string(kMostNodes - kBlockSide) + " are the most",
                "clip or resample it");
  }
}

template <class GridType>
void take(const openvdb::GridBase::ConstPtr& source, const std::string& where, Grid& out) {
  using Tree = typename GridType::TreeType;
  using Value = typename Tree::ValueType;
  const Tree& tree = static_cast<const GridType&>(*source).tree();
  std::vector<const typename Tree::LeafNodeType*> leaves;
  tree.getNodes(leaves);
  Found found = look_at_leaves(leaves, tree);
  const auto tiles = tiles_of(tree, found);
  found.add_value(tree.background(), [&] { return found.box.min(); });
  check(found, where);

  SparseValues<Value> values;
  Index base;  // of blocks
  for (int axis = 0; axis < 3; ++axis) {
    base[axis] = found.box.min()[axis] >> kBlockShift;
    out.origin[axis] = base[axis] * kBlockSide;
    out.first[axis] = found.box.min()[axis] - out.origin[axis];
    values.size[axis] = found.box.max()[axis] - out.origin[axis] + 1;
  }
  const auto block_of = [&](const Coord& at) {
    return Index{(at.x() >> kBlockShift) - base[0], (at.y() >> kBlockShift) - base[1],
                 (at.z() >> kBlockShift) - base[2]};
  };
  values.background = tree.background();
  values.leaves.reserve(leaves.size());
  for (const auto* leaf : leaves) {
    const CoordBBox box = leaf->getNodeBoundingBox();
    if (found.box.hasOverlap(box)) values.leaves.push_back({block_of(box.min()), leaf->buffer().data()});
  }
  for (const auto& [box, value] : tiles)
    values.tiles.push_back({block_of(box.min()), box.dim().x() / kBlockSide, value});
  values.owner = source;
  out.values = std::move(values);
  out.min_value = found.min;
  out.max_value = found.max;
  out.background = static_cast<double>(tree.background());
  out.active_voxels = static_cast<std::int64_t>(tree.activeVoxelCount());
  out.memory_bytes = static_cast<std::int64_t>(tree.memUsage());
}

/// A mask as whole numbers, 0 and 1: bits have no address.
openvdb::Int32Grid::Ptr numbers_of(const openvdb::BoolGrid& mask) {
  auto numbers = openvdb::Int32Grid::create(mask.background() ? 1 : 0);
  openvdb::Int32Tree& tree = numbers->tree();
  for (auto value = mask.cbeginValueAll(); value; ++value) {
    if (*value == mask.background() && !value.isValueOn()) continue;
    const int number = *value ? 1 : 0;
    if (!value.isVoxelValue()) {
      tree.addTile(value.getLevel(), value.getCoord(), number, value.isValueOn());
    } else if (value.isValueOn()) {
      tree.setValueOn(value.getCoord(), number);
    } else {
      tree.setValueOff(value.getCoord(), number);
    }
  }
  return numbers;
}

}  // namespace

bool is_supported(const openvdb::GridBase& grid) {
  return grid.isType<openvdb::FloatGrid>() || grid.isType<openvdb::DoubleGrid>() || grid.isType<openvdb::Int32Grid>() ||
         grid.isType<openvdb::Int64Grid>() || is_mask(grid);
}

bool is_mask(const openvdb::GridBase& grid) {
  return grid.isType<openvdb::BoolGrid>();
}

void take_values(const openvdb::GridBase::ConstPtr& source, const std::string& where, Grid& out) {
  if (is_mask(*source)) {
    return take<openvdb::Int32Grid>(numbers_of(static_cast<const openvdb::BoolGrid&>(*source)), where, out);
  }
  if (source->isType<openvdb::FloatGrid>()) return take<openvdb::FloatGrid>(source, where, out);
  if (source->isType<openvdb::DoubleGrid>()) return take<openvdb::DoubleGrid>(source, where, out);
  if (source->isType<openvdb::Int32Grid>()) return take<openvdb::Int32Grid>(source, where, out);
  return take<openvdb::Int64Grid>(source, where, out);
}

}  // namespace vdb
