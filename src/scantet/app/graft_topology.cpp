// What a group of tets adds to the Euler number of a region is counted over its vertices, edges, faces and tets that no
// tet of the region has beside it.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>

#include "scantet/app/graft_impl.h"
#include "scantet/base/union_find.h"

namespace scantet::grafting {
namespace {

/// A tet or a part of one, with its vertices as the kept mesh numbers them and others after these: ascending, the rest
/// kNone.
struct Simplex {
  Region region = kOutside;
  std::array<std::uint32_t, 4> vertices{};
  friend auto operator<=>(const Simplex&, const Simplex&) = default;
};

class TopologyKeeper {
 public:
  TopologyKeeper(Part& kept, Part& fresh, const std::vector<VertexId>& match)
      : kept_(kept),
        fresh_(fresh),
        match_(match),
        first_fresh_(static_cast<std::uint32_t>(kept.mesh().vertices.size())),
        sets_(first_fresh_ + match.size()) {}

  void run(std::int64_t missing_euler) {
    const std::vector<std::uint32_t> from_kept = held_by(kept_, [](VertexId v) { return v; });
    const std::vector<std::uint32_t> from_fresh = held_by(fresh_, [&](VertexId v) { return number_of(v); });
    for (const std::uint32_t t : from_kept) group_of(kept_.mesh().tets[t][0]).kept.push_back(t);
    for (const std::uint32_t t : from_fresh) group_of(number_of(fresh_.mesh().tets[t][0])).fresh.push_back(t);
    for (const auto& [set, group] : groups_) {
      if (may_go(group, missing_euler)) continue;
      for (const std::uint32_t t : group.kept) kept_.remove(t);
      for (const std::uint32_t t : group.fresh) fresh_.remove(t);
    }
  }

 private:
  struct Group {
    std::vector<std::uint32_t> kept;
    std::vector<std::uint32_t> fresh;
  };

  std::uint32_t number_of(VertexId fresh) const {
    return match_[fresh] == kNone ? first_fresh_ + fresh : match_[fresh];
  }
  Group& group_of(std::uint32_t vertex) { return groups_[sets_.find(vertex)]; }

  template <class NumberOf>
  std::vector<std::uint32_t> held_by(const Part& part, const NumberOf& number) {
    std::vector<std::uint32_t> held;
    for (std::uint32_t t = 0; t < part.mesh().tets.size(); ++t) {
      if (!part.holds(t)) continue;
      held.push_back(t);
      const Tet& tet = part.mesh().tets[t];
      for (std::size_t k = 1; k < 4; ++k) sets_.unite(number(tet[0]), number(tet[k]));
    }
    return held;
  }

  /// missing_euler: what is missing is less by what a group brings that may go.
  bool may_go(const Group& group, std::int64_t& missing_euler) const {
    std::map<Region, std::int64_t> change;
    add_euler(
        kept_, group.kept, [](VertexId v) { return v; }, -1, change);
    add_euler(
        fresh_, group.fresh, [&](VertexId v) { return number_of(v); }, 1, change);
    if (std::all_of(change.begin(), change.end(), [](const auto& region) { return region.second == 0; })) return true;
    std::int64_t left = missing_euler;
    for (const auto& [region, more] : change) left -= more;
    if (std::abs(left) >= std::abs(missing_euler)) return false;
    missing_euler = left;
    return true;
  }

  template <class NumberOf>
  void add_euler(const Part& part, const std::vector<std::uint32_t>& tets, const NumberOf& number, int sign,
                 std::map<Region, std::int64_t>& change) const {
    std::vector<Simplex> simplices;
    for (const std::uint32_t t : tets) {
      std::array<std::uint32_t, 4> v{};
      std::transform(part.mesh().tets[t].begin(), part.mesh().tets[t].end(), v.begin(), number);
      std::sort(v.begin(), v.end());
      for (unsigned subset = 1; subset < 16; ++subset) {
        Simplex simplex{part.mesh().tet_regions[t], {kNone, kNone, kNone, kNone}};
        std::size_t count = 0;
        for (std::size_t k = 0; k < 4; ++k) {
          if ((subset >> k & 1U) != 0) simplex.vertices[count++] = v[k];
        }
        simplices.push_back(simplex);
      }
    }
    std::sort(simplices.begin(), simplices.end());
    simplices.erase(std::unique(simplices.begin(), simplices.end()), simplices.end());
    for (const Simplex& simplex : simplices) {
      if (is_around(simplex)) continue;
      const auto vertices = 4 - std::count(simplex.vertices.begin(), simplex.vertices.end(), kNone);
      change[simplex.region] += vertices % 2 == 1 ? sign : -sign;
    }
  }

  /// Whether a tet of its region has it that stays in any case.
  bool is_around(const Simplex& simplex) const {
    const auto end = std::find(simplex.vertices.begin(), simplex.vertices.end(), kNone);
    if (*(end - 1) >= first_fresh_) return false;
    const auto star = kept_.star_of(simplex.vertices[0]);
    return std::any_of(star.begin(), star.end(), [&](std::uint32_t t) {
      const Tet& tet = kept_.mesh().tets[t];
      return !kept_.holds(t) && kept_.mesh().tet_regions[t] == simplex.region &&
             std::all_of(simplex.vertices.begin(), end,
                         [&](std::uint32_t v) { return std::find(tet.begin(), tet.end(), v) != tet.end(); });
    });
  }

  Part& kept_;
  Part& fresh_;
  const std::vector<VertexId>& match_;
  std::uint32_t first_fresh_;  // the number of the fresh mesh's first vertex
  UnionFind sets_;             // of vertices
  std::map<std::uint32_t, Group> groups_;
};

}  // namespace

void put_back_other_topology(Part& kept, Part& fresh, const std::vector<VertexId>& match, std::int64_t missing_euler) {
  TopologyKeeper(kept, fresh, match).run(missing_euler);
}

}  // namespace scantet::grafting
