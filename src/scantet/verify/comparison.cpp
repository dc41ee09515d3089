#include "scantet/verify/comparison.h"

#include <algorithm>
#include <string>
#include <utility>

#include "scantet/base/options.h"
#include "scantet/base/parallel.h"
#include "scantet/verify/findings.h"

namespace scantet::verify {
namespace {

class Comparer {
 public:
  Comparer(const TetMesh& mesh, const Shell& shell, const BoundaryRays& rays, VoxelNodes& nodes,
           const MayBeLeftOut& may_be_left_out, const Progress& progress)
      : mesh_(mesh), shell_(shell), rays_(rays), nodes_(nodes), allowed_(may_be_left_out), progress_(progress) {}

  Comparison run() {
    Comparison at_level = compare();
    if (!has_ties_ || is_alike(at_level) || progress_.cancelled()) return at_level;
    const VoxelNodes asked = nodes_;
    const std::vector<NodeNumber> inside = tied_nodes_in_mesh();
    std::vector<Comparison> tried;
    for (const int way : {1, -1}) {  // saddles at the level: between parts outside, or between parts inside
      nodes_ = asked;
      nodes_.break_ties(inside, way);
      tried.push_back(compare());
      tell_ties(tried.back());
      if (is_alike(tried.back()) || progress_.cancelled()) return tried.back();
    }
    nodes_ = asked;
    nodes_.break_ties(inside, 1);
    return tried.front();
  }

 private:
  Comparison compare() {
    Comparison out;
    FieldParts parts = field_parts(nodes_, progress_);
    if (progress_.cancelled()) return out;
    has_ties_ = parts.nodes_at_level > 0 || parts.has_tied_saddles || !parts.is_known;
    if (allowed_.any() && shell_.is_closed) {
      out.left_out = find_left_out(rays_, nodes_, parts, allowed_);
      if (!out.left_out.list.empty()) take_rest(out.left_out, parts);
    }
    out.matching = match_parts(mesh_, shell_, rays_, nodes_, parts, out.findings);
    note_doubts(parts, out.findings);
    return out;
  }

  static void take_rest(const LeftOut& left_out, FieldParts& parts) {
    std::vector<std::uint32_t> part_of = std::move(parts.part_of);
    for (std::uint32_t& part : part_of) {
      if (part != FieldPart::kNoPart) part = left_out.part_in_rest[part];
    }
    parts = left_out.rest;
    parts.part_of = std::move(part_of);
  }

  static bool is_alike(const Comparison& found) {
    return found.findings.empty() || (found.findings.size() == 1 && found.findings[0].is_found);
  }

  Point world(const Cell& node) const {
    return nodes_.frame().to_world({double(node[0]), double(node[1]), double(node[2])});
  }

  /// What keeps the field's topology from being known.
  void note_doubts(const FieldParts& parts, std::vector<VerifyFinding>& to) const {
    FindingList findings(to);
    if (parts.loose_nodes > 0) {
      findings.add_undecided("level.tie",
                             std::to_string(parts.loose_nodes) +
                                 " voxels are at the level itself without voxels of both sides beside them",
                             world(parts.loose_node), false);
    }
    if (!parts.is_known) {
      findings.add_undecided("level.saddle",
                             "a saddle of the field is at the level itself, so that its topology is not known", Point{},
                             false);
    }
  }

  /// The nodes at the level that the mesh covers. Those without a neighbour inside, of 26, are left outside: they are
  /// of the background's plateau, or of one within what is outside.
  std::vector<NodeNumber> tied_nodes_in_mesh() {
    const auto& size = nodes_.size();
    tied_ = 0;
    std::vector<NodeNumber> near;
    for (int k = 0; k < size[2]; ++k) {
      for (int j = 0; j < size[1]; ++j) {
        for (int i = 0; i < size[0]; ++i) {
          if (nodes_.sign(i, j, k) != 0) continue;
          if (tied_++ == 0) first_tied_ = {i, j, k};
          if (has_inside_neighbour(i, j, k)) near.push_back(nodes_.number(i, j, k));
        }
      }
    }
    return parallel_collect<NodeNumber>(near.size(), 64, [&](std::size_t begin, std::size_t end, auto& out) {
      std::vector<BoundaryRays::Hit> hits;
      for (std::size_t n = begin; n < end; ++n) {
        bool has_moved = false;
        if (rays_.coverage(world(nodes_.node(near[n])), hits, has_moved) == 1) out.push_back(near[n]);
      }
    });
  }

  bool has_inside_neighbour(int i, int j, int k) const {
    for (int n = 0; n < 27; ++n) {
      if (nodes_.sign(i + n % 3 - 1, j + n / 3 % 3 - 1, k + n / 9 - 1) > 0) return true;
    }
    return false;
  }

  void tell_ties(Comparison& found) const {
    const std::string what =
        tied_ == 0 ? "saddles of the field are at the level itself: what is said is of a level"
                   : std::to_string(tied_) +
                         " voxels are at the level itself: what is said is of a scan in which they are on the side "
                         "where the mesh has them,";
    FindingList findings(found.findings);
    findings.add_found("level.tie", what + " no farther than " + number_text(nodes_.tie_shift(), 2) + " from it",
                       world(first_tied_));
  }

  const TetMesh& mesh_;
  const Shell& shell_;
  const BoundaryRays& rays_;
  VoxelNodes& nodes_;
  const MayBeLeftOut& allowed_;
  const Progress& progress_;
  bool has_ties_ = false;  // of the last comparison
  std::size_t tied_ = 0;   // nodes at the level
  Cell first_tied_{};
};

}  // namespace

Comparison compare_parts(const TetMesh& mesh, const Shell& shell, const BoundaryRays& rays, VoxelNodes& nodes,
                         const MayBeLeftOut& may_be_left_out, const Progress& progress) {
  return Comparer(mesh, shell, rays, nodes, may_be_left_out, progress).run();
}

}  // namespace scantet::verify
