// What grow_side() leaves out falls into groups of which no two share a cell, so that each can be judged by itself: in
// the cells around it, with the group on its side and on the other. If the group changes sides, b1 changes by what
// components of both sides change, less what the Euler number changes. So a group is a cut if the Euler number grows
// and components do not change: those of the other side must not be joined by it, and those of the side itself must
// hang together without it, if need be by other groups, which then stay. The thickest groups stay first.
#include "scantet/topology/handle_cuts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "scantet/topology/side_growth.h"

namespace scantet {
namespace {

/// The nodes of some cells, and how they hang together there.
struct CellsParts {
  std::vector<std::uint32_t> nodes;  // ascending
  std::vector<std::uint32_t> part;   // of each: the first node of its part, as an index
  std::int64_t eighths = 0;

  std::size_t index(std::int64_t n) const {
    return static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), n) - nodes.begin());
  }
};

CellsParts parts_of(const SidedNodes& nodes, const std::vector<std::int64_t>& cells) {
  CellsParts result;
  for (const std::int64_t cell : cells) {
    for (int c = 0; c < 8; ++c) result.nodes.push_back(static_cast<std::uint32_t>(cell + nodes.nodes().corner_step(c)));
  }
  std::sort(result.nodes.begin(), result.nodes.end());
  result.nodes.erase(std::unique(result.nodes.begin(), result.nodes.end()), result.nodes.end());
  UnionFind sets(result.nodes.size());
  for (const std::int64_t cell : cells) {
    const CellParts parts = nodes.parts(cell);
    result.eighths += parts.eighths;
    std::array<std::uint32_t, 8> corners;
    for (int c = 0; c < 8; ++c) {
      corners[c] = static_cast<std::uint32_t>(result.index(cell + nodes.nodes().corner_step(c)));
    }
    for (int c = 0; c < 8; ++c) sets.unite(corners[c], corners[std::countr_zero(unsigned{parts.corners[c]})]);
  }
  for (std::uint32_t n = 0; n < sets.size(); ++n) result.part.push_back(sets.find(n));
  return result;
}

class Choice {
 public:
  Choice(SidedNodes& nodes, bool inside, double width_mm, const std::array<double, 3>& spacing_mm,
         const std::vector<float>& distances, std::vector<std::uint32_t>& component_of)
      : nodes_(nodes),
        inside_(inside),
        most_mm_(width_mm),
        spacing_mm_(spacing_mm),
        distances_(distances),
        component_of_(component_of) {}

  HandleCuts choose(Growth& growth);

  using Group = std::vector<std::uint32_t>;
  struct Judged {
    Group nodes;
    float thickness_mm = 0;
    double width_mm = 0;
    std::int64_t handles = 0;
    std::uint32_t joins = 0;     // the component of the other side that it would be part of
    std::vector<Group> parts{};  // of the side in the cells around, that the group is in

    bool has(std::uint32_t n) const { return std::binary_search(nodes.begin(), nodes.end(), n); }
  };
  Judged judge(Group group) const;

 private:
  double width(const Group& group) const;
  bool find_joins(const CellsParts& cut, Judged& judged) const;
  void turn(const Group& group) {
    for (const std::uint32_t n : group) nodes_.turn(n);
  }

  SidedNodes& nodes_;
  bool inside_;
  double most_mm_;
  std::array<double, 3> spacing_mm_;
  const std::vector<float>& distances_;
  std::vector<std::uint32_t>& component_of_;
};

/// The largest distance between two of its nodes, with what is beyond these up to the level set; too large if that is
/// clear from a box.
double Choice::width(const Group& group) const {
  constexpr std::size_t kMany = 4096;
  std::vector<std::array<double, 3>> places;
  double box = 0;
  for (const std::uint32_t n : group) {
    const std::array<int, 3> node = nodes_.nodes().node(n);
    places.push_back({node[0] * spacing_mm_[0], node[1] * spacing_mm_[1], node[2] * spacing_mm_[2]});
    for (int axis = 0; axis < 3; ++axis) box = std::max(box, std::abs(places.back()[axis] - places.front()[axis]));
  }
  if (box > most_mm_ || group.size() > kMany) return std::max(box, 2 * most_mm_);
  double widest = 0;
  for (std::size_t a = 0; a < group.size(); ++a) {
    for (std::size_t b = a; b < group.size(); ++b) {
      const double apart =
          std::hypot(places[a][0] - places[b][0], places[a][1] - places[b][1], places[a][2] - places[b][2]);
      widest = std::max(widest, apart + distances_[group[a]] + distances_[group[b]]);
    }
  }
  return widest;
}

/// cut: with the group on the other side. Return: false if it would join components there, or be one.
bool Choice::find_joins(const CellsParts& cut, Judged& judged) const {
  std::set<std::uint32_t> parts;
  for (const std::uint32_t n : judged.nodes) parts.insert(cut.part[cut.index(n)]);
  std::set<std::uint32_t> joined;
  std::set<std::uint32_t> reached;
  for (std::size_t m = 0; m < cut.nodes.size(); ++m) {
    if (parts.count(cut.part[m]) == 0) continue;
    if (judged.has(cut.nodes[m])) continue;
    joined.insert(component_of_[cut.nodes[m]]);
    reached.insert(cut.part[m]);
  }
  if (joined.size() != 1 || reached.size() != parts.size()) return false;
  judged.joins = *joined.begin();
  return true;
}

Choice::Judged Choice::judge(Group group) const {
  Judged judged;
  judged.nodes = std::move(group);
  std::vector<std::int64_t> cells;
  for (const std::uint32_t n : judged.nodes) {
    judged.thickness_mm = std::max(judged.thickness_mm, distances_[n]);
    for (int c = 0; c < 8; ++c) cells.push_back(n - nodes_.nodes().corner_step(c));
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  const CellsParts whole = parts_of(nodes_, cells);
  for (const std::uint32_t n : judged.nodes) nodes_.turn(n);
  const CellsParts cut = parts_of(nodes_, cells);
  for (const std::uint32_t n : judged.nodes) nodes_.turn(n);
  judged.handles = (cut.eighths - whole.eighths) / 8;
  if (!find_joins(cut, judged)) judged.handles = 0;
  judged.width_mm = judged.handles > 0 ? width(judged.nodes) : 0;

  std::set<std::uint32_t> own;
  for (const std::uint32_t n : judged.nodes) own.insert(whole.part[whole.index(n)]);
  for (const std::uint32_t part : own) {
    judged.parts.emplace_back();
    for (std::size_t m = 0; m < whole.nodes.size(); ++m) {
      if (whole.part[m] == part) judged.parts.back().push_back(whole.nodes[m]);
    }
  }
  return judged;
}

HandleCuts Choice::choose(Growth& growth) {
  HandleCuts cuts;
  std::vector<Judged> candidates;
  const auto keep = [&](const Judged& judged) {
    for (const Group& part : judged.parts) {
      for (const std::uint32_t n : part) growth.sets.unite(n, part.front());
    }
  };
  for (Group& group : growth.groups) {
    Judged judged = judge(std::move(group));
    if (judged.handles > 0 && judged.width_mm <= most_mm_) {
      candidates.push_back(std::move(judged));
    } else {
      keep(judged);
      if (judged.handles > 0) cuts.wide.push_back(std::move(judged.nodes));
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Judged& a, const Judged& b) { return a.thickness_mm > b.thickness_mm; });
  for (Judged& judged : candidates) {
    const bool is_needed = std::any_of(judged.parts.begin(), judged.parts.end(), [&](const Group& part) {
      std::set<std::uint32_t> sets;
      for (const std::uint32_t n : part) {
        if (!judged.has(n)) sets.insert(growth.sets.find(n));
      }
      return sets.size() > 1;
    });
    if (is_needed) {
      keep(judged);
      continue;
    }
    turn(judged.nodes);
    for (const std::uint32_t n : judged.nodes) component_of_[n] = judged.joins;
    cuts.made.push_back({std::move(judged.nodes), inside_, judged.handles, judged.width_mm});
  }
  return cuts;
}

}  // namespace

HandleCuts cut_handles(SidedNodes& nodes, bool inside, double width_mm, const std::array<double, 3>& spacing_mm,
                       const std::vector<float>& distances, std::vector<std::uint32_t>& component_of,
                       const Progress& progress) {
  Growth growth = grow_side(nodes, inside, width_mm / 2, distances, component_of, progress);
  if (progress.cancelled()) return {};
  return Choice(nodes, inside, width_mm, spacing_mm, distances, component_of).choose(growth);
}

std::size_t count_cuts(SidedNodes& nodes, bool inside, const std::vector<std::vector<std::uint32_t>>& groups,
                       const std::vector<float>& distances, std::vector<std::uint32_t>& component_of) {
  const Choice choice(nodes, inside, 0, {1, 1, 1}, distances, component_of);
  return static_cast<std::size_t>(
      std::count_if(groups.begin(), groups.end(), [&](const auto& group) { return choice.judge(group).handles > 0; }));
}

}  // namespace scantet
