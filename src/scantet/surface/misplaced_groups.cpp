// What a group adds to an Euler number is counted over its vertices, edges, facets and tets, each of which is asked
// whether other tets of the inside have it, too. The tets around the group's vertices know that.
#include <algorithm>
#include <array>
#include <span>

#include "scantet/base/parallel.h"
#include "scantet/base/union_find.h"
#include "scantet/surface/misplaced_groups_impl.h"

namespace scantet::engine {
namespace {

/// A tet in a region that it should leave for another.
struct WrongTet {
  CellId cell;
  Region to;
  Point centroid;
};

/// Ascending by cell.
std::vector<WrongTet> wrong_tets(const Domain& domain, const Triangulation& t) {
  constexpr std::size_t kGrain = 8192;
  return parallel_collect<WrongTet>(t.cell_slots(), kGrain, [&](std::size_t begin, std::size_t end, auto& found) {
    std::vector<CellId> cells;
    std::vector<Point> centroids;
    for (auto c = static_cast<CellId>(begin); c < end; ++c) {
      if (!t.is_cell(c) || t.has_corner(c) || !t.is_on_boundary(c)) continue;
      const auto p = t.points_of(c);
      cells.push_back(c);
      centroids.push_back(p[0] + 0.25 * ((p[1] - p[0]) + (p[2] - p[0]) + (p[3] - p[0])));
    }
    std::vector<Region> regions(cells.size());
    domain.regions_at(centroids, regions);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Region now = t.info(cells[i]).region;
      if (regions[i] != now && (regions[i] == kOutside || now == kOutside)) {
        found.push_back({cells[i], regions[i], centroids[i]});
      }
    }
  });
}

/// wrong: ascending by cell. Return: in the order of their first tets.
std::vector<MisplacedGroup> groups_of(const Triangulation& t, const std::vector<WrongTet>& wrong) {
  const auto by_cell = [](const WrongTet& tet, CellId c) { return tet.cell < c; };
  UnionFind sets(wrong.size());
  for (std::uint32_t n = 0; n < wrong.size(); ++n) {
    for (const FacetCode across : t.cell(wrong[n].cell).neighbor) {
      const CellId next = across / 4;
      if (next > wrong[n].cell) continue;
      const auto other = std::lower_bound(wrong.begin(), wrong.end(), next, by_cell);
      const bool is_like = other != wrong.end() && other->cell == next && other->to == wrong[n].to &&
                           t.info(next).region == t.info(wrong[n].cell).region;
      if (is_like) sets.unite(n, static_cast<std::uint32_t>(other - wrong.begin()));
    }
  }
  std::vector<std::uint32_t> group_of;
  std::vector<MisplacedGroup> groups(sets.number_sets(group_of));
  for (std::size_t n = 0; n < wrong.size(); ++n) {
    MisplacedGroup& group = groups[group_of[n]];
    if (group.cells.empty()) group.place = wrong[n].centroid;
    group.cells.push_back(wrong[n].cell);
    group.to = wrong[n].to;
  }
  return groups;
}

/// Whether the cells touch a region at facets; if not, they would be a component of their own there.
bool is_beside(const Triangulation& t, const std::vector<CellId>& cells, Region region) {
  return std::any_of(cells.begin(), cells.end(), [&](CellId c) {
    const auto& neighbors = t.cell(c).neighbor;
    return std::any_of(neighbors.begin(), neighbors.end(), [&](FacetCode f) { return t.info(f / 4).region == region; });
  });
}

/// Counts Euler numbers of what tets of a group alone have: of their vertices, edges, facets and themselves.
class EulerCount {
 public:
  explicit EulerCount(const Triangulation& t) : t_(t) {}

  /// What no other tet outside has, and what no other tet inside. group: ascending.
  std::array<int, 2> of(std::span<const CellId> group) {
    group_ = group;
    alone_ = {};
    std::vector<PointId> vertices;
    for (const CellId c : group) vertices.insert(vertices.end(), t_.cell(c).vertex.begin(), t_.cell(c).vertex.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const PointId v : vertices) count_around(v);
    for (const CellId c : group) count_facets(c);
    return alone_;
  }

 private:
  bool is_in_group(CellId c) const { return std::binary_search(group_.begin(), group_.end(), c); }

  /// A vertex, edge or facet: of the tets, those that have it.
  template <class Has>
  void count(std::span<const CellId> tets, int sign, const Has& has) {
    std::array<bool, 2> others_have_it{};
    for (const CellId c : tets) {
      if (has(c) && !is_in_group(c)) others_have_it[t_.info(c).region == kOutside ? 0 : 1] = true;
    }
    for (std::size_t side = 0; side < 2; ++side) alone_[side] += others_have_it[side] ? 0 : sign;
  }
  /// The vertex, and the group's edges to later ones.
  void count_around(PointId v) {
    t_.star_of(v, star_);
    count(star_, 1, [](CellId) { return true; });
    ends_.clear();
    for (const CellId c : star_) {
      if (!is_in_group(c)) continue;
      for (const PointId end : t_.cell(c).vertex) {
        if (end > v) ends_.push_back(end);
      }
    }
    std::sort(ends_.begin(), ends_.end());
    ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
    for (const PointId end : ends_) {
      count(star_, -1, [&](CellId c) {
        const auto& vertices = t_.cell(c).vertex;
        return std::find(vertices.begin(), vertices.end(), end) != vertices.end();
      });
    }
  }
  /// The tet, and those of its facets that no earlier one of the group has.
  void count_facets(CellId c) {
    for (int& alone : alone_) --alone;
    for (const FacetCode across : t_.cell(c).neighbor) {
      const CellId next = across / 4;
      if (next < c && is_in_group(next)) continue;
      count(std::span(&next, 1), 1, [](CellId) { return true; });
    }
  }

  const Triangulation& t_;
  std::span<const CellId> group_;
  std::array<int, 2> alone_{};
  std::vector<CellId> star_;
  std::vector<PointId> ends_;
};

}  // namespace

std::vector<MisplacedGroup> misplaced_groups(const Domain& domain, const Triangulation& t) {
  constexpr std::size_t kGrain = 64;
  std::vector<MisplacedGroup> groups = groups_of(t, wrong_tets(domain, t));
  parallel_for(groups.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    EulerCount count(t);
    for (std::size_t g = begin; g < end; ++g) {
      const auto [outside, inside] = count.of(groups[g].cells);
      if (outside != 0 && is_beside(t, groups[g].cells, groups[g].to)) {
        groups[g].euler_change = groups[g].to == kOutside ? -inside : inside;
      }
    }
  });
  std::erase_if(groups, [](const MisplacedGroup& group) { return group.euler_change == 0; });
  return groups;
}

}  // namespace scantet::engine
