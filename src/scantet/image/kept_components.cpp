// For each level, the nodes of the dropped components are lowered, in a copy of the scan, to a value v on the outside
// of the level. That settles signs and topology. Where a kept and a dropped component share a cell, the heights as they
// were read are kept beside the copy (shared_cells.cpp), so v itself is never seen. Nothing of the dropped components
// is left: the field falls everywhere, so what is inside now was inside before; and each of its components holds a node
// (see level_topology.cpp), which can only be a node of a kept component. Nodes dropped at one level are dropped at all
// levels within it: the components of these lie wholly within one of that level.
//
// Nor does a kept component K come apart, for the copy is asked again at further levels. The nodes of K stay as they
// are, and so do the edges of the grid that join them. So do the faces that join them: a dropped corner of such a face
// would be joined to K along an edge. What remains is two parts of K that only the body of a cell joins, with a dropped
// corner in that cell. Then there are three sets of corners that no edge joins. These are single corners, three or four
// of them, of which no two share an edge and any two share a face. One corner p of K is joined to no other corner by a
// face. Let q be any other of these corners, and slice the cell parallel to the face of p and q, up to the opposite
// face, which has the corners r and s. From slice to slice the heights at the edges that start at p and q fall linearly
// through zero, and the heights at the edges that end at r and s rise through it (one of these may stay below). As no
// face joins p to r or s, the height at p's edge gets to zero no later than theirs get above it. Were q joined to both
// r and s by faces, K would have all three of them or none, but it has some and not others. So pair q with one of r and
// s that it is not joined to, and p with the other: of each pair, the one inside loses at least as large a share of its
// height. So the product of the two heights inside never exceeds that of the two outside, as it does not on the face of
// p and q: no slice joins p to q, whichever corner q is. So p is alone in the cell, and nothing of K was joined there
// but by faces.
//
// Then cavities are filled: their nodes are raised to a value inside of the level. That is the same turned upside down,
// once what was left out counts as outside. Regions stay inside each other: a cavity of one level lies in a cavity of
// the next within it, which is larger, so where the latter is filled so is the former.
#include "scantet/image/kept_components.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "scantet/base/error.h"
#include "scantet/base/neighbors.h"
#include "scantet/base/options.h"
#include "scantet/topology/level_topology.h"

namespace scantet {
namespace {

constexpr double kNudge = 1e-3;  // of the range of the values: how far off the level, where voxels are no whole numbers
constexpr int kDigits = 6;

/// A value below the level, or above it, but no further off than some voxel is; the level itself if that is the least
/// value, or the largest.
template <class Voxel>
Voxel voxel_beside(const Scan& scan, double level, bool below) {
  const double farthest = below ? scan.min_value : scan.max_value;
  double wanted = 0;
  if constexpr (std::is_integral_v<Voxel>) {
    wanted = below ? std::ceil(level) - 1 : std::floor(level) + 1;
  } else {
    wanted = level + (below ? -kNudge : kNudge) * (scan.max_value - scan.min_value);
  }
  const bool in_range = below ? wanted > farthest : wanted < farthest;
  const auto voxel = static_cast<Voxel>(in_range ? wanted : farthest);
  const auto rounded = static_cast<double>(voxel);
  return (below ? rounded < level : rounded > level) ? voxel : static_cast<Voxel>(farthest);
}

/// The nodes begin ≤ i < end of a row.
struct NodeRun {
  int begin;
  int end;
  int j;
  int k;
};

/// A copy of the scan in which those of the nodes that are on the other side of the level are turned inside, or
/// outside; the scan itself if there are none.
Scan turned(const Scan& scan, const LevelSetSettings& level, const std::vector<NodeRun>& nodes, bool to_inside) {
  Scan copy = scan;
  std::visit(
      [&]<class Voxel>(const Voxel* voxels) {
        const auto offset = [&](const NodeRun& run) {
          return (std::int64_t{run.k} * scan.size[1] + run.j) * scan.size[0] + run.begin;
        };
        const bool above = level.inside == InsideSide::above;
        const auto is_to_turn = [&](Voxel value) {
          const auto v = static_cast<double>(value);
          return (above ? v > level.level : v < level.level) != to_inside;
        };
        if (std::none_of(nodes.begin(), nodes.end(), [&](const NodeRun& run) {
              const Voxel* first = voxels + offset(run);
              return std::any_of(first, first + (run.end - run.begin), is_to_turn);
            })) {
          return;
        }
        const auto values = std::make_shared<std::vector<Voxel>>(voxels, voxels + scan.voxel_count());
        const auto turned_to = voxel_beside<Voxel>(scan, level.level, above != to_inside);
        for (const NodeRun& run : nodes) {
          const auto first = values->begin() + offset(run);
          std::replace_if(first, first + (run.end - run.begin), is_to_turn, turned_to);
        }
        copy.voxels = values->data();
        copy.owner = values;
      },
      scan.voxels);
  return copy;
}

/// Nodes at the level beside the runs that have nothing below the level around them any more: points, lines and walls
/// without width, which filling leaves where it leaves nothing else.
std::vector<NodeRun> bare_nodes(const HeightGrid& heights, const std::vector<NodeRun>& runs) {
  const auto around = [](int i, int j, int k, const auto& visit) {
    return std::all_of(kNeighborhood.begin(), kNeighborhood.end(),
                       [&](const NeighborOffset& step) { return visit(i + step[0], j + step[1], k + step[2]); });
  };
  const auto is_image = [&](int i, int j, int k) {
    return std::min({i, j, k}) >= 0 && i < heights.size()[0] && j < heights.size()[1] && k < heights.size()[2];
  };
  std::vector<NodeRun> bare;
  for (const NodeRun& run : runs) {
    for (int i = run.begin; i < run.end; ++i) {
      around(i, run.j, run.k, [&](int x, int y, int z) {
        if (is_image(x, y, z) && heights.height(x, y, z) == 0 &&
            around(x, y, z, [&](int u, int v, int w) { return heights.height(u, v, w) >= 0; })) {
          bare.push_back({x, x + 1, y, z});
        }
        return true;
      });
    }
  }
  return bare;
}

/// How many of the components are kept. components: largest first.
std::size_t count_kept(const std::vector<Component>& components, const ComponentChoice& choice) {
  const auto small = std::find_if(components.begin(), components.end(),
                                  [&](const Component& c) { return c.volume_mm3 < choice.min_volume_mm3; });
  const auto kept = static_cast<std::size_t>(small - components.begin());
  return choice.count ? static_cast<std::size_t>(std::min<std::uint64_t>(kept, *choice.count)) : kept;
}

[[noreturn]] void refuse_to_drop_all(const std::vector<Component>& components, const ComponentChoice& choice,
                                     const std::string& where) {
  const std::string all = components.size() == 1
                              ? "the only component"
                              : "the largest of the " + std::to_string(components.size()) + " components";
  throw Error(Fault::input, "input.components",
              "--min-component " + number_text(choice.min_volume_mm3) + ": nothing is left" + where + ", for " + all +
                  " has " + number_text(components.front().volume_mm3, kDigits) + " mm^3",
              "choose a smaller --min-component; scantet info lists the largest volumes");
}

[[noreturn]] void refuse_empty_level(double level, const DroppedComponents& dropped) {
  throw Error(Fault::input, "input.components",
              "level " + number_text(level) + ": nothing of it is in what is left of the " +
                  std::to_string(dropped.found) + " components",
              "keep more with --components or --min-component, or leave out the level");
}

/// Chooses what is kept, level by level.
class Choosing {
 public:
  Choosing(const Scan& scan, const NestedLevelSettings& settings, const ComponentChoice& choice)
      : scan_(scan), settings_(settings), choice_(choice) {}

  /// Takes the next level. Returns false if cancelled.
  bool take_level(double level, const Progress& progress);
  KeptComponents take();

 private:
  void drop(const LevelSetSettings& here, const LevelTopology& topology, MaskedScan& masked);
  void fill(const LevelSetSettings& here, const LevelTopology& topology, MaskedScan& masked);
  /// Whether the masked scan differs from the one that was read.
  bool is_changed(const MaskedScan& masked) const { return masked.scan.owner != scan_.owner; }
  std::shared_ptr<const SharedCells> shared_cells(const LevelSetSettings& here, const MaskedScan& masked,
                                                  const Progress& progress) const {
    if (!is_changed(masked)) return nullptr;
    return find_shared_cells(*make_height_grid(scan_, here), *make_height_grid(masked.scan, here), progress);
  }

  const Scan& scan_;
  NestedLevelSettings settings_;
  ComponentChoice choice_;
  std::vector<NodeRun> nodes_;  // of what is dropped so far
  KeptComponents kept_;
};

void Choosing::drop(const LevelSetSettings& here, const LevelTopology& topology, MaskedScan& masked) {
  std::vector<Component> components = topology.components();
  std::erase_if(components, [](const Component& component) { return component.region == kOutside; });
  if (components.empty()) refuse_empty_level(here.level, kept_.dropped);
  const std::size_t count = count_kept(components, choice_);
  if (count == 0) {
    const std::string where = settings_.levels.size() > 1 ? " within level " + number_text(here.level) : "";
    refuse_to_drop_all(components, choice_, where);
  }
  kept_.dropped.found += components.size();
  const auto region = static_cast<Region>(kept_.levels.size() + 1);
  for (std::size_t n = count; n < components.size(); ++n) {
    kept_.dropped.components.push_back(components[n]);
    kept_.dropped.components.back().region = region;
  }
  if (count == components.size()) return;
  topology.visit_nodes_from(count, [&](int begin, int end, int j, int k) { nodes_.push_back({begin, end, j, k}); });
  masked.scan = turned(scan_, here, nodes_, false);
}

void Choosing::fill(const LevelSetSettings& here, const LevelTopology& topology, MaskedScan& masked) {
  const std::vector<Component>& components = topology.components();  // cavities last, largest first
  std::size_t first = components.size();
  while (first > 0 && components[first - 1].region == kOutside &&
         components[first - 1].volume_mm3 < choice_.fill_cavities_mm3) {
    --first;
  }
  if (first == components.size()) return;
  FilledCavities& filled = kept_.filled;
  filled.count += components.size() - first;
  filled.largest_mm3 = std::max(filled.largest_mm3, components[first].volume_mm3);
  for (std::size_t n = first; n < components.size(); ++n) filled.volume_mm3 += components[n].volume_mm3;
  std::vector<NodeRun> nodes;
  topology.visit_nodes_from(first, [&](int begin, int end, int j, int k) { nodes.push_back({begin, end, j, k}); });
  masked.scan = turned(masked.scan, here, nodes, true);
  const std::vector<NodeRun> bare = bare_nodes(*make_height_grid(masked.scan, here), nodes);
  if (!bare.empty()) masked.scan = turned(masked.scan, here, bare, true);
}

bool Choosing::take_level(double level, const Progress& progress) {
  const LevelSetSettings here{level, settings_.inside, settings_.outside};
  MaskedScan masked{nodes_.empty() ? scan_ : turned(scan_, here, nodes_, false), nullptr};
  const LevelTopology topology(masked.scan, here, progress);
  if (progress.cancelled()) return false;
  drop(here, topology, masked);
  masked.shared = shared_cells(here, masked, progress);
  if (choice_.fill_cavities_mm3 > 0) {
    if (is_changed(masked)) {
      const LevelTopology left(make_masked_heights(masked, here), scan_.frame, progress);
      if (progress.cancelled()) return false;
      fill(here, left, masked);
    } else {
      fill(here, topology, masked);
    }
    masked.shared = shared_cells(here, masked, progress);
  }
  kept_.levels.push_back(std::move(masked));
  return !progress.cancelled();
}

KeptComponents Choosing::take() {
  std::stable_sort(kept_.dropped.components.begin(), kept_.dropped.components.end(),
                   [](const Component& a, const Component& b) { return a.volume_mm3 > b.volume_mm3; });
  return std::move(kept_);
}

}  // namespace

KeptComponents keep_components(const Scan& scan, const NestedLevelSettings& settings, const ComponentChoice& choice,
                               const Progress& progress) {
  const NestedLevelSettings checked = checked_settings(scan, settings);
  Choosing choosing(scan, checked, choice);
  for (const double level : outermost_first(checked.levels, checked.inside)) {
    if (!choosing.take_level(level, progress)) return {};
  }
  return choosing.take();
}

KeptLevelSets make_kept_level_sets(const Scan& scan, const NestedLevelSettings& settings, const KeptComponents& kept,
                                   double cavity_mm3, const Progress& progress) {
  KeptLevelSets made;
  if (kept.levels.empty()) return made;
  std::size_t next = 0;  // they come outermost first
  made.domain = nest_level_sets(
      checked_settings(scan, settings), scan.max_value - scan.min_value, [&](const LevelSetSettings& level) {
        std::unique_ptr<Domain> domain = make_masked_level_set(kept.levels[next++], level, progress);
        if (domain == nullptr) return domain;
        for (const Component& c : domain->components()) {
          if (c.region != kOutside || c.volume_mm3 >= cavity_mm3) continue;
          made.cavities.least_mm3 =
              made.cavities.count++ == 0 ? c.volume_mm3 : std::min(made.cavities.least_mm3, c.volume_mm3);
        }
        return domain;
      });
  return made;
}

}  // namespace scantet
