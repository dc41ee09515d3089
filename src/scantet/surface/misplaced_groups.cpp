// What a group adds to an Euler number is counted over its vertices, edges, facets and tets, each of which is asked
// whether other tets of the inside have it, too.
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

/// A vertex or an edge of a group.
struct Place {
  std::array<PointId, 2> ends;  ///< ascending; of a vertex twice the same
  CellId cell;                  ///< one of the group that has it
  /// Whether another tet outside is known to have it, and another one inside.
  std::array<bool, 2> others_have_it;

  bool is_decided() const { return others_have_it[0] && others_have_it[1]; }
};

/// Counts Euler numbers of what tets of a group alone have: of their vertices, edges, facets and themselves. Mostly the
/// tets across the group's facets tell that others have a vertex or an edge, too; else the tets around it are asked.
class EulerCount {
 public:
  explicit EulerCount(const Triangulation& t) : t_(t) {}

  /// What no other tet outside has, and what no other tet inside. group: ascending.
  std::array<int, 2> of(std::span<const CellId> group) {
    group_ = group;
    alone_ = {};
    vertices_.clear();
    edges_.clear();
    for (const CellId c : group) {
      for (int& alone : alone_) --alone;
      look_across(c);
    }
    join(edges_);
    for (Place& edge : edges_) {
      if (!edge.is_decided()) turn_around(edge);
      count(edge.others_have_it, -1);
      for (const PointId end : edge.ends) vertices_.push_back({{end, end}, edge.cell, edge.others_have_it});
    }
    join(vertices_);
    for (Place& vertex : vertices_) {
      if (!vertex.is_decided()) look_around(vertex);
      count(vertex.others_have_it, 1);
    }
    return alone_;
  }

 private:
  bool is_in_group(CellId c) const { return std::binary_search(group_.begin(), group_.end(), c); }
  void note(CellId c, std::array<bool, 2>& others_have_it) const {
    if (!is_in_group(c)) others_have_it[t_.info(c).region == kOutside ? 0 : 1] = true;
  }
  void count(const std::array<bool, 2>& others_have_it, int sign) {
    for (std::size_t side = 0; side < 2; ++side) alone_[side] += others_have_it[side] ? 0 : sign;
  }

  /// Counts those of the tet's facets that no earlier one of the group has; lists their edges.
  void look_across(CellId c) {
    const Cell& cell = t_.cell(c);
    for (std::size_t i = 0; i < 4; ++i) {
      const CellId next = cell.neighbor[i] / 4;
      std::array<bool, 2> others_have_it{};
      note(next, others_have_it);
      if (next > c || !is_in_group(next)) count(others_have_it, 1);
      for (std::size_t k = 0; k < 4; ++k) {
        if (k == i) continue;
        const std::size_t l = k == (i + 1) % 4 ? (i + 2) % 4 : k == (i + 2) % 4 ? (i + 3) % 4 : (i + 1) % 4;
        const auto [low, high] = std::minmax(cell.vertex[k], cell.vertex[l]);
        edges_.push_back({{low, high}, c, others_have_it});
      }
    }
  }
  /// Makes one of those that are the same.
  static void join(std::vector<Place>& places) {
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.ends < b.ends; });
    std::size_t count = 0;
    for (const Place& place : places) {
      if (count == 0 || places[count - 1].ends != place.ends) {
        places[count++] = place;
        continue;
      }
      for (std::size_t side = 0; side < 2; ++side) {
        places[count - 1].others_have_it[side] = places[count - 1].others_have_it[side] || place.others_have_it[side];
      }
    }
    places.resize(count);
  }
  void turn_around(Place& edge) const {
    std::array<PointId, 2> beside{};  // the vertex that the next tet does not have, and the one that it has
    std::size_t found = 0;
    for (const PointId v : t_.cell(edge.cell).vertex) {
      if (v != edge.ends[0] && v != edge.ends[1]) beside[found++] = v;
    }
    CellId at = edge.cell;
    do {
      const FacetCode across = t_.cell(at).neighbor[static_cast<std::size_t>(t_.index_of(at, beside[0]))];
      at = across / 4;
      beside = {beside[1], t_.cell(at).vertex[across % 4]};
      note(at, edge.others_have_it);
    } while (at != edge.cell && !edge.is_decided());
  }
  void look_around(Place& vertex) {
    t_.star_of(vertex.ends[0], star_);
    for (const CellId c : star_) note(c, vertex.others_have_it);
  }

  const Triangulation& t_;
  std::span<const CellId> group_;
  std::array<int, 2> alone_{};
  std::vector<Place> vertices_;
  std::vector<Place> edges_;
  std::vector<CellId> star_;
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
