// A search from a vertex costs what it reaches. What it does not reach counts as one facet, so that paths are found,
// too, that part the surface, or go around such a place; few are asked for, and these are followed on both sides until
// they meet again.
#include "scantet/base/handle_loops.h"

#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <span>
#include <tuple>
#include <utility>

#include "scantet/base/parallel.h"
#include "scantet/base/union_find.h"

namespace scantet {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;
constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr std::size_t kMostFollowed = 10000;
constexpr double kBeside = 0.1;  // of the longest path: a search from so near has another vertex's paths

struct Edge {
  std::array<VertexId, 2> ends;
  std::array<std::uint32_t, 2> facets;  ///< on either side; kNone: it is not one between two facets
  double length_mm;
};

/// A surface, with its edges and those of each vertex and facet.
class EdgeGraph {
 public:
  explicit EdgeGraph(const TriangleSurface& surface) : surface_(surface), of_facet_(surface.facets.size()) {
    list_edges();
    first_.assign(surface.vertices.size() + 1, 0);
    for (const Edge& edge : edges_) {
      for (const VertexId v : edge.ends) ++first_[v + 1];
    }
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    at_vertex_.resize(2 * edges_.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      for (const VertexId v : edges_[e].ends) at_vertex_[next[v]++] = e;
    }
  }

  const TriangleSurface& surface() const { return surface_; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(edges_.size()); }
  const Edge& operator[](std::uint32_t e) const { return edges_[e]; }
  std::span<const std::uint32_t> at_vertex(VertexId v) const {
    return {at_vertex_.data() + first_[v], at_vertex_.data() + first_[v + 1]};
  }
  const std::array<std::uint32_t, 3>& of_facet(std::uint32_t facet) const { return of_facet_[facet]; }
  VertexId across(std::uint32_t e, VertexId v) const { return edges_[e].ends[edges_[e].ends[0] == v ? 1 : 0]; }

 private:
  void list_edges() {
    struct Side {
      std::array<VertexId, 2> ends;
      std::uint32_t facet, corner;
    };
    std::vector<Side> sides;
    sides.reserve(3 * surface_.facets.size());
    for (std::uint32_t f = 0; f < surface_.facets.size(); ++f) {
      for (std::uint32_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(surface_.facets[f][i], surface_.facets[f][(i + 1) % 3]);
        sides.push_back({{low, high}, f, i});
      }
    }
    parallel_sort(sides,
                  [](const Side& a, const Side& b) { return std::tie(a.ends, a.facet) < std::tie(b.ends, b.facet); });
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
      while (end < sides.size() && sides[end].ends == sides[begin].ends) ++end;
      const auto& ends = sides[begin].ends;
      Edge edge{ends, {kNone, kNone}, distance(surface_.vertices[ends[0]], surface_.vertices[ends[1]])};
      if (end - begin == 2) edge.facets = {sides[begin].facet, sides[begin + 1].facet};
      for (std::size_t n = begin; n < end; ++n) of_facet_[sides[n].facet][sides[n].corner] = size();
      edges_.push_back(edge);
    }
  }

  const TriangleSurface& surface_;
  std::vector<Edge> edges_;
  std::vector<std::array<std::uint32_t, 3>> of_facet_;
  std::vector<std::uint32_t> first_, at_vertex_;  // the edges of a vertex
};

/// The trees around one vertex after the other.
class LoopSearch {
 public:
  explicit LoopSearch(const EdgeGraph& edges)
      : edges_(edges),
        way_mm_(edges.surface().vertices.size(), kFar),
        tree_(edges.surface().vertices.size(), kNone),
        number_(edges.surface().facets.size(), kNone) {}

  /// The vertices no farther from the root than that, along edges.
  const std::vector<VertexId>& within(VertexId root, double reach_mm) {
    reach(root, reach_mm);
    forget_ways();
    return reached_;
  }

  /// Calls take() with each path that has the root beside it, and some of the others.
  template <class Take>
  void run(VertexId root, double longest_mm, const Take& take) {
    const double beside_mm = kBeside * longest_mm;
    reach(root, 0.5 * longest_mm + beside_mm);
    list_others();
    facets_.clear();
    UnionFind sets(1);  // 0: what is not reached
    for (const Other& other : others_) {
      for (const std::uint32_t f : edges_[other.edge].facets) add_facet(f, sets);
    }
    for (const Other& other : others_) {
      const auto& [a, b] = edges_[other.edge].facets;
      const bool is_crossed = sets.find(number_[a]) != sets.find(number_[b]);
      if (is_crossed) {
        sets.unite(number_[a], number_[b]);
      } else if (other.length_mm <= longest_mm + 2 * beside_mm) {
        HandleLoop loop = path(other);
        if (loop.length_mm <= longest_mm) take(std::move(loop));
      }
    }
    for (const std::uint32_t f : facets_) number_[f] = kNone;
    forget_ways();
  }

 private:
  /// An edge between vertices that are reached, not of the tree.
  struct Other {
    double length_mm;  ///< of the path that it closes
    std::uint32_t edge;
  };

  void forget_ways() {
    for (const VertexId v : reached_) {
      way_mm_[v] = kFar;
      tree_[v] = kNone;
    }
  }

  void reach(VertexId root, double reach_mm) {
    using Step = std::pair<double, VertexId>;
    std::priority_queue<Step, std::vector<Step>, std::greater<>> steps;
    reached_.assign(1, root);
    way_mm_[root] = 0;
    steps.push({0, root});
    while (!steps.empty()) {
      const auto [way_mm, v] = steps.top();
      steps.pop();
      if (way_mm > way_mm_[v]) continue;
      for (const std::uint32_t e : edges_.at_vertex(v)) {
        if (edges_[e].facets[0] == kNone) continue;
        const VertexId next = edges_.across(e, v);
        const double longer_mm = way_mm + edges_[e].length_mm;
        if (longer_mm > reach_mm || longer_mm >= way_mm_[next]) continue;
        if (way_mm_[next] == kFar) reached_.push_back(next);
        way_mm_[next] = longer_mm;
        tree_[next] = e;
        steps.push({longer_mm, next});
      }
    }
  }

  /// The longest first.
  void list_others() {
    others_.clear();
    for (const VertexId v : reached_) {
      for (const std::uint32_t e : edges_.at_vertex(v)) {
        const Edge& edge = edges_[e];
        const VertexId other = edges_.across(e, v);
        const bool is_listed_once = edge.ends[0] == v && way_mm_[other] < kFar && edge.facets[0] != kNone;
        if (!is_listed_once || tree_[v] == e || tree_[other] == e) continue;
        others_.push_back({way_mm_[v] + way_mm_[other] + edge.length_mm, e});
      }
    }
    std::sort(others_.begin(), others_.end(), [](const Other& a, const Other& b) {
      return a.length_mm != b.length_mm ? a.length_mm > b.length_mm : a.edge < b.edge;
    });
  }

  void add_facet(std::uint32_t f, UnionFind& sets) {
    if (number_[f] != kNone) return;
    number_[f] = sets.size();
    facets_.push_back(f);
    sets.add();
    const Triangle& corners = edges_.surface().facets[f];
    const bool is_whole = std::all_of(corners.begin(), corners.end(), [&](VertexId v) { return way_mm_[v] < kFar; });
    if (!is_whole) sets.unite(0, number_[f]);
  }

  HandleLoop path(const Other& other) {
    std::array<std::vector<VertexId>, 2> ways;  // from the ends of the edge to the root
    for (std::size_t side = 0; side < 2; ++side) {
      VertexId v = edges_[other.edge].ends[side];
      ways[side].push_back(v);
      while (tree_[v] != kNone) ways[side].push_back(v = edges_.across(tree_[v], v));
    }
    HandleLoop loop;
    while (ways[0].size() > 1 && ways[1].size() > 1 && ways[0].end()[-2] == ways[1].end()[-2]) {
      ways[0].pop_back();
      ways[1].pop_back();
    }
    loop.vertices = ways[0];
    loop.vertices.insert(loop.vertices.end(), ways[1].rbegin() + 1, ways[1].rend());
    Vec sum{};
    const std::vector<Point>& points = edges_.surface().vertices;
    for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
      const Point& p = points[loop.vertices[i]];
      sum = sum + (p - points[loop.vertices[0]]);
      loop.length_mm += distance(p, points[loop.vertices[(i + 1) % loop.vertices.size()]]);
    }
    loop.center = points[loop.vertices[0]] + (1.0 / static_cast<double>(loop.vertices.size())) * sum;
    return loop;
  }

  const EdgeGraph& edges_;
  std::vector<double> way_mm_;         // of the vertices; kFar where not reached
  std::vector<std::uint32_t> tree_;    // the edge to each vertex
  std::vector<std::uint32_t> number_;  // of facets, in their union-find; kNone but during a search
  std::vector<VertexId> reached_;
  std::vector<std::uint32_t> facets_;
  std::vector<Other> others_;
};

/// Follows both sides of a path, facet by facet in turn, until they meet or one comes to its end.
class PartSearch {
 public:
  explicit PartSearch(const EdgeGraph& edges) : edges_(edges), side_(edges.surface().facets.size(), 0) {}

  bool parts(const HandleLoop& loop) {
    cut_.clear();
    for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
      cut_.push_back(edge_between(loop.vertices[i], loop.vertices[(i + 1) % loop.vertices.size()]));
    }
    std::sort(cut_.begin(), cut_.end());
    std::array<std::vector<std::uint32_t>, 2> found;
    for (std::size_t side = 0; side < 2; ++side) {
      found[side].push_back(edges_[cut_.front()].facets[side]);
      side_[found[side].front()] = static_cast<std::uint8_t>(side + 1);
    }
    bool have_met = false;
    for (std::size_t n = 0; !have_met && n < found[0].size() && n < found[1].size(); ++n) {
      for (std::size_t side = 0; side < 2; ++side) have_met = go_on(found[side][n], found[side]) || have_met;
    }
    for (const auto& facets : found) {
      for (const std::uint32_t f : facets) side_[f] = 0;
    }
    return !have_met;
  }

 private:
  std::uint32_t edge_between(VertexId a, VertexId b) const {
    const auto around = edges_.at_vertex(a);
    return *std::find_if(around.begin(), around.end(), [&](std::uint32_t e) { return edges_.across(e, a) == b; });
  }

  /// Return: whether a facet of the other side is beside this one.
  bool go_on(std::uint32_t facet, std::vector<std::uint32_t>& found) {
    bool have_met = false;
    for (const std::uint32_t e : edges_.of_facet(facet)) {
      if (edges_[e].facets[0] == kNone || std::binary_search(cut_.begin(), cut_.end(), e)) continue;
      const std::uint32_t next = edges_[e].facets[edges_[e].facets[0] == facet ? 1 : 0];
      have_met = have_met || (side_[next] != 0 && side_[next] != side_[facet]);
      if (side_[next] != 0) continue;
      side_[next] = side_[facet];
      found.push_back(next);
    }
    return have_met;
  }

  const EdgeGraph& edges_;
  std::vector<std::uint8_t> side_;  // of facets; 0 but during a search
  std::vector<std::uint32_t> cut_;  // ascending
};

/// Vertices to search from: all others are beside one of them. Where vertices are dense, few.
std::vector<VertexId> roots_among(const EdgeGraph& edges, const LengthAt& longest_mm) {
  const std::vector<Point>& points = edges.surface().vertices;
  LoopSearch search(edges);
  std::vector<std::uint8_t> is_beside(points.size(), 0);
  std::vector<VertexId> roots;
  for (VertexId v = 0; v < points.size(); ++v) {
    if (is_beside[v] != 0 || edges.at_vertex(v).empty()) continue;
    roots.push_back(v);
    for (const VertexId near : search.within(v, kBeside * longest_mm(points[v]))) is_beside[near] = 1;
  }
  return roots;
}

}  // namespace

std::vector<HandleLoop> handle_loops(const TriangleSurface& surface, const LengthAt& longest_mm,
                                     const LoopFilter& is_asked) {
  constexpr std::size_t kGrain = 2048;
  const EdgeGraph edges(surface);
  const std::vector<VertexId> roots = roots_among(edges, longest_mm);
  std::vector<HandleLoop> loops =
      parallel_collect<HandleLoop>(roots.size(), kGrain, [&](std::size_t begin, std::size_t end, auto& found) {
        LoopSearch search(edges);
        for (std::size_t n = begin; n < end; ++n) {
          search.run(roots[n], longest_mm(surface.vertices[roots[n]]), [&](HandleLoop&& loop) {
            if (is_asked(loop)) found.push_back(std::move(loop));
          });
        }
      });
  std::stable_sort(loops.begin(), loops.end(),
                   [](const HandleLoop& a, const HandleLoop& b) { return a.length_mm < b.length_mm; });
  PartSearch search(edges);
  std::vector<HandleLoop> kept;
  std::size_t followed = 0;
  for (HandleLoop& loop : loops) {
    const auto is_like = [&](const HandleLoop& k) { return distance(k.center, loop.center) < 0.5 * loop.length_mm; };
    if (std::any_of(kept.begin(), kept.end(), is_like)) continue;
    if (followed++ == kMostFollowed) break;
    if (!search.parts(loop)) kept.push_back(std::move(loop));
  }
  return kept;
}

}  // namespace scantet
