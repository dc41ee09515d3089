// A component of one field and one of the other that have nodes in common are a pair. Each should be in one pair alone.
#include "scantet/topology/component_match.h"

#include <algorithm>
#include <unordered_map>

#include "scantet/topology/level_slabs.h"
#include "scantet/topology/sided_nodes.h"

namespace scantet {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;

/// The component of each node, in numbers of both sides; kNone at the level.
std::vector<std::uint32_t> components_of_nodes(const HeightGrid& heights, const Progress& progress) {
  std::vector<LevelSlab> slabs = make_level_slabs(heights, progress);
  if (progress.cancelled()) return {};
  sew(slabs);
  const PaddedNodes all{heights.size()};
  std::vector<std::uint32_t> components(static_cast<std::size_t>(all.count()), 0);
  for (const LevelSlab& slab : slabs) {
    visit_runs(heights, slab.first, slab.last, progress,
               [&](int begin, int end, int j, int k, int side, std::uint32_t label) {
                 const auto row = components.begin() + all.number({0, j, k});
                 std::fill(row + begin, row + end, side == 0 ? kNone : slab.number_of[label]);
               });
  }
  return components;
}

/// A component before and one after, and how many nodes they have in common.
struct Pair {
  std::uint32_t before;
  std::uint32_t after;
  std::int64_t nodes;
};

/// The pairs that are not alone with either of their components, but for the one with the most nodes.
std::vector<std::uint64_t> odd_pairs(std::vector<Pair> pairs) {
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return a.nodes != b.nodes ? a.nodes > b.nodes : a.before != b.before ? a.before < b.before : a.after < b.after;
  });
  std::unordered_map<std::uint32_t, bool> seen_before;
  std::unordered_map<std::uint32_t, bool> seen_after;
  std::vector<std::uint64_t> odd;
  for (const Pair& pair : pairs) {
    const bool is_first = !seen_before[pair.before] && !seen_after[pair.after];
    if (!is_first) odd.push_back(std::uint64_t{pair.before} << 32 | pair.after);
    seen_before[pair.before] = seen_after[pair.after] = true;
  }
  std::sort(odd.begin(), odd.end());
  return odd;
}

}  // namespace

std::vector<std::int64_t> differing_components(const HeightGrid& before, const HeightGrid& after,
                                               const Progress& progress) {
  const std::vector<std::uint32_t> old = components_of_nodes(before, progress);
  const std::vector<std::uint32_t> now = components_of_nodes(after, progress);
  if (progress.cancelled()) return {};
  const PaddedNodes all{before.size()};
  std::unordered_map<std::uint64_t, std::int64_t> counts;
  std::vector<std::uint8_t> paired_old;
  std::vector<std::uint8_t> paired_now;
  const auto mark = [](std::vector<std::uint8_t>& paired, std::uint32_t component) {
    if (component >= paired.size()) paired.resize(component + 1);
    paired[component] = 1;
  };
  const auto is_same_side = [&](std::size_t n) {
    const std::array<int, 3> node = all.node(static_cast<std::int64_t>(n));
    return (before.height(node[0], node[1], node[2]) > 0) == (after.height(node[0], node[1], node[2]) > 0);
  };
  std::uint64_t last = ~std::uint64_t{0};
  std::int64_t* count = nullptr;
  for (std::size_t n = 0; n < old.size(); ++n) {
    if (old[n] == kNone || now[n] == kNone || !is_same_side(n)) continue;
    const std::uint64_t key = std::uint64_t{old[n]} << 32 | now[n];
    if (key != last) {
      count = &counts[last = key];
      mark(paired_old, old[n]);
      mark(paired_now, now[n]);
    }
    ++*count;
  }
  std::vector<Pair> pairs;
  for (const auto& [key, nodes] : counts) {
    pairs.push_back({static_cast<std::uint32_t>(key >> 32), static_cast<std::uint32_t>(key), nodes});
  }
  const std::vector<std::uint64_t> odd = odd_pairs(std::move(pairs));
  const auto is_lone = [](const std::vector<std::uint8_t>& paired, std::uint32_t component) {
    return component != kNone && (component >= paired.size() || paired[component] == 0);
  };
  std::vector<std::int64_t> differing;
  for (std::size_t n = 0; n < old.size(); ++n) {
    const std::uint64_t key = std::uint64_t{old[n]} << 32 | now[n];
    if (is_lone(paired_old, old[n]) || is_lone(paired_now, now[n]) ||
        (!odd.empty() && std::binary_search(odd.begin(), odd.end(), key))) {
      differing.push_back(static_cast<std::int64_t>(n));
    }
  }
  return differing;
}

}  // namespace scantet
