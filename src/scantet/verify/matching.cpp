// A component of the field is where its deepest node is: the mesh covers that node, and one surface around it is that
// of the component. A component of few voxels may have a mesh that does not reach its deepest node, or have that node
// covered by the mesh of another, and one in a cavity has the surfaces of others around it; then it is where a tet of
// the mesh's component has its middle. A cavity's deepest node is not covered.
#include "scantet/verify/matching.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "scantet/verify/findings.h"

namespace scantet::verify {
namespace {

class Matcher {
 public:
  Matcher(const TetMesh& mesh, const Shell& shell, const BoundaryRays& rays, const VoxelNodes& nodes,
          const FieldParts& parts, std::vector<VerifyFinding>& found)
      : mesh_(mesh), shell_(shell), nodes_(nodes), parts_(parts), rays_(rays), map_(nodes.frame()), findings_(found) {}

  Matching run() {
    count();
    for (const FieldPart& part : parts_.parts) {
      if (part.is_unbounded) continue;
      if (part.side > 0) {
        place_component(part);
      } else if (out_.mesh.cavities < out_.field.cavities && coverage(part.deepest) == 1) {
        findings_.add("cavity.missing", "a cavity of the scan is filled by the mesh", world(part.deepest));
      }
    }
    place_by_tets();
    for (const Loose& loose : loose_) tell(loose);
    find_extra();
    compare_euler();
    return out_;
  }

 private:
  /// A component that could not be placed by its deepest node.
  struct Loose {
    const FieldPart* part;
    bool is_covered;  // its deepest node is in the mesh, or may be
  };
  Point world(const Cell& node) const {
    return nodes_.frame().to_world({double(node[0]), double(node[1]), double(node[2])});
  }

  void count() {
    out_.field.components = parts_.inside;
    out_.field.cavities = parts_.outside - 1;
    for (const FieldPart& part : parts_.parts) out_.field.euler += part.side > 0 ? 2 * part.euler : 0;
    out_.field.is_known = parts_.is_known && parts_.loose_nodes == 0;
    out_.mesh.components = static_cast<std::int64_t>(shell_.tet_components);
    out_.mesh.cavities = static_cast<std::int64_t>(shell_.first.size()) - out_.mesh.components;
    for (const std::int64_t euler : shell_.euler) out_.mesh.euler += euler;
    out_.has_same_counts = out_.field.components == out_.mesh.components && out_.field.cavities == out_.mesh.cavities;
    out_.has_same_euler = out_.field.euler == out_.mesh.euler;
  }

  /// How often the mesh covers a node; hits_ has the surfaces that a ray from there meets. -1: not known.
  int coverage(const Cell& node) {
    bool has_moved = false;
    return rays_.coverage(world(node), hits_, has_moved);
  }

  void place_component(const FieldPart& part) {
    const int covered = coverage(part.deepest);
    if (covered != 1) {
      loose_.push_back({&part, covered != 0});
      return;
    }
    std::map<std::uint32_t, int> around;  // by surface
    for (const auto& hit : hits_) around[shell_.component[hit.facet]] += hit.direction;
    std::vector<std::uint32_t> inside;  // of these surfaces; of an island in a cavity they are several
    for (const auto& [surface, times] : around) {
      if (times == 1) inside.push_back(surface);
    }
    if (inside.size() != 1) {
      loose_.push_back({&part, true});
    } else if (!field_of_.emplace(inside[0], &part).second) {
      contest(inside[0], part);
    }
  }

  /// The mesh of one component covers the deepest nodes of two. surface: has one of them already.
  void contest(std::uint32_t surface, const FieldPart& part) {
    if (!out_.has_same_counts) {
      findings_.add("component.joined", "two components of the scan are one in the mesh", world(part.deepest));
    } else {
      loose_.push_back({&part, true});
      if (contested_.insert(surface).second) loose_.push_back({field_of_.at(surface), true});
    }
  }

  /// Matches components that could not be placed with components of the mesh that have none yet.
  void place_by_tets() {
    for (const std::uint32_t surface : contested_) field_of_.erase(surface);
    if (loose_.empty()) return;
    constexpr int kMostTets = 64;  // of a component: enough for one of a few voxels
    std::vector<int> looked(shell_.first.size(), 0);
    for (std::size_t f = 0; f < shell_.facets.size(); ++f) {
      const std::uint32_t surface = shell_.component[f];
      if (field_of_.contains(surface) || looked[surface]++ >= kMostTets) continue;
      const FieldPart* here = part_at(middle(shell_.tet_behind[f]));
      const auto found =
          std::find_if(loose_.begin(), loose_.end(), [&](const Loose& loose) { return loose.part == here; });
      if (found == loose_.end()) continue;
      field_of_.emplace(surface, here);
      loose_.erase(found);
    }
  }

  Point middle(std::uint32_t tet) const {
    Point sum{0, 0, 0};
    for (const VertexId v : mesh_.tets[tet]) sum = sum + mesh_.vertices[v];
    return 0.25 * sum;
  }

  /// The component of the field that holds a point; none if that is not certain. From there it is followed to a corner
  /// of the cell, axis by axis: the field is linear along each, so no less at one of the ends.
  const FieldPart* part_at(const Point& p) const {
    if (parts_.part_of.empty()) return nullptr;
    IntervalVec at = map_.to_index(p);
    Cell cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = std::floor(at[axis].lo);
      if (!(low >= -1 && low < nodes_.size()[axis]) || at[axis].hi > low + 1) return nullptr;
      cell[axis] = static_cast<int>(low);
    }
    const CellValues heights = nodes_.cell(cell);
    const auto is_inside = [&] { return value_at(heights, cell, at[0], at[1], at[2]).lo > 0; };
    if (!is_inside()) return nullptr;
    Cell node = cell;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      at[axis] = Interval(node[axis]);
      if (is_inside()) continue;
      at[axis] = Interval(++node[axis]);
      if (!is_inside()) return nullptr;
    }
    return &parts_.parts[parts_.part_of[number(node)]];
  }

  /// Of a node in FieldParts::part_of.
  std::size_t number(const Cell& node) const {
    const auto at = [&](std::size_t axis) { return static_cast<std::size_t>(node[axis]) + 1; };
    const auto width = [&](std::size_t axis) { return static_cast<std::size_t>(nodes_.size()[axis]) + 2; };
    return (at(2) * width(1) + at(1)) * width(0) + at(0);
  }

  void tell(const Loose& loose) {
    const Point place = world(loose.part->deepest);
    if (!loose.is_covered && out_.mesh.components < out_.field.components) {
      findings_.add("component.missing", "a component of the scan is not in the mesh", place);
    } else {
      findings_.add_undecided("component.unmatched", "a component of the scan was not found again in the mesh", place,
                              false);
    }
  }

  void find_extra() {
    if (out_.mesh.components > out_.field.components) {
      for (std::uint32_t s = 0; s < shell_.first.size(); ++s) {
        if (field_of_.contains(s)) continue;
        findings_.add("component.extra", "a part of the mesh is no component of the scan", first_point(s));
        break;
      }
    }
    if (out_.mesh.cavities > out_.field.cavities) {
      for (std::uint32_t s = 0; s < shell_.first.size(); ++s) {
        if (field_of_.contains(s)) continue;
        findings_.add("cavity.extra", "the mesh has a cavity that the scan has not", first_point(s));
        break;
      }
    }
    if (out_.has_same_counts) return;
    findings_.add("topology.counts", "the mesh has not as many components and cavities as the scan", first_point(0));
  }

  void compare_euler() {
    if (!parts_.is_known || !out_.has_same_counts) return;
    if (!out_.has_same_euler) {
      std::uint32_t where = 0;
      for (const auto& [surface, part] : field_of_) {
        if (2 * part->euler == shell_.euler[surface] || out_.mesh.cavities != 0) continue;
        where = surface;
        break;
      }
      findings_.add("handles.differ",
                    "the mesh's boundary has another Euler number, hence other handles, than the scan",
                    first_point(where));
    }
    if (out_.mesh.cavities != 0) return;  // the surfaces of a component are several
    for (const auto& [surface, part] : field_of_) {
      if (2 * part->euler == shell_.euler[surface]) continue;
      out_.has_same_euler = false;
      findings_.add("handles.component", "a component of the mesh has other handles than the scan's",
                    first_point(surface));
    }
  }

  Point first_point(std::uint32_t surface) const {
    return mesh_.vertices[shell_.vertices[shell_.facets[shell_.first[surface]][0]]];
  }

  const TetMesh& mesh_;
  const Shell& shell_;
  const VoxelNodes& nodes_;
  const FieldParts& parts_;
  const BoundaryRays& rays_;
  IndexMap map_;
  std::map<std::uint32_t, const FieldPart*> field_of_;  // of surfaces that are the outermost of a mesh's component
  std::set<std::uint32_t> contested_;                   // of them, those that cover the deepest nodes of several
  std::vector<Loose> loose_;
  std::vector<BoundaryRays::Hit> hits_;
  FindingList findings_;
  Matching out_;
};

}  // namespace

Matching match_parts(const TetMesh& mesh, const Shell& shell, const BoundaryRays& rays, const VoxelNodes& nodes,
                     const FieldParts& parts, std::vector<VerifyFinding>& found) {
  return Matcher(mesh, shell, rays, nodes, parts, found).run();
}

}  // namespace scantet::verify
