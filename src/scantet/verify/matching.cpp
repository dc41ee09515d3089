// A component of the field is where its deepest node is: the mesh must cover that node, and the outermost surface
// around it is that of the component. A cavity's deepest node must not be covered.
#include "scantet/verify/matching.h"

#include <map>

#include "scantet/verify/findings.h"

namespace scantet::verify {
namespace {

class Matcher {
 public:
  Matcher(const TetMesh& mesh, const Shell& shell, const BoundaryRays& rays, const VoxelNodes& nodes,
          const FieldParts& parts, std::vector<VerifyFinding>& found)
      : mesh_(mesh), shell_(shell), nodes_(nodes), parts_(parts), rays_(rays), findings_(found) {}

  Matching run() {
    count();
    std::map<std::uint32_t, const FieldPart*> field_of;  // of surfaces that are the outermost of a mesh's component
    for (const FieldPart& part : parts_.parts) {
      if (part.is_unbounded) continue;
      if (part.side > 0) {
        place_component(part, field_of);
      } else if (coverage(part.deepest) == 1 && !out_.has_same_counts) {
        findings_.add("cavity.missing", "a cavity of the scan is filled by the mesh", world(part.deepest));
      }
    }
    find_extra(field_of);
    compare_euler(field_of);
    return out_;
  }

 private:
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

  void place_component(const FieldPart& part, std::map<std::uint32_t, const FieldPart*>& field_of) {
    const int covered = coverage(part.deepest);
    if (covered < 0) return;  // not known
    if (covered != 1 && out_.has_same_counts) {
      findings_.add_undecided("component.unmatched", "the middle of a component of the scan is not in the mesh",
                              world(part.deepest), false);
      return;
    }
    if (covered != 1) {
      findings_.add("component.missing", "a component of the scan is not in the mesh", world(part.deepest));
      return;
    }
    std::map<std::uint32_t, int> around;  // by surface
    for (const auto& hit : hits_) around[shell_.component[hit.facet]] += hit.direction;
    // Of the surfaces around the node the innermost that has it inside bounds its component: nested ones have it
    // outside in between. Where there are several, the smallest is inside of the others.
    std::vector<std::uint32_t> inside;
    for (const auto& [surface, times] : around) {
      if (times == 1) inside.push_back(surface);
    }
    if (inside.size() != 1) return;  // an island in a cavity: not matched
    if (!field_of.emplace(inside[0], &part).second && !out_.has_same_counts) {
      findings_.add("component.joined", "two components of the scan are one in the mesh", world(part.deepest));
    }
  }

  void find_extra(const std::map<std::uint32_t, const FieldPart*>& field_of) {
    if (out_.mesh.components > out_.field.components) {
      for (std::uint32_t s = 0; s < shell_.first.size(); ++s) {
        if (field_of.contains(s)) continue;
        findings_.add("component.extra", "a part of the mesh is no component of the scan", first_point(s));
        break;
      }
    }
    if (out_.mesh.cavities > out_.field.cavities) {
      for (std::uint32_t s = 0; s < shell_.first.size(); ++s) {
        if (field_of.contains(s)) continue;
        findings_.add("cavity.extra", "the mesh has a cavity that the scan has not", first_point(s));
        break;
      }
    }
    if (out_.has_same_counts) return;
    findings_.add("topology.counts", "the mesh has not as many components and cavities as the scan", first_point(0));
  }

  void compare_euler(const std::map<std::uint32_t, const FieldPart*>& field_of) {
    if (!parts_.is_known || !out_.has_same_counts) return;
    if (!out_.has_same_euler) {
      std::uint32_t where = 0;
      for (const auto& [surface, part] : field_of) {
        if (2 * part->euler == shell_.euler[surface] || out_.mesh.cavities != 0) continue;
        where = surface;
        break;
      }
      findings_.add("handles.differ",
                    "the mesh's boundary has another Euler number, hence other handles, than the scan",
                    first_point(where));
    }
    if (out_.mesh.cavities != 0) return;  // the surfaces of a component are several
    for (const auto& [surface, part] : field_of) {
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
