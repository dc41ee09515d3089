// The nodes of the dropped components are lowered to a value v on the outside of the level. Nothing of them is left:
// the field falls everywhere, so what is inside now was inside before, and each of its components holds a node (see
// level_topology.cpp), which can only be one of those kept.
//
// Nor does a kept component K come apart. Its nodes stay as they are, so do the edges of the grid that join them, and
// the faces that do: a dropped corner of such a face would be joined to K along an edge. That leaves two parts of K
// that only the body of a cell joins, where a dropped corner has a say: three sets of corners that no edge joins. These
// are single corners, three or four of which no two share an edge and any two share a face. One of K's, p, is joined to
// no other by a face. Let q be any other, and slice the cell between the face of p and q and the opposite one, with r
// and s. From slice to slice the heights at p's and q's edges of the cell fall linearly through zero, and those at r's
// and s's rise through it (one of them may stay below). As no face joins p to r or s, its height gets to zero no later
// than theirs. Were q joined to both r and s by faces, K would have all three or none, but of these it has some and not
// others. So pair q with one that it is not joined to, and p with the other: of each pair, the one inside loses at
// least as large a share of its height. So the product of the two heights inside, which does not exceed that of the two
// outside on the face of p and q, never does: no slice joins p to q, whatever q is. So p is alone in the cell, and
// nothing of K was joined there but by faces.
//
// v is as close to the level as is safe, which moves the surface of what is kept least; it matters in cells that both
// share, nowhere else.
#include "scantet/image/kept_components.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/image/level_topology.h"

namespace scantet {
namespace {

constexpr double kNudge = 1e-3;  // of the range of the values: how far off the level, where voxels are no whole numbers
constexpr int kDigits = 6;

/// Outside of the level, and no further out than some voxel is: the level itself if it is the least value.
template <class Voxel>
Voxel outside_voxel(const Scan& scan, double level, InsideSide inside) {
  const bool above = inside == InsideSide::above;
  const double farthest = above ? scan.min_value : scan.max_value;
  double wanted = 0;
  if constexpr (std::is_integral_v<Voxel>) {
    wanted = above ? std::ceil(level) - 1 : std::floor(level) + 1;
  } else {
    wanted = level + (above ? -kNudge : kNudge) * (scan.max_value - scan.min_value);
  }
  const bool in_range = above ? wanted > farthest : wanted < farthest;
  const auto voxel = static_cast<Voxel>(in_range ? wanted : farthest);
  const auto rounded = static_cast<double>(voxel);
  return (above ? rounded < level : rounded > level) ? voxel : static_cast<Voxel>(farthest);
}

/// A copy of the scan with the components from number `first` on turned outside.
Scan without(const Scan& scan, const LevelSetSettings& outermost, const LevelTopology& topology, std::size_t first) {
  Scan cleaned = scan;
  std::visit(
      [&]<class Voxel>(const Voxel* voxels) {
        const auto copy = std::make_shared<std::vector<Voxel>>(voxels, voxels + scan.voxel_count());
        const auto outside = outside_voxel<Voxel>(scan, outermost.level, outermost.inside);
        topology.visit_nodes_from(first, [&](int begin, int end, int j, int k) {
          const auto row = copy->begin() + (std::int64_t{k} * scan.size[1] + j) * scan.size[0];
          std::fill(row + begin, row + end, outside);
        });
        const auto [least, most] = std::minmax_element(copy->begin(), copy->end());
        cleaned.min_value = static_cast<double>(*least);
        cleaned.max_value = static_cast<double>(*most);
        cleaned.voxels = copy->data();
        cleaned.owner = copy;
      },
      scan.voxels);
  return cleaned;
}

/// Of components, largest first, how many are kept.
std::size_t count_kept(const std::vector<Component>& components, const ComponentChoice& choice) {
  const auto small = std::find_if(components.begin(), components.end(),
                                  [&](const Component& c) { return c.volume_mm3 < choice.min_volume_mm3; });
  const auto kept = static_cast<std::size_t>(small - components.begin());
  return choice.count ? static_cast<std::size_t>(std::min<std::uint64_t>(kept, *choice.count)) : kept;
}

[[noreturn]] void refuse_to_drop_all(const std::vector<Component>& components, const ComponentChoice& choice) {
  const std::string all = components.size() == 1
                              ? "the only component"
                              : "the largest of the " + std::to_string(components.size()) + " components";
  throw Error(Fault::input, "input.components",
              "--min-component " + number_text(choice.min_volume_mm3) + ": nothing is left, for " + all + " has " +
                  number_text(components.front().volume_mm3, kDigits) + " mm^3",
              "choose a smaller --min-component; scantet info lists the largest volumes");
}

void check_levels(const KeptComponents& kept, const NestedLevelSettings& settings) {
  const bool above = settings.inside == InsideSide::above;
  for (const double level : settings.levels) {
    if (above ? kept.scan.max_value > level : kept.scan.min_value < level) continue;
    throw Error(Fault::input, "input.components",
                "level " + number_text(level) + ": nothing of it is in what is left of the " +
                    std::to_string(kept.dropped.found) + " components",
                "keep more with --components or --min-component, or leave out the level");
  }
}

}  // namespace

KeptComponents keep_components(const Scan& scan, const NestedLevelSettings& settings, const ComponentChoice& choice,
                               const Progress& progress) {
  const NestedLevelSettings checked = checked_settings(scan, settings);
  const LevelSetSettings outermost{outermost_first(checked.levels, checked.inside).front(), checked.inside,
                                   checked.outside};
  const LevelTopology topology(scan, outermost, progress);
  if (progress.cancelled()) return {scan, {}};
  std::vector<Component> components = topology.components();
  std::erase_if(components, [](const Component& component) { return component.region == kOutside; });
  const std::size_t kept_count = count_kept(components, choice);
  if (kept_count == 0) refuse_to_drop_all(components, choice);
  KeptComponents kept{scan, {components.size(), {}}};
  if (kept_count == components.size()) return kept;
  kept.dropped.components.assign(components.begin() + static_cast<std::ptrdiff_t>(kept_count), components.end());
  kept.scan = without(scan, outermost, topology, kept_count);
  check_levels(kept, checked);
  return kept;
}

}  // namespace scantet
