// Region r is A ∩ D, with A the inside of its own level and D the outside of the next. A ∪ D is all of space, which has
// no holes; so (Mayer–Vietoris) components of A and of D that meet at all meet in one component of the region, and the
// graph with the components of A and D for nodes and those of the region for edges is a tree. Seen from the unbounded
// component of D, every other node has one edge towards it: that is where the node's outer wall is. So the region has
// one component for each component of A, under its outer wall, and one for each cavity of D, above its outer wall.
//
// A ray to infinity leaves a node for the last time through its outer wall: that finds the wall, and a point beside it.
// The volume at a node is known from counts of grid nodes, that of an edge is what the other edges leave of it; with
// the Euler numbers of boundaries it is the same, but that those of what is taken out of a node are added.
#include "scantet/topology/nested_components.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "scantet/base/neighbors.h"

namespace scantet {
namespace {

// Of a level set's patches.
ComponentId inside_part(const Patch& patch) {
  return patch.components[1];
}
ComponentId outside_part(const Patch& patch) {
  return patch.components[0];
}

/// A node of the tree, with its edge towards the unbounded outside.
struct Node {
  Component component;        ///< of its level
  std::uint32_t number = 0;   ///< as patches of the level count
  double volume_mm3 = 0;      ///< of the region in it
  std::int64_t euler = 0;     ///< of the boundaries of the region's components in it, together
  std::int64_t surfaces = 0;  ///< in these
  Point witness;              ///< in its edge
  bool found = false;         ///< there is a witness
  std::vector<Node*> inward;  ///< the nodes whose edges towards the outside end here
};

double volume_of_edge(const Node& node) {
  double volume = node.volume_mm3;
  for (const Node* other : node.inward) volume -= volume_of_edge(*other);
  return std::max(volume, 0.0);
}

/// Euler number and surfaces of the boundary.
std::array<std::int64_t, 2> boundary_of_edge(const Node& node) {
  std::array<std::int64_t, 2> boundary{node.euler, node.surfaces};
  for (const Node* other : node.inward) {
    const auto [euler, surfaces] = boundary_of_edge(*other);
    boundary[0] -= euler;
    boundary[1] -= surfaces;
  }
  return boundary;
}

/// The components of one region.
class RegionTree {
 public:
  /// next: null for the innermost region.
  RegionTree(const Domain& nested, Region region, const Domain& own, const Domain* next)
      : nested_(nested), region_(region), own_(own), next_(next), reach_mm_(nested.bounds().diagonal()) {
    for (const Component& component : own.components()) {
      if (component.region != kOutside) insides_.push_back(node_of(component, insides_.size()));
    }
    if (next == nullptr) return;
    std::uint32_t cavities = 0;
    for (const Component& component : next->components()) {
      if (component.region != kOutside) continue;
      ++cavities;
      cavities_.push_back(node_of(component, cavities));
    }
  }

  void list(std::vector<Component>& out) {
    find_witnesses();
    if (next_ != nullptr) share_volumes();
    for (const std::vector<Node>* nodes : {&insides_, &cavities_}) {
      for (const Node& node : *nodes) knows_boundaries_ = knows_boundaries_ && node.found && node.component.handles();
    }
    for (const std::vector<Node>* nodes : {&insides_, &cavities_}) {
      for (const Node& node : *nodes) {
        if (!node.found) continue;
        out.push_back(node.component);
        out.back().region = region_;
        out.back().witness = node.witness;
        assert(nested_.region_at(node.witness) == region_);
        out.back().volume_mm3 = volume_of_edge(node);
        out.back().euler.reset();
        out.back().surfaces.reset();
        if (!knows_boundaries_) continue;
        const auto [euler, surfaces] = boundary_of_edge(node);
        out.back().euler = euler;
        out.back().surfaces = static_cast<std::uint64_t>(surfaces);
      }
    }
  }

 private:
  static std::int64_t surfaces_of(const Component& component) {
    return static_cast<std::int64_t>(component.surfaces.value_or(0));
  }

  static Node node_of(const Component& component, std::size_t number) {
    Node node;
    node.component = component;
    node.number = static_cast<std::uint32_t>(number);
    node.volume_mm3 = component.volume_mm3;
    node.euler = component.euler.value_or(0);
    node.surfaces = surfaces_of(component);
    return node;
  }

  void find_witnesses() {
    for (Node& node : insides_) {
      find_witness(node, region_ - 1, [&](const Point& p) { return inside_part(own_.patch_at(p)) == node.number; });
    }
    for (Node& node : cavities_) {
      find_witness(node, region_ + 1, [&](const Point& p) { return outside_part(next_->patch_at(p)) == node.number; });
    }
  }

  /// A point of the region at the node's outer wall, beyond which lies the region `beyond`. is_wall(p): p, on the level
  /// set between the two, is on a wall of the node.
  template <class IsWall>
  void find_witness(Node& node, Region beyond, const IsWall& is_wall) {
    const Point& start = node.component.witness;
    if (nested_.region_at(start) == region_) {  // nothing else is in the node
      node.witness = start;
      node.found = true;
      return;
    }
    double widest = 0;
    for (const NeighborOffset& offset : kNeighborhood) {
      nested_.crossings({start, start + reach_mm_ * as_vec(offset)}, crossings_);
      for (std::size_t n = crossings_.size(); n-- > 0;) {
        const Crossing& c = crossings_[n];
        if (c.from != region_ || c.to != beyond || !is_wall(c.point)) continue;
        const Point before = n == 0 ? start : crossings_[n - 1].point;
        const Point middle = lerp(before, c.point, 0.5);
        const double width = distance(before, c.point);
        if (width > widest && nested_.region_at(middle) == region_) {
          widest = width;
          node.witness = middle;
          node.found = true;
        }
        break;
      }
    }
  }

  /// The patch where a ray from p first meets the level set; none if it does not.
  std::optional<Patch> first_wall(const Domain& level, const Point& p) {
    level.crossings({p, p + Vec{reach_mm_, 0, 0}}, crossings_);
    if (crossings_.empty()) return std::nullopt;
    return crossings_.front().patch();
  }

  Node* inside_around(const Point& p) {
    const auto wall = first_wall(own_, p);
    return wall && inside_part(*wall) < insides_.size() ? &insides_[inside_part(*wall)] : nullptr;
  }

  Node* cavity_around(const Point& p) {
    const auto wall = first_wall(*next_, p);
    if (!wall) return nullptr;
    const auto found = std::lower_bound(cavities_.begin(), cavities_.end(), outside_part(*wall),
                                        [](const Node& node, std::uint32_t number) { return node.number < number; });
    return found != cavities_.end() && found->number == outside_part(*wall) ? &*found : nullptr;
  }

  /// Takes from a node what is in it, which bounds the region there.
  void take_out(const Component& component, Node* node) {
    knows_boundaries_ = knows_boundaries_ && component.handles();
    if (node == nullptr) return;
    node->volume_mm3 -= component.volume_mm3;
    node->euler += component.euler.value_or(0);
    node->surfaces += surfaces_of(component);
  }

  void share_volumes() {
    for (const Component& inner : next_->components()) {
      if (inner.region == kOutside) continue;
      Node* const node = inside_around(inner.witness);
      knows_boundaries_ = knows_boundaries_ && node != nullptr;
      take_out(inner, node);
    }
    for (const Component& outer : own_.components()) {
      if (outer.region == kOutside) take_out(outer, cavity_around(outer.witness));
    }
    for (Node& node : insides_) {
      Node* outward = node.found ? cavity_around(node.witness) : nullptr;
      if (outward != nullptr) outward->inward.push_back(&node);
    }
    for (Node& node : cavities_) {
      Node* outward = node.found ? inside_around(node.witness) : nullptr;
      if (outward != nullptr) outward->inward.push_back(&node);
    }
  }

  const Domain& nested_;
  Region region_;
  const Domain& own_;
  const Domain* next_;
  double reach_mm_;
  bool knows_boundaries_ = true;  // every number that goes into those of the region, and where
  std::vector<Node> insides_;     // by number
  std::vector<Node> cavities_;    // ascending by number
  Crossings crossings_;
};

}  // namespace

std::vector<Component> nested_components(const Domain& nested, std::span<const std::unique_ptr<Domain>> levels) {
  assert(!levels.empty());
  std::vector<Component> components;
  for (std::size_t n = 0; n < levels.size(); ++n) {
    const Domain* next = n + 1 < levels.size() ? levels[n + 1].get() : nullptr;
    RegionTree(nested, static_cast<Region>(n + 1), *levels[n], next).list(components);
  }
  for (const Component& component : levels.front()->components()) {
    if (component.region == kOutside) components.push_back(component);
  }
  return components;
}

}  // namespace scantet
