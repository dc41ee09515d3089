// Cuts grow wider step by step, on either side of the level in turn, so that each handle is cut or its tunnel filled
// where that takes least (handle_cuts.cpp). For these steps nodes at the level are taken to be a little below it. In
// the end the field is looked at as LevelTopology does, which has another rule for such ties.
#include "scantet/topology/handle_closing.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <type_traits>
#include <vector>

#include "scantet/base/error.h"
#include "scantet/base/neighbors.h"
#include "scantet/topology/component_match.h"
#include "scantet/topology/handle_cuts.h"
#include "scantet/topology/level_distance.h"
#include "scantet/topology/level_topology.h"
#include "scantet/topology/side_growth.h"

namespace scantet {
namespace {

/// The value of a voxel on the other side of the level.
template <class Voxel>
Voxel mirrored(Voxel value, const Scan& scan, double level, bool to_above) {
  constexpr double kLeast = 1e-3;  // of the range of values
  const double range = scan.max_value - scan.min_value;
  const double away = to_above ? 1 : -1;
  const double off =
      std::max(away * (level - static_cast<double>(value)), std::is_integral_v<Voxel> ? 0 : kLeast * range);
  double wanted = level + away * off;
  if constexpr (std::is_integral_v<Voxel>) {
    wanted = to_above ? std::max(std::ceil(wanted), std::floor(level) + 1)
                      : std::min(std::floor(wanted), std::ceil(level) - 1);
  }
  const double farthest = to_above ? scan.max_value : scan.min_value;
  if (away * (wanted - farthest) >= 0) wanted = farthest;
  // The farthest value is one of the scan, so that it fits; 2^63 as a double does not.
  constexpr auto kMost = std::numeric_limits<Voxel>::max();
  if (wanted >= static_cast<double>(kMost)) return kMost;
  const auto voxel = static_cast<Voxel>(wanted);
  return away * (static_cast<double>(voxel) - level) > 0 ? voxel : static_cast<Voxel>(farthest);
}

/// Takes back the cuts that touch one of the nodes, or all if none does.
void take_back(std::vector<HandleCut>& cuts, const PaddedNodes& all, const std::vector<std::int64_t>& nodes) {
  const auto touches = [&](const HandleCut& cut) {
    return std::any_of(cut.nodes.begin(), cut.nodes.end(), [&](std::uint32_t n) {
      return std::any_of(kNeighborhood.begin(), kNeighborhood.end(), [&](const NeighborOffset& o) {
        const std::int64_t next = n + all.step(o);
        return std::binary_search(nodes.begin(), nodes.end(), next);
      });
    });
  };
  if (std::erase_if(cuts, touches) == 0) cuts.clear();
}

/// What handles are to be cut in.
class Closing {
 public:
  Closing(const Scan& scan, const LevelSetSettings& settings, double thinner_mm, const Progress& progress)
      : scan_(scan), settings_(settings), thinner_mm_(thinner_mm), progress_(progress) {}

  ClosedHandles close();

 private:
  bool above() const { return settings_.inside == InsideSide::above; }
  double other_height(double height) const;
  std::int64_t voxel_of(std::uint32_t n) const {
    const std::array<int, 3> node = PaddedNodes{scan_.size}.node(n);
    return (std::int64_t{node[2]} * scan_.size[1] + node[1]) * scan_.size[0] + node[0];
  }
  std::vector<HandleCut> find_cuts(const HeightGrid& heights, ClosedHandles& closed) const;
  Scan changed(const std::vector<HandleCut>& cuts) const;
  std::optional<std::int64_t> handles(const Scan& scan) const;
  std::optional<std::int64_t> euler_beside(const HandleCut& cut, const Scan& all_made,
                                           const std::vector<HandleCut>& not_made) const;
  void drop_idle(std::vector<HandleCut>& cuts) const;
  Scan verified(std::vector<HandleCut>& cuts, ClosedHandles& closed) const;

  const Scan& scan_;
  const LevelSetSettings& settings_;
  double thinner_mm_;
  const Progress& progress_;
};

double Closing::other_height(double height) const {
  const double sign = above() ? 1 : -1;
  return std::visit(
      [&]<class Voxel>(const Voxel*) {
        const double as_read = settings_.level + sign * height;
        Voxel value;
        if constexpr (std::is_integral_v<Voxel>) {
          value = as_read >= static_cast<double>(std::numeric_limits<Voxel>::max())
                      ? std::numeric_limits<Voxel>::max()
                      : static_cast<Voxel>(std::round(as_read));
        } else {
          value = static_cast<Voxel>(as_read);
        }
        const Voxel turned = mirrored(value, scan_, settings_.level, (height > 0) != above());
        return sign * (static_cast<double>(turned) - settings_.level);
      },
      scan_.voxels);
}

std::vector<HandleCut> Closing::find_cuts(const HeightGrid& heights, ClosedHandles& closed) const {
  const Frame& frame = scan_.frame;
  const std::array<double, 3> spacing_mm{frame.spacing_mm(0), frame.spacing_mm(1), frame.spacing_mm(2)};
  SidedNodes nodes(heights, [this](double height) { return other_height(height); });
  const std::vector<float> distances = level_distances(nodes, spacing_mm, thinner_mm_ / 2);
  std::vector<std::uint32_t> component_of;
  UnionFind sets(static_cast<std::size_t>(nodes.nodes().count()));
  for (const bool inside : {true, false}) unite_side(nodes, inside, sets);
  sets.number_sets(component_of);
  std::vector<HandleCut> cuts;
  std::vector<double> widths{thinner_mm_};
  while (widths.back() > frame.min_spacing_mm()) widths.push_back(widths.back() / 2);
  std::reverse(widths.begin(), widths.end());
  for (const double width_mm : widths) {
    std::vector<std::vector<std::uint32_t>> wide;
    for (const bool inside : {true, false}) {
      if (progress_.cancelled()) return {};
      if (inside && closed.only_fills) continue;
      HandleCuts found = cut_handles(nodes, inside, width_mm, spacing_mm, distances, component_of, progress_);
      std::move(found.made.begin(), found.made.end(), std::back_inserter(cuts));
      closed.wide = found.wide.size();
      if (inside) wide = std::move(found.wide);
    }
    closed.wide += count_cuts(nodes, true, wide, distances, component_of);
  }
  return cuts;
}

Scan Closing::changed(const std::vector<HandleCut>& cuts) const {
  Scan copy = scan_;
  std::visit(
      [&]<class Voxel>(const Voxel* voxels) {
        const auto values = std::make_shared<std::vector<Voxel>>(voxels, voxels + scan_.voxel_count());
        for (const HandleCut& cut : cuts) {
          for (const std::uint32_t n : cut.nodes) {
            const std::int64_t v = voxel_of(n);
            (*values)[v] = mirrored(voxels[v], scan_, settings_.level, cut.inside != above());
          }
        }
        copy.voxels = values->data();
        copy.owner = values;
      },
      scan_.voxels);
  return copy;
}

/// None if not known.
std::optional<std::int64_t> Closing::handles(const Scan& scan) const {
  std::int64_t sum = 0;
  const LevelTopology topology(scan, settings_, progress_);
  if (progress_.cancelled()) return std::nullopt;
  for (const Component& component : topology.components()) {
    if (component.region == kOutside) continue;
    if (!component.handles()) return std::nullopt;
    sum += *component.handles();
  }
  return sum;
}

/// The Euler number of the boundary of all that is inside in a box around a cut, made or not, where all others are
/// made; none if not known.
std::optional<std::int64_t> Closing::euler_beside(const HandleCut& cut, const Scan& all_made,
                                                  const std::vector<HandleCut>& not_made) const {
  constexpr int kMargin = 4;  // ties beside nodes that change are settled by nodes two further off
  const std::array<int, 3>& whole = scan_.size;
  std::array<int, 3> low = whole;
  std::array<int, 3> size{};
  for (const std::uint32_t n : cut.nodes) {
    const std::array<int, 3> node = PaddedNodes{whole}.node(n);
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], std::max(node[axis] - kMargin, 0));
      size[axis] = std::max(size[axis], std::min(node[axis] + kMargin + 1, whole[axis]));  // the end, first
    }
  }
  for (int axis = 0; axis < 3; ++axis) size[axis] -= low[axis];
  return std::visit(
      [&]<class Voxel>(const Voxel* voxels) -> std::optional<std::int64_t> {
        std::vector<Voxel> values;
        for (int k = 0; k < size[2]; ++k) {
          for (int j = 0; j < size[1]; ++j) {
            const std::int64_t row = std::int64_t{low[2] + k} * whole[1] + low[1] + j;
            const Voxel* const first = voxels + row * whole[0] + low[0];
            values.insert(values.end(), first, first + size[0]);
          }
        }
        for (const HandleCut& other : not_made) {
          for (const std::uint32_t n : other.nodes) {
            std::array<int, 3> at = PaddedNodes{whole}.node(n);
            bool within = true;
            for (int axis = 0; axis < 3; ++axis) {
              at[axis] -= low[axis];
              within = within && at[axis] >= 0 && at[axis] < size[axis];
            }
            if (!within) continue;
            const std::int64_t place = (std::int64_t{at[2]} * size[1] + at[1]) * size[0] + at[0];
            values[place] = std::get<const Voxel*>(scan_.voxels)[voxel_of(n)];
          }
        }
        Scan box = scan_;
        box.size = size;
        box.voxels = values.data();
        std::int64_t sum = 0;
        const LevelTopology topology(box, settings_);
        for (const Component& component : topology.components()) {
          if (component.region == kOutside) continue;
          if (!component.euler) return std::nullopt;
          sum += *component.euler;
        }
        return sum;
      },
      all_made.voxels);
}

/// Takes back the cuts without which there are as few handles: where ties or other cuts are beside them.
void Closing::drop_idle(std::vector<HandleCut>& cuts) const {
  if (cuts.empty()) return;
  const Scan all_made = changed(cuts);
  std::vector<HandleCut> not_made;
  std::vector<HandleCut> made;
  for (; !cuts.empty() && !progress_.cancelled(); cuts.pop_back()) {  // the widest first
    const std::optional<std::int64_t> with = euler_beside(cuts.back(), all_made, not_made);
    not_made.push_back(std::move(cuts.back()));
    const std::optional<std::int64_t> without = euler_beside(not_made.back(), all_made, not_made);
    if (!with || !without || *with <= *without) continue;
    made.push_back(std::move(not_made.back()));
    not_made.pop_back();
  }
  std::reverse(made.begin(), made.end());
  cuts = std::move(made);
}

/// The scan with those of the cuts that keep the components and take handles away; others are taken back.
Scan Closing::verified(std::vector<HandleCut>& cuts, ClosedHandles& closed) const {
  const auto before = make_height_grid(scan_, settings_);
  const PaddedNodes all{scan_.size};
  while (!cuts.empty() && !progress_.cancelled()) {
    Scan scan = changed(cuts);
    const std::vector<std::int64_t> differing =
        differing_components(*before, *make_height_grid(scan, settings_), progress_);
    if (differing.empty()) {
      const std::optional<std::int64_t> left = handles(scan);
      if (left && *left < *closed.had) {
        closed.left = *left;
        return scan;
      }
    }
    take_back(cuts, all, differing);
  }
  return scan_;
}

ClosedHandles Closing::close() {
  ClosedHandles closed;
  closed.scan = scan_;
  closed.had = handles(scan_);
  if (progress_.cancelled() || !closed.had) return closed;
  closed.left = *closed.had;
  closed.only_fills = above() ? scan_.min_value == settings_.level : scan_.max_value == settings_.level;
  const auto heights = make_height_grid(scan_, settings_);
  std::vector<HandleCut> cuts = find_cuts(*heights, closed);
  const std::size_t found = cuts.size();
  drop_idle(cuts);
  closed.scan = verified(cuts, closed);
  closed.taken_back = found - cuts.size();
  for (const HandleCut& cut : cuts) {
    ++(cut.inside ? closed.cut : closed.filled);
    closed.voxels += cut.nodes.size();
  }
  return closed;
}

}  // namespace

ClosedHandles close_handles(const Scan& scan, const LevelSetSettings& settings, double thinner_mm,
                            const Progress& progress) {
  constexpr std::int64_t kMost = 4000000000;
  if (PaddedNodes{scan.size}.count() > kMost) {
    throw Error(Fault::input, "input.too_large", "--close-handles: the image has more than 4e9 voxels",
                "cut it to what is needed with --crop, or resample it");
  }
  return Closing(scan, settings, thinner_mm, progress).close();
}

}  // namespace scantet
