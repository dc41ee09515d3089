// Parts are a tree: each lies in the one around it, and one surface of the level set is between the two. So the Euler
// numbers of surfaces follow from those of parts, from the innermost out, and those of what is left from its surfaces.
#include "scantet/verify/left_out.h"

#include <algorithm>
#include <cmath>

#include "scantet/base/union_find.h"

namespace scantet::verify {
namespace {

class Search {
 public:
  Search(const BoundaryRays& rays, const VoxelNodes& nodes, const FieldParts& parts, const MayBeLeftOut& allowed)
      : nodes_(nodes),
        parts_(parts.parts),
        rays_(rays),
        allowed_(allowed),
        voxel_mm3_(std::abs(nodes.frame().determinant_mm3())) {
    out_.rest.is_known = parts.is_known;
    out_.rest.has_tied_saddles = parts.has_tied_saddles;
    out_.rest.nodes_at_level = parts.nodes_at_level;
    out_.rest.loose_nodes = parts.loose_nodes;
    out_.rest.loose_node = parts.loose_node;
  }

  LeftOut run() {
    rank();
    out_.is_left_out.assign(parts_.size(), 0);
    for (std::size_t p = 0; p < parts_.size(); ++p) look_at(p);
    std::stable_sort(out_.list.begin(), out_.list.end(),
                     [](const LeftOutPart& a, const LeftOutPart& b) { return a.volume_mm3 > b.volume_mm3; });
    join();
    return std::move(out_);
  }

 private:
  double volume(const FieldPart& part) const { return static_cast<double>(part.nodes) * voxel_mm3_; }

  /// The volume from which on components are among the largest.
  void rank() {
    if (!allowed_.all_but_components) return;
    std::vector<std::int64_t> sizes;
    for (const FieldPart& part : parts_) {
      if (part.side > 0) sizes.push_back(part.nodes);
    }
    std::sort(sizes.rbegin(), sizes.rend());
    const std::uint64_t count = *allowed_.all_but_components;
    if (count == 0 || count >= sizes.size()) return;
    least_nodes_ = sizes[count - 1];
    // Of equals some may be left out.
    spare_ = std::count_if(sizes.begin(), sizes.end(), [&](std::int64_t n) { return n >= least_nodes_; }) -
             static_cast<std::int64_t>(count);
  }

  bool may_be_left_out(const FieldPart& part) {
    if (part.is_unbounded) return false;
    if (part.side < 0) return volume(part) < allowed_.cavities_below_mm3;
    if (volume(part) < allowed_.components_below_mm3 || part.nodes < least_nodes_) return true;
    if (part.nodes != least_nodes_ || spare_ <= 0) return false;
    --spare_;
    return true;
  }

  void look_at(std::size_t p) {
    const FieldPart& part = parts_[p];
    if (part.is_unbounded) return;
    const Point place =
        nodes_.frame().to_world({double(part.deepest[0]), double(part.deepest[1]), double(part.deepest[2])});
    bool has_moved = false;
    const int covered = rays_.coverage(place, hits_, has_moved);
    if (has_moved) out_.places.push_back(place);
    if (covered == (part.side > 0 ? 1 : 0)) return;
    if ((covered != 0 && covered != 1) || !may_be_left_out(part)) {
      out_.is_sound = false;
      return;
    }
    out_.is_left_out[p] = 1;
    out_.list.push_back({part.side < 0, place, volume(part)});
    out_.places.push_back(place);
  }

  int side(std::size_t p) const { return out_.is_left_out[p] != 0 ? -parts_[p].side : parts_[p].side; }

  /// What is left: parts of one side that nothing parts any more are one.
  void join() {
    UnionFind sets(parts_.size());
    std::vector<std::int64_t> surface(parts_.size(), 0);  // the Euler number of the one around each part
    for (std::size_t p = 0; p < parts_.size(); ++p) surface[p] = 2 * parts_[p].euler;
    for (std::size_t p = parts_.size(); p-- > 0;) {  // what is around a part comes before it
      const std::uint32_t around = parts_[p].around;
      if (around != FieldPart::kNoPart) surface[around] -= surface[p];
    }
    for (std::uint32_t p = 0; p < parts_.size(); ++p) {
      const std::uint32_t around = parts_[p].around;
      if (around == FieldPart::kNoPart) {
        out_.rest.is_known = out_.rest.is_known && parts_[p].is_unbounded;
      } else if (side(p) == side(around)) {
        sets.unite(p, around);
      }
    }
    std::vector<std::uint32_t>& number = out_.part_in_rest;
    out_.rest.parts.resize(sets.number_sets(number));
    std::vector<std::int64_t> most(out_.rest.parts.size(), -1);
    for (std::uint32_t p = 0; p < parts_.size(); ++p) {
      FieldPart& to = out_.rest.parts[number[p]];
      to.side = side(p);
      to.nodes += parts_[p].nodes;
      to.is_unbounded = to.is_unbounded || parts_[p].is_unbounded;
      const std::uint32_t around = parts_[p].around;
      if (around != FieldPart::kNoPart && number[around] != number[p]) {
        to.around = number[around];
        to.euler += surface[p];
        out_.rest.parts[number[around]].euler += surface[p];
      }
      if (out_.is_left_out[p] != 0 || parts_[p].nodes <= most[number[p]]) continue;
      most[number[p]] = parts_[p].nodes;
      to.deepest = parts_[p].deepest;
    }
    for (FieldPart& part : out_.rest.parts) {
      part.euler /= 2;  // a boundary has twice the Euler number of what it bounds
      ++(part.side > 0 ? out_.rest.inside : out_.rest.outside);
    }
  }

  const VoxelNodes& nodes_;
  const std::vector<FieldPart>& parts_;
  const BoundaryRays& rays_;
  std::vector<BoundaryRays::Hit> hits_;
  const MayBeLeftOut& allowed_;
  double voxel_mm3_;
  std::int64_t least_nodes_ = 0;
  std::int64_t spare_ = 0;
  LeftOut out_;
};

}  // namespace

NodeSides::NodeSides(const VoxelNodes& nodes, const FieldParts& parts, const std::vector<std::uint8_t>& is_left_out) {
  for (std::size_t axis = 0; axis < 3; ++axis) width_[axis] = nodes.size()[axis] + 2;
  side_.resize(parts.part_of.size(), 0);
  for (std::size_t n = 0; n < side_.size(); ++n) {
    const std::uint32_t p = parts.part_of[n];
    if (p == FieldPart::kNoPart) continue;
    const bool is_gone = is_left_out[p] != 0;
    side_[n] = static_cast<std::int8_t>(((parts.parts[p].side > 0) != is_gone ? kInside : kOutside) |
                                        (is_gone ? kLeftOut : 0));
  }
}

std::size_t NodeSides::node(const Cell& cell, int corner) const {
  const auto i = static_cast<std::size_t>(cell[0]) + 1 + static_cast<std::size_t>(corner & 1);
  const auto j = static_cast<std::size_t>(cell[1]) + 1 + static_cast<std::size_t>(corner >> 1 & 1);
  const auto k = static_cast<std::size_t>(cell[2]) + 1 + static_cast<std::size_t>(corner >> 2);
  return (k * static_cast<std::size_t>(width_[1]) + j) * static_cast<std::size_t>(width_[0]) + i;
}

bool NodeSides::has_left_out(const Cell& cell) const {
  for (int c = 0; c < 8; ++c) {
    if ((side_[node(cell, c)] & kLeftOut) != 0) return true;
  }
  return false;
}

int NodeSides::side_of(const Cell& cell) const {
  int all = kInside | kOutside;
  for (int c = 0; c < 8; ++c) all &= side_[node(cell, c)];
  return all == kInside ? 1 : all == kOutside ? -1 : 0;
}

LeftOut find_left_out(const BoundaryRays& rays, const VoxelNodes& nodes, const FieldParts& parts,
                      const MayBeLeftOut& allowed) {
  LeftOut out = Search(rays, nodes, parts, allowed).run();
  if (!out.list.empty()) out.sides = NodeSides(nodes, parts, out.is_left_out);
  return out;
}

}  // namespace scantet::verify
