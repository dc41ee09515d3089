// A node that comes back changes b1, the number of handles of the side, by what it changes components of the side and
// of the other one, less what it changes the Euler number (b1 is the same for both sides). Components of the side are
// known (union-find). Those of the other side are not, but it comes apart at most as often as in the block around the
// node. So a node comes back if b1 cannot grow.
#include "scantet/topology/side_growth.h"

#include <algorithm>
#include <array>

#include "scantet/base/neighbors.h"
#include "scantet/topology/block_parts.h"
#include "scantet/topology/bucket_queue.h"
#include "scantet/topology/trilinear_saddles.h"

namespace scantet {
namespace {

constexpr std::size_t kMiddle = 13;

class Grower {
 public:
  using Group = std::vector<std::uint32_t>;

  Grower(SidedNodes& nodes, bool inside, double core_mm, const std::vector<float>& distances)
      : nodes_(nodes), inside_(inside), core_mm_(core_mm), distances_(distances), changes_(nodes), queue_(core_mm) {
    marks_.resize(static_cast<std::size_t>(nodes.nodes().count()));
    for (const NeighborOffset& o : kNeighborhood) {
      steps_.push_back(nodes.nodes().step(o));
    }
  }

  void take_away(const std::vector<std::uint32_t>& component_of);
  void grow(UnionFind& sets, const Progress& progress);
  std::vector<Group> put_back();

 private:
  enum Mark : std::uint8_t { kNone, kAway, kQueued };
  void queue(std::int64_t n) {
    marks_[n] = kQueued;
    queue_.push(distances_[n], static_cast<std::uint32_t>(n));
  }
  bool has_neighbour(std::int64_t n) const {
    return std::any_of(steps_.begin(), steps_.end(), [&](std::int64_t s) { return nodes_.inside(n + s) == inside_; });
  }
  bool may_come_back(std::int64_t n, UnionFind& sets) const;
  void join(std::int64_t n, const SideChange& change, UnionFind& sets) const;
  void come_back(std::int64_t n);

  SidedNodes& nodes_;
  bool inside_;
  double core_mm_;
  const std::vector<float>& distances_;
  SideChanges changes_;
  std::vector<std::int64_t> steps_;
  std::vector<std::uint8_t> marks_;
  std::vector<std::uint32_t> away_;
  BucketQueue<std::uint32_t> queue_;
};

void Grower::take_away(const std::vector<std::uint32_t>& component_of) {
  const auto core = static_cast<float>(core_mm_);
  const auto is_thin = [&](std::size_t n) { return distances_[n] < core; };
  const auto on_side = [&](std::size_t n) {
    return nodes_.inside(static_cast<std::int64_t>(n)) == inside_ && !nodes_.is_turned(static_cast<std::int64_t>(n));
  };
  const std::size_t components = 1 + *std::max_element(component_of.begin(), component_of.end());
  std::vector<std::uint8_t> has_core(components);
  for (std::size_t n = 0; n < marks_.size(); ++n) {
    if (on_side(n) && !is_thin(n)) has_core[component_of[n]] = 1;
  }
  constexpr std::uint32_t kNoNode = 0xffffffff;
  std::vector<std::uint32_t> thickest(components, kNoNode);
  for (std::size_t n = 0; n < marks_.size(); ++n) {
    if (!on_side(n) || !is_thin(n)) continue;
    away_.push_back(static_cast<std::uint32_t>(n));
    std::uint32_t& best = thickest[component_of[n]];
    if (best == kNoNode || distances_[n] > distances_[best]) best = away_.back();
  }
  std::erase_if(away_, [&](std::uint32_t n) { return !has_core[component_of[n]] && thickest[component_of[n]] == n; });
  for (const std::uint32_t n : away_) {
    nodes_.turn(n);
    marks_[n] = kAway;
  }
}

bool Grower::may_come_back(std::int64_t n, UnionFind& sets) const {
  const SideChange change = changes_.look_at(n);
  const auto on_side = [&](std::size_t m) { return (change.before.inside >> m & 1) == unsigned{inside_}; };
  // Parts of the side in the block, by the part that they become: as many as were joined to each other nowhere else.
  int components = 0;
  bool is_joined = false;
  for (std::size_t part = 0; part < 27; ++part) {
    std::array<std::uint32_t, 27> joined;
    int count = 0;
    for (std::size_t m = 0; m < 27; ++m) {
      if (m == kMiddle || !on_side(m) || change.after.part[m] != part) continue;
      is_joined = is_joined || part == change.after.part[kMiddle];
      const std::uint32_t set = sets.find(static_cast<std::uint32_t>(n + steps_[m]));
      if (std::find(joined.begin(), joined.begin() + count, set) == joined.begin() + count) joined[count++] = set;
    }
    if (count > 1) components -= count - 1;
  }
  if (!is_joined) return false;
  // Parts of the other side.
  std::uint32_t before = 0;
  std::uint32_t after = 0;
  for (std::size_t m = 0; m < 27; ++m) {
    if (m == kMiddle || on_side(m)) continue;
    before |= 1U << change.before.part[m];
    after |= 1U << change.after.part[m];
  }
  const bool was_alone = (before >> change.before.part[kMiddle] & 1) == 0;
  const int others = std::popcount(after) - std::popcount(before) - (was_alone ? 1 : 0);
  if (components + others - change.euler() > 0) return false;
  join(n, change, sets);
  return true;
}

void Grower::join(std::int64_t n, const SideChange& change, UnionFind& sets) const {
  for (std::size_t m = 0; m < 27; ++m) {
    if ((change.after.inside >> m & 1) != unsigned{inside_}) continue;
    sets.unite(static_cast<std::uint32_t>(n + steps_[m]), static_cast<std::uint32_t>(n + steps_[change.after.part[m]]));
  }
}

void Grower::come_back(std::int64_t n) {
  marks_[n] = kNone;
  nodes_.turn(n);
  for (const std::int64_t s : steps_) {
    if (marks_[n + s] == kAway) queue(n + s);
  }
}

void Grower::grow(UnionFind& sets, const Progress& progress) {
  for (const std::uint32_t n : away_) {
    if (has_neighbour(n)) queue(n);
  }
  constexpr std::uint32_t kOften = 4096;
  for (std::uint32_t step = 0; !queue_.empty() && (step % kOften != 0 || !progress.cancelled()); ++step) {
    const std::int64_t n = queue_.pop();
    marks_[n] = kAway;
    if (changes_.is_plainly_simple(n)) {
      for (const std::size_t m : {4, 10, 12, 14, 16, 22}) {  // across faces of its voxel
        if (nodes_.inside(n + steps_[m]) != inside_) continue;
        sets.unite(static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(n + steps_[m]));
        break;
      }
    } else if (!may_come_back(n, sets)) {
      continue;
    }
    come_back(n);
  }
}

std::vector<Grower::Group> Grower::put_back() {
  std::vector<Group> groups;
  std::erase_if(away_, [&](std::uint32_t n) { return marks_[n] == kNone; });
  for (const std::uint32_t n : away_) nodes_.turn(n);
  for (const std::uint32_t first : away_) {
    if (marks_[first] == kNone) continue;
    Group group{first};
    marks_[first] = kNone;
    for (std::size_t next = 0; next < group.size(); ++next) {
      for (const std::int64_t s : steps_) {
        const std::int64_t n = group[next] + s;
        if (marks_[n] == kNone) continue;
        marks_[n] = kNone;
        group.push_back(static_cast<std::uint32_t>(n));
      }
    }
    std::sort(group.begin(), group.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace

void unite_side(const SidedNodes& nodes, bool inside, UnionFind& sets) {
  const PaddedNodes& all = nodes.nodes();
  const std::int64_t dy = all.step(1);
  const std::int64_t dz = all.step(2);
  const auto is = [&](std::int64_t n) { return nodes.inside(n) == inside; };
  const auto unite = [&](std::int64_t a, std::int64_t b) {
    sets.unite(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
  };
  std::int64_t n = 0;
  for (int k = -1; k <= all.size[2]; ++k) {
    for (int j = -1; j <= all.size[1]; ++j) {
      for (int i = -1; i <= all.size[0]; ++i, ++n) {
        if (is(n)) {
          const bool along = i >= 0 && is(n - 1);
          if (along) unite(n, n - 1);
          for (const std::int64_t step : {dy, dz}) {
            const bool exists = step == dy ? j >= 0 : k >= 0;
            if (exists && is(n - step) && !(along && is(n - step - 1))) unite(n, n - step);
          }
        }
        if (i == all.size[0] || j == all.size[1] || k == all.size[2]) continue;
        if ((open_questions(nodes.pattern(n)) & kBodyOpen) == 0) continue;
        const CellParts parts = nodes.parts(n);
        const auto corner = [&](int c) { return n + all.corner_step(c); };
        for (int c = 0; c < 8; ++c) {
          const int first = std::countr_zero(unsigned{parts.corners[c]});
          if (first != c && is(corner(c))) unite(corner(c), corner(first));
        }
      }
    }
  }
}

Growth grow_side(SidedNodes& nodes, bool inside, double core_mm, const std::vector<float>& distances,
                 const std::vector<std::uint32_t>& component_of, const Progress& progress) {
  Grower grower(nodes, inside, core_mm, distances);
  grower.take_away(component_of);
  Growth growth{UnionFind(static_cast<std::size_t>(nodes.nodes().count())), {}};
  unite_side(nodes, inside, growth.sets);
  grower.grow(growth.sets, progress);
  growth.groups = grower.put_back();
  return growth;
}

}  // namespace scantet
