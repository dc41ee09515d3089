#include "scantet/verify/comparison.h"

#include <algorithm>
#include <string>
#include <utility>

#include "scantet/base/options.h"
#include "scantet/base/parallel.h"
#include "scantet/verify/findings.h"

namespace scantet::verify {
namespace {

/// The nodes at the level, ascending.
struct TiedNodes {
  std::vector<NodeNumber> all;
  std::vector<NodeNumber> in_mesh;  // those that the mesh covers, if a neighbour, of 26, is inside
};

/// How many parts a side of the level has, whichever way ties are broken.
struct PartRange {
  std::int64_t least = 0;
  std::int64_t most = 0;
  bool holds(std::int64_t count) const { return least <= count && count <= most; }
};

/// wide: parts of the field in which all ties are on that side; narrow: in which none is. Whatever the way, what is on
/// the side lies between the two. So a part of the wide field that holds a node of the narrow one holds a part for
/// every way. No two parts hold nodes of one part of the narrow field; and a part without any has a node of the wide
/// field alone with none of the narrow one beside it, as the edge between two nodes of a side is on that side.
PartRange parts_of_any_way(const FieldParts& wide, const FieldParts& narrow, int side, const Cell& size) {
  PartRange range;
  const auto row = static_cast<std::size_t>(size[0]) + 2;
  const auto layer = row * (static_cast<std::size_t>(size[1]) + 2);
  const auto has = [side](const FieldParts& parts, std::size_t n) {
    return parts.part_of[n] != FieldPart::kNoPart && parts.parts[parts.part_of[n]].side == side;
  };
  std::vector<std::uint8_t> is_sure(wide.parts.size(), 0);
  std::size_t n = 0;
  for (int k = -1; k <= size[2]; ++k) {
    for (int j = -1; j <= size[1]; ++j) {
      for (int i = -1; i <= size[0]; ++i, ++n) {
        if (!has(wide, n)) continue;
        if (has(narrow, n)) {
          is_sure[wide.part_of[n]] = 1;
          continue;
        }
        const bool is_around = i < 0 || j < 0 || k < 0 || i == size[0] || j == size[1] || k == size[2];
        range.most += is_around || !(has(narrow, n - 1) || has(narrow, n + 1) || has(narrow, n - row) ||
                                     has(narrow, n + row) || has(narrow, n - layer) || has(narrow, n + layer));
      }
    }
  }
  range.least = std::count(is_sure.begin(), is_sure.end(), 1);
  range.most += side > 0 ? narrow.inside : narrow.outside;
  return range;
}

class Comparer {
 public:
  Comparer(const TetMesh& mesh, const Shell& shell, const BoundaryRays& rays, VoxelNodes& nodes,
           const MayBeLeftOut& may_be_left_out, const Progress& progress)
      : mesh_(mesh), shell_(shell), rays_(rays), nodes_(nodes), allowed_(may_be_left_out), progress_(progress) {}

  Comparison run() {
    Comparison at_level = compare();
    if (!has_ties_ || is_alike(at_level) || progress_.cancelled()) return at_level;
    const VoxelNodes asked = nodes_;
    const TiedNodes tied = tied_nodes();
    std::vector<Comparison> tried;
    for (const int way : {1, -1}) {  // saddles at the level: between parts outside, or between parts inside
      nodes_ = asked;
      nodes_.break_ties(tied.in_mesh, way);
      tried.push_back(compare());
      tell_ties(tried.back(), tied);
      if (is_alike(tried.back()) || progress_.cancelled()) return tried.back();
    }
    nodes_ = asked;
    keep_what_any_way_shows(tried.front(), tied.all);
    nodes_ = asked;
    nodes_.break_ties(tied.in_mesh, 1);
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

  /// Nodes without a neighbour inside are left outside: they are of the background's plateau, or of one within what is
  /// outside.
  TiedNodes tied_nodes() const {
    const auto& size = nodes_.size();
    TiedNodes out;
    std::vector<NodeNumber> near;
    for (int k = 0; k < size[2]; ++k) {
      for (int j = 0; j < size[1]; ++j) {
        for (int i = 0; i < size[0]; ++i) {
          if (nodes_.sign(i, j, k) != 0) continue;
          out.all.push_back(nodes_.number(i, j, k));
          if (has_inside_neighbour(i, j, k)) near.push_back(out.all.back());
        }
      }
    }
    out.in_mesh = parallel_collect<NodeNumber>(near.size(), 64, [&](std::size_t begin, std::size_t end, auto& in_mesh) {
      std::vector<BoundaryRays::Hit> hits;
      for (std::size_t n = begin; n < end; ++n) {
        bool has_moved = false;
        if (rays_.coverage(world(nodes_.node(near[n])), hits, has_moved) == 1) in_mesh.push_back(near[n]);
      }
    });
    return out;
  }

  bool has_inside_neighbour(int i, int j, int k) const {
    for (int n = 0; n < 27; ++n) {
      if (nodes_.sign(i + n % 3 - 1, j + n / 3 % 3 - 1, k + n / 9 - 1) > 0) return true;
    }
    return false;
  }

  void tell_ties(Comparison& found, const TiedNodes& tied) const {
    const std::string what =
        tied.all.empty() ? "saddles of the field are at the level itself: what is said is of a level"
                         : std::to_string(tied.all.size()) +
                               " voxels are at the level itself: what is said is of a scan in which they are on the "
                               "side where the mesh has them,";
    FindingList findings(found.findings);
    findings.add_found("level.tie", what + " no farther than " + number_text(nodes_.tie_shift(), 2) + " from it",
                       tied.all.empty() ? Point{} : world(nodes_.node(tied.all.front())));
  }

  /// What differs is wrong only if it does whichever way ties are broken; else it is not decided. nodes_: as asked.
  void keep_what_any_way_shows(Comparison& told, const std::vector<NodeNumber>& tied) {
    for (VerifyFinding& finding : told.findings) {
      if (!finding.is_wrong) continue;
      finding.is_wrong = finding.bounded = false;
      finding.what += ", unless ties are broken in another way";
    }
    const VoxelNodes asked = nodes_;
    nodes_.break_ties({}, 1);
    const FieldParts least_inside = field_parts(nodes_, progress_);
    nodes_ = asked;
    nodes_.break_ties(tied, -1);
    const FieldParts most_inside = field_parts(nodes_, progress_);
    if (progress_.cancelled() || !least_inside.is_known || !most_inside.is_known) return;
    PartRange components = parts_of_any_way(most_inside, least_inside, 1, nodes_.size());
    PartRange surrounds = parts_of_any_way(least_inside, most_inside, -1, nodes_.size());
    if (allowed_.any()) components.least = surrounds.least = 1;  // the mesh may lack parts
    const VerifiedInvariants& mesh = told.matching.mesh;
    if (components.holds(mesh.components) && surrounds.holds(mesh.cavities + 1)) return;
    const auto counts = std::find_if(told.findings.begin(), told.findings.end(),
                                     [](const VerifyFinding& finding) { return finding.code == "topology.counts"; });
    if (counts == told.findings.end()) return;
    counts->is_wrong = true;
    counts->what = "the mesh has " + std::to_string(mesh.components) + " components and " +
                   std::to_string(mesh.cavities) + " cavities; whichever way ties are broken, the scan has " +
                   std::to_string(components.least) + " to " + std::to_string(components.most) + " and " +
                   std::to_string(surrounds.least - 1) + " to " + std::to_string(surrounds.most - 1);
  }

  const TetMesh& mesh_;
  const Shell& shell_;
  const BoundaryRays& rays_;
  VoxelNodes& nodes_;
  const MayBeLeftOut& allowed_;
  const Progress& progress_;
  bool has_ties_ = false;  // of the last comparison
};

}  // namespace

Comparison compare_parts(const TetMesh& mesh, const Shell& shell, const BoundaryRays& rays, VoxelNodes& nodes,
                         const MayBeLeftOut& may_be_left_out, const Progress& progress) {
  return Comparer(mesh, shell, rays, nodes, may_be_left_out, progress).run();
}

}  // namespace scantet::verify
