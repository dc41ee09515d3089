// A component of the mesh holds the nodes in its tets. Nodes that are neighbours along an axis must be in one, and
// nodes that touch and are of one part of the grid; nodes of parts that do not even touch must not (grid_parts.h).
#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "scantet/base/neighbors.h"
#include "scantet/check/broken_ways_impl.h"
#include "scantet/check/grid_nodes_impl.h"
#include "scantet/check/joined_near_impl.h"
#include "scantet/check/lost_cavities_impl.h"

namespace scantet::auditing {
namespace {

/// Parts of `grid` by the sets of its runs, each with its first node.
std::vector<GridPart> parts_by(const std::vector<std::uint32_t>& sets, const RegionGrid& grid) {
  std::vector<GridPart> parts;
  for (std::size_t n = 0; n < sets.size(); ++n) {
    const GridRun& run = grid.runs[n];
    if (sets[n] == parts.size()) parts.push_back({grid.parts[run.part].region, 0, {run.begin, run.j, run.k}});
    parts[sets[n]].nodes += static_cast<std::uint64_t>(run.end - run.begin);
  }
  return parts;
}

/// Of parts of fewer nodes the facets that pass by what is round leave less than half.
constexpr std::uint64_t kLeastShown = 27;

class RegionCheck {
 public:
  RegionCheck(const TetMesh& mesh, const RegionGrid& grid, AuditReport& report)
      : mesh_(mesh), grid_(grid), report_(report), parts_(find_parts(grid)), nodes_(mesh, grid, parts_) {
    ledger_.regions.emplace_back();
    for (const GridRegion& region : grid.regions) ledger_.regions.push_back({region, 0, 0, {}});
  }

  void run(const FaceMatch& match, const std::vector<std::uint32_t>& component_of, const OutsideSurfaces& outside) {
    const Meetings meetings = nodes_.find(match, component_of);
    find_lost_parts();
    find_joined_parts(meetings);
    find_split_parts(meetings, component_of);
    const MeshCavities cavities(mesh_, match, outside, grid_.frame, report_);
    find_lost_cavities(cavities, nodes_, grid_, ledger_.regions.front(), report_);
    find_broken_ways(match);
    report_.region_ledger = std::move(ledger_);
  }

 private:
  void find_lost_parts() {
    const std::vector<GridPart> pieces = parts_by(parts_.pieces, grid_);
    std::vector<std::uint64_t> kept(pieces.size());
    for (const GridPart& piece : pieces) ++entry(piece.region).parts;
    for (std::size_t n = 0; n < grid_.runs.size(); ++n) {
      const GridRun& run = grid_.runs[n];
      kept[parts_.pieces[n]] += count_nodes(nodes_, grid_, run, entry(grid_.parts[run.part].region));
    }
    Tally lost("audit.lost_label");
    for (std::size_t n = 0; n < kept.size(); ++n) {
      if (kept[n] > 0) continue;
      ledger_.lost.push_back(pieces[n]);
      lost.hit(place_of(pieces[n]), [&] { return text_of(pieces[n]); });
    }
    record(lost, report_);
    for (std::size_t n = 0; n < grid_.runs.size(); ++n) {
      if (kept[parts_.pieces[n]] == 0) lost_sets_.insert(parts_.joined[n]);
    }
    find_shrunk_parts(pieces, kept);
  }

  /// kept: nodes of each piece that lie in tets of its region.
  void find_shrunk_parts(const std::vector<GridPart>& pieces, const std::vector<std::uint64_t>& kept) {
    std::map<std::uint32_t, std::vector<std::size_t>> missed;  // nodes, by piece
    for (std::size_t n = 0; n < grid_.runs.size(); ++n) {
      const GridRun& run = grid_.runs[n];
      const std::uint32_t piece = parts_.pieces[n];
      if (pieces[piece].nodes < kLeastShown && kept[piece] > 0) continue;
      if (2 * kept[piece] >= pieces[piece].nodes) continue;
      for (int i = run.begin; i < run.end; ++i) {
        const std::size_t node = node_of({i, run.j, run.k});
        if (!is_kept(node)) missed[piece].push_back(node);
      }
    }
    Tally shrunk("audit.shrunk_label");
    for (const auto& [piece, nodes] : missed) {
      for (const std::size_t node : nodes) ledger_.missed.push_back(place_of(node));
      if (pieces[piece].nodes >= kLeastShown) add_ways_between(nodes);
      if (kept[piece] == 0) continue;
      shrunk.hit(place_of(nodes[nodes.size() / 2]), [&, piece = piece] {
        return std::to_string(kept[piece]) + " of " + text_of(pieces[piece]) + " kept";
      });
    }
    record(shrunk, report_);
  }

  /// Along axes, from these nodes, none of them kept, to those that are joined to them.
  void add_ways_between(const std::vector<std::size_t>& nodes) {
    for (const std::size_t node : nodes) {
      any_joined(node, [&](std::size_t beside) {
        const bool is_theirs = beside < node && !is_kept(beside);  // it has the way already
        if (!is_theirs) ledger_.broken.push_back({nodes_.region_of(node), {place_of(node), place_of(beside)}});
        return false;
      });
    }
  }

  /// Components of the mesh with nodes of parts that do not touch.
  void find_joined_parts(const Meetings& meetings) {
    touching_of_ = of_joined_sets(parts_.touching);
    std::vector<std::set<std::uint32_t>> held(report_.components.size());
    const std::vector<GridPart> parts = parts_by(parts_.touching, grid_);
    Tally joined("audit.joined_label");
    for (const auto& [key, meeting] : meetings.all()) {
      std::set<std::uint32_t>& of_component = held[key.second];
      const std::uint32_t part = touching_of_[key.first];
      if (!of_component.insert(part).second || of_component.size() == 1) continue;
      const std::uint32_t other = part == *of_component.begin() ? *of_component.rbegin() : *of_component.begin();
      joined.hit(joined_at(part, of_component).value_or(place_of(meeting.first_node)),
                 [&] { return text_of(parts[part]) + ", with " + text_of(parts[other]); });
    }
    record(joined, report_);
  }

  /// A place between nodes of a part and of one of the others, from which only one node parts it: if there is one,
  /// where that one is lost.
  std::optional<Point> joined_at(std::uint32_t part, const std::set<std::uint32_t>& others) const {
    std::optional<Point> first;
    for (std::size_t n = 0; n < grid_.runs.size(); ++n) {
      if (parts_.touching[n] != part) continue;
      const GridRun& run = grid_.runs[n];
      for (int i = run.begin; i < run.end; ++i) {
        for (const NeighborOffset& offset : kNeighborhood) {
          const std::array<int, 3> between{i + offset[0], run.j + offset[1], run.k + offset[2]};
          const std::array<int, 3> beyond{i + 2 * offset[0], run.j + 2 * offset[1], run.k + 2 * offset[2]};
          if (!in_grid(beyond)) continue;
          const std::uint32_t set = nodes_.set_of(node_of(beyond));
          if (set == kNone || touching_of_[set] == part || others.count(touching_of_[set]) == 0) continue;
          const Point place = place_of(node_of(between));
          if (!nodes_.is_kept(between[0], between[1], between[2], nodes_.region_of(node_of(between)))) return place;
          if (!first) first = place;
        }
      }
    }
    return first;
  }

  /// Nodes that are neighbours along axes, in several components of the mesh: all but the one with the most of a set
  /// are torn off it.
  void find_split_parts(const Meetings& meetings, const std::vector<std::uint32_t>& component_of) {
    const std::vector<GridPart> parts = parts_by(parts_.joined, grid_);
    std::map<std::uint32_t, Meetings::Key> largest;  // by set
    for (const auto& [key, meeting] : meetings.all()) {
      const auto [kept, is_first] = largest.try_emplace(key.first, key);
      if (!is_first && meetings.all().at(kept->second).nodes < meeting.nodes) kept->second = key;
    }
    std::set<Meetings::Key> torn;
    for (const auto& [key, meeting] : meetings.all()) {
      if (largest.at(key.first) != key) torn.insert(key);
    }
    Tally split("audit.split_label");
    for (const auto& [key, nodes] : nodes_.nodes_of(torn, component_of)) {
      const GridPart& part = parts[key.first];
      const std::size_t torn_nodes = nodes.size();
      for (const std::size_t node : nodes) torn_.emplace_hint(torn_.end(), node, key.second);
      split.hit(torn_at(nodes), [&] {
        return std::to_string(torn_nodes) + " of " + counted_voxels(part.nodes) + " of " +
               region_name(mesh_, part.region);
      });
    }
    if (!grid_.is_cut) find_parted_pieces(meetings, largest, split);  // a plane may have taken what joins a part
    record(split, report_);
  }

  /// Sets of joined nodes that the grid has in one part, as they touch, in several components of the mesh: all but
  /// those in the one with the most nodes are torn off. largest: the component with the most of each set.
  void find_parted_pieces(const Meetings& meetings, const std::map<std::uint32_t, Meetings::Key>& largest,
                          Tally& split) {
    const std::vector<std::uint32_t> piece_of = of_joined_sets(parts_.pieces);
    std::map<std::uint32_t, std::map<std::uint32_t, std::uint64_t>> held;  // nodes, by piece and component
    for (const auto& [set, key] : largest) held[piece_of[set]][key.second] += meetings.all().at(key).nodes;
    std::set<std::uint32_t> loose;  // sets; also lost ones, which others may hang together by
    for (std::uint32_t set = 0; set < piece_of.size(); ++set) {
      const auto by_component = held.find(piece_of[set]);
      if (by_component == held.end() || by_component->second.size() < 2) continue;
      const auto most = std::max_element(by_component->second.begin(), by_component->second.end(),
                                         [](const auto& a, const auto& b) { return a.second < b.second; });
      const auto own = largest.find(set);
      if (own == largest.end() || own->second.second != most->first) loose.insert(set);
    }
    if (loose.empty()) return;
    const std::map<std::uint32_t, Point> places = add_contacts(loose, piece_of);
    const std::vector<GridPart> sets = parts_by(parts_.joined, grid_);
    for (const std::uint32_t set : loose) {
      const auto place = places.find(set);
      if (!largest.contains(set) || place == places.end()) continue;
      split.hit(place->second, [&] { return text_of(sets[set]) + ", which touch others by edges or corners"; });
    }
  }

  /// For each set of joined nodes the larger set that it is in. sets: of the runs, each of whole sets of joined nodes.
  std::vector<std::uint32_t> of_joined_sets(const std::vector<std::uint32_t>& sets) const {
    std::vector<std::uint32_t> of;
    for (std::size_t n = 0; n < grid_.runs.size(); ++n) {
      if (parts_.joined[n] == of.size()) of.push_back(sets[n]);
    }
    return of;
  }

  /// Lists where nodes of these sets touch others of their pieces, each once. Return: the middle of the first of each
  /// set.
  std::map<std::uint32_t, Point> add_contacts(const std::set<std::uint32_t>& loose,
                                              const std::vector<std::uint32_t>& piece_of) {
    std::map<std::uint32_t, Point> first;
    for (std::size_t n = 0; n < grid_.runs.size(); ++n) {
      const std::uint32_t set = parts_.joined[n];
      if (!loose.contains(set)) continue;
      const GridRun& run = grid_.runs[n];
      for (int i = run.begin; i < run.end; ++i) {
        for (const NeighborOffset& offset : kNeighborhood) {
          const std::array<int, 3> there{i + offset[0], run.j + offset[1], run.k + offset[2]};
          if (!in_grid(there)) continue;
          const std::uint32_t other = nodes_.set_of(node_of(there));
          if (other == kNone || other == set || piece_of[other] != piece_of[set]) continue;
          const Point a = world_place(grid_, {i, run.j, run.k});
          const Point b = world_place(grid_, there);
          first.try_emplace(set, a + 0.5 * (b - a));
          const bool is_theirs = loose.contains(other) && node_of(there) < node_of({i, run.j, run.k});
          if (!is_theirs) ledger_.contacts.push_back({grid_.parts[run.part].region, {a, b}});
        }
      }
    }
    return first;
  }

  /// Handles and walls of regions that the mesh has not, and where it tears regions apart.
  void find_broken_ways(const FaceMatch& match) {
    Tally broken("audit.broken_label");
    const LinesBeside lines(mesh_, match, grid_.frame);
    for (const std::vector<GridCell>& group : collapsed(broken_cells(mesh_, match, grid_, nodes_))) {
      const BrokenWays found = ways_of(group);
      const bool are_torn = found.components.size() > 1;  // lines beside may meet at a vertex
      if (!are_torn && is_only_beside(group, found, lines)) continue;
      if (found.components.size() == 1 || found.ways.empty()) {
        broken.hit(center_of(group[group.size() / 2]), [&] { return "in " + region_name(mesh_, found.region); });
      }
      // Else nothing joins them to what is kept: they touch others by edges and corners of voxels, or are a cavity.
      if (found.components.empty() && !found.are_of_lost_part) continue;
      ledger_.broken.insert(ledger_.broken.end(), found.ways.begin(), found.ways.end());
    }
    record(broken, report_);
  }

  /// The edges and nodes of a group of cells.
  struct BrokenWays {
    Region region = kOutside;
    std::vector<NarrowWay> ways{};
    std::set<std::uint32_t> components{};  ///< of the mesh, at their ends; kNone: the one with the most of the region
    std::vector<Point> kept_ends{};
    bool are_of_lost_part = false;
  };

  /// Whether the mesh has what the ways join, but beside them, as facets of bars are about as wide as these are thick.
  static bool is_only_beside(const std::vector<GridCell>& group, const BrokenWays& found, const LinesBeside& lines) {
    const bool is_bar = std::none_of(group.begin(), group.end(), [](const GridCell& c) { return c.dimension() > 1; });
    return is_bar && found.kept_ends.size() > 1 && lines.join(found.ways, found.kept_ends);
  }

  BrokenWays ways_of(const std::vector<GridCell>& group) const {
    BrokenWays found;
    for (const GridCell& cell : group) {
      const std::array<int, 3> first{cell.first(0), cell.first(1), cell.first(2)};
      const std::array<int, 3> last{cell.last(0), cell.last(1), cell.last(2)};
      if (cell.dimension() > 1 || !in_grid(first) || !in_grid(last)) continue;
      found.region = nodes_.region_of(node_of(first));
      found.are_of_lost_part = lost_sets_.contains(nodes_.set_of(node_of(first)));
      found.ways.push_back({found.region, {place_of(node_of(first)), place_of(node_of(last))}});
      for (const std::size_t node : {node_of(first), node_of(last)}) {
        if (!is_kept(node)) continue;
        found.kept_ends.push_back(place_of(node));
        const auto torn = torn_.find(node);
        found.components.insert(torn == torn_.end() ? kNone : torn->second);
      }
    }
    return found;
  }

  Point center_of(const GridCell& cell) const { return grid_.frame.to_world(cell.middle()); }

  /// Of ways from node to node.
  struct Step {
    std::size_t node;
    std::size_t before;  ///< the step to it, by number; its own for the first of a way
  };

  /// Of the way that the last step ends.
  Point middle_of(const std::vector<Step>& ways) const {
    std::vector<std::size_t> way{ways.size() - 1};
    while (ways[way.back()].before != way.back()) way.push_back(ways[way.back()].before);
    const Point a = place_of(ways[way[(way.size() - 1) / 2]].node);
    const Point b = place_of(ways[way[way.size() / 2]].node);
    return a + 0.5 * (b - a);
  }

  /// Whether visit(beside) is true for a node that is joined to this one along an axis; none is visited after that.
  template <class Visit>
  bool any_joined(std::size_t node, const Visit& visit) const {
    const std::array<std::size_t, 3> steps{1, extent(0), extent(0) * extent(1)};
    const std::array<int, 3> at = index_of(node);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const bool up : {false, true}) {
        if (at[axis] == (up ? grid_.size[axis] - 1 : 0)) continue;
        const std::size_t beside = up ? node + steps[axis] : node - steps[axis];
        if (nodes_.set_of(beside) == nodes_.set_of(node) && visit(beside)) return true;
      }
    }
    return false;
  }

  /// The middle of a shortest way along axes, through lost nodes, from these, ascending, which are joined and which one
  /// component of the mesh holds, to one that another holds.
  Point torn_at(const std::vector<std::size_t>& nodes) const {
    std::vector<Step> ways;
    ways.reserve(nodes.size());
    std::set<std::size_t> seen(nodes.begin(), nodes.end());
    for (const std::size_t node : nodes) ways.push_back({node, ways.size()});
    for (std::size_t n = 0; n < ways.size(); ++n) {
      const bool is_there = any_joined(ways[n].node, [&](std::size_t beside) {
        if (!seen.insert(beside).second) return false;
        ways.push_back({beside, n});
        return is_kept(beside);
      });
      if (is_there) return middle_of(ways);
    }
    return place_of(nodes.front());
  }

  KeptRegion& entry(Region region) {
    return *std::lower_bound(ledger_.regions.begin(), ledger_.regions.end(), region,
                             [](const KeptRegion& kept, Region wanted) { return kept.grid.region < wanted; });
  }

  std::string text_of(const GridPart& part) const {
    return counted_voxels(part.nodes) + " of " + region_name(mesh_, part.region);
  }
  Point place_of(const GridPart& part) const { return world_place(grid_, part.node); }
  Point place_of(std::size_t node) const { return world_place(grid_, index_of(node)); }

  bool is_kept(std::size_t node) const {
    const auto [i, j, k] = index_of(node);
    return nodes_.is_kept(i, j, k, nodes_.region_of(node));
  }
  bool in_grid(const std::array<int, 3>& node) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (node[axis] < 0 || node[axis] >= grid_.size[axis]) return false;
    }
    return true;
  }
  std::array<int, 3> index_of(std::size_t node) const {
    const std::size_t line = node / extent(0);
    return {static_cast<int>(node % extent(0)), static_cast<int>(line % extent(1)), static_cast<int>(line / extent(1))};
  }
  std::size_t node_of(const std::array<int, 3>& node) const {
    const auto at = [&](std::size_t axis) { return static_cast<std::size_t>(node[axis]); };
    return (at(2) * extent(1) + at(1)) * extent(0) + at(0);
  }
  std::size_t extent(std::size_t axis) const { return static_cast<std::size_t>(grid_.size[axis]); }

  const TetMesh& mesh_;
  const RegionGrid& grid_;
  AuditReport& report_;
  GridParts parts_;
  GridNodes nodes_;
  RegionLedger ledger_;
  std::set<std::uint32_t> lost_sets_;          // of joined nodes, in lost parts
  std::map<std::size_t, std::uint32_t> torn_;  // nodes that are torn off their set, and the component that has them
  std::vector<std::uint32_t> touching_of_;     // of sets of joined nodes: the set of those that touch
};

}  // namespace

void check_regions(const TetMesh& mesh, const FaceMatch& match, const std::vector<std::uint32_t>& component_of,
                   const OutsideSurfaces& outside, const RegionGrid& grid, AuditReport& report) {
  RegionCheck(mesh, grid, report).run(match, component_of, outside);
}

}  // namespace scantet::auditing
