// Ends of pieces are sorted, and equal ones numbered alike. All that follows goes by these numbers, so nothing depends
// on the number of threads.
#include "scantet/labels/junction_graph.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <numeric>
#include <optional>
#include <span>

#include "scantet/base/parallel.h"
#include "scantet/base/point_grid_impl.h"
#include "scantet/base/union_find.h"
#include "scantet/domain/curve_regions.h"

namespace scantet {
namespace {

/// The nodes of an edge, the lesser one first.
using Link = std::array<std::uint32_t, 2>;

/// links: maybe some of them equal, or from a node to itself. regions_of(i): those that meet along the i-th.
template <class RegionsOf>
std::vector<JunctionGraph::Edge> edges_of(const std::vector<Link>& links, const RegionsOf& regions_of) {
  std::vector<std::uint32_t> order(links.size());
  std::iota(order.begin(), order.end(), 0U);
  parallel_sort(order,
                [&](std::uint32_t a, std::uint32_t b) { return links[a] == links[b] ? a < b : links[a] < links[b]; });
  std::vector<JunctionGraph::Edge> edges;
  edges.reserve(links.size());
  for (const std::uint32_t i : order) {
    assert(links[i][0] <= links[i][1]);
    if (links[i][0] == links[i][1]) continue;
    const std::span<const Region> regions = regions_of(i);
    if (!edges.empty() && edges.back().nodes == links[i]) {
      unite_regions(edges.back().regions, regions);
    } else {
      edges.push_back({links[i], {regions.begin(), regions.end()}});
    }
  }
  return edges;
}

Link ascending(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

/// Replaces nodes by the one that stands for their set: its place is the mean of theirs.
std::vector<std::uint32_t> merge_nodes(JunctionGraph& graph, UnionFind& sets) {
  std::vector<std::uint32_t> size(graph.nodes.size(), 1);
  std::vector<std::uint32_t> merged;
  for (std::uint32_t i = 0; i < graph.nodes.size(); ++i) {
    const std::uint32_t root = sets.find(i);
    if (root == i) continue;
    JunctionGraph::Node& into = graph.nodes[root];
    if (size[root] == 1) merged.push_back(root);
    ++size[root];
    into.index = into.index + (1.0 / size[root]) * (graph.nodes[i].index - into.index);
    unite_regions(into.regions, graph.nodes[i].regions);
  }
  std::sort(merged.begin(), merged.end());
  return merged;
}

bool regions_change(const JunctionGraph::Edge& a, const JunctionGraph::Edge& b) {
  const auto includes = [](const std::vector<Region>& all, const std::vector<Region>& some) {
    return std::includes(all.begin(), all.end(), some.begin(), some.end());
  };
  return !includes(a.regions, b.regions) && !includes(b.regions, a.regions);
}

/// Walks along edges that were not walked along yet.
class ChainWalk {
 public:
  explicit ChainWalk(const JunctionGraph& graph)
      : graph_(graph), first_(graph.nodes.size() + 1, 0), walked_(graph.edges.size(), 0) {
    for (const JunctionGraph::Edge& edge : graph.edges) {
      for (const std::uint32_t node : edge.nodes) ++first_[node + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    at_node_.resize(2 * graph.edges.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
      for (const std::uint32_t node : graph.edges[e].nodes) at_node_[next[node]++] = e;
    }
  }

  std::vector<JunctionChain> all() {
    std::vector<JunctionChain> chains;
    for (std::uint32_t node = 0; node < graph_.nodes.size(); ++node) {
      if (!is_corner(node)) continue;
      for (std::uint32_t i = first_[node]; i < first_[node + 1]; ++i) {
        if (walked_[at_node_[i]] == 0) chains.push_back(walk(node, at_node_[i], false));
      }
    }
    for (std::uint32_t e = 0; e < graph_.edges.size(); ++e) {
      if (walked_[e] == 0) chains.push_back(walk(graph_.edges[e].nodes[0], e, true));
    }
    return chains;
  }

 private:
  bool is_corner(std::uint32_t node) const {
    const std::uint32_t i = first_[node];
    if (first_[node + 1] - i != 2) return true;
    return regions_change(graph_.edges[at_node_[i]], graph_.edges[at_node_[i + 1]]);
  }

  JunctionChain walk(std::uint32_t start, std::uint32_t edge, bool closed) {
    JunctionChain chain;
    chain.closed = closed;
    chain.nodes.push_back(start);
    for (std::uint32_t node = start;;) {
      const JunctionGraph::Edge& passed = graph_.edges[edge];
      assert(walked_[edge] == 0 && (passed.nodes[0] == node || passed.nodes[1] == node));
      walked_[edge] = 1;
      chain.edges.push_back(edge);
      unite_regions(chain.regions, passed.regions);
      node = passed.nodes[0] == node ? passed.nodes[1] : passed.nodes[0];
      chain.nodes.push_back(node);
      if (closed ? node == start : is_corner(node)) return chain;
      edge = at_node_[first_[node]] == edge ? at_node_[first_[node] + 1] : at_node_[first_[node]];
    }
  }

  const JunctionGraph& graph_;
  std::vector<std::uint32_t> first_;    // of each node's edges in at_node_
  std::vector<std::uint32_t> at_node_;  // edges
  std::vector<char> walked_;            // along each edge
};

double length_of(const JunctionGraph& graph, const JunctionChain& chain, double enough) {
  double sum = 0;
  for (std::size_t i = 1; i < chain.nodes.size() && sum < enough; ++i) {
    sum += distance(graph.nodes[chain.nodes[i - 1]].index, graph.nodes[chain.nodes[i]].index);
  }
  return sum;
}

/// Numbers the ends of all pieces, equal ones alike, and puts their points into the graph's nodes.
std::vector<std::uint32_t> number_ends(const std::vector<JunctionPiece>& pieces, JunctionGraph& graph) {
  struct Place {
    std::int64_t place;
    std::uint32_t end;
  };
  const auto end_of = [&](const Place& at) -> const PieceEnd& { return pieces[at.end / 2].ends[at.end % 2]; };
  std::vector<Place> order(2 * pieces.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = {end_of({0, i}).place, i};
  parallel_sort(order, [&](const Place& a, const Place& b) {
    if (a.place != b.place) return a.place < b.place;
    return end_of(a) == end_of(b) ? a.end < b.end : end_of(a) < end_of(b);
  });
  std::vector<std::uint32_t> numbers(order.size());
  graph.nodes.reserve(pieces.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const PieceEnd& end = end_of(order[i]);
    if (i == 0 || !(end == end_of(order[i - 1]))) {
      const auto none = end.regions.back() == PieceEnd::kNone ? 1 : 0;
      graph.nodes.push_back({end.index, {end.regions.begin(), end.regions.end() - none}});
    }
    numbers[order[i].end] = static_cast<std::uint32_t>(graph.nodes.size() - 1);
  }
  return numbers;
}

void unite_close_nodes(const JunctionGraph& graph, double apart, UnionFind& sets) {
  std::vector<Point> points;
  points.reserve(graph.nodes.size());
  for (const JunctionGraph::Node& node : graph.nodes) points.push_back(node.index);
  const PointGrid grid(points, 0.5);
  using Pair = std::array<std::uint32_t, 2>;
  const std::vector<Pair> pairs =
      parallel_collect<Pair>(points.size(), 4096, [&](std::size_t begin, std::size_t end, std::vector<Pair>& out) {
        for (std::size_t i = begin; i < end; ++i) {
          grid.any_near(points[i], apart, [&](std::uint32_t j, const Point&, double) {
            if (j < i) out.push_back({j, static_cast<std::uint32_t>(i)});
            return false;
          });
        }
      });
  for (const Pair& pair : pairs) sets.unite(pair[0], pair[1]);
}

}  // namespace

JunctionGraph join_pieces(const std::vector<JunctionPiece>& pieces, double apart) {
  JunctionGraph graph;
  const std::vector<std::uint32_t> numbers = number_ends(pieces, graph);
  UnionFind sets(graph.nodes.size());
  unite_close_nodes(graph, apart, sets);
  merge_nodes(graph, sets);
  std::vector<Link> links;
  links.reserve(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    links.push_back(ascending(sets.find(numbers[2 * i]), sets.find(numbers[2 * i + 1])));
  }
  graph.edges = edges_of(links, [&](std::uint32_t i) { return std::span<const Region>(pieces[i].regions); });
  return graph;
}

std::vector<std::uint32_t> find_crossings(const JunctionGraph& graph) {
  struct AtNode {
    std::size_t edges = 0;
    const std::vector<Region>* regions = nullptr;
    bool are_same = true;
  };
  std::vector<AtNode> at(graph.nodes.size());
  for (const JunctionGraph::Edge& edge : graph.edges) {
    for (const std::uint32_t node : edge.nodes) {
      AtNode& there = at[node];
      ++there.edges;
      if (there.regions == nullptr) there.regions = &edge.regions;
      there.are_same = there.are_same && edge.regions.size() == 3 && edge.regions == *there.regions;
    }
  }
  std::vector<std::uint32_t> crossings;
  for (std::uint32_t node = 0; node < at.size(); ++node) {
    if (at[node].edges > 2 && at[node].are_same) crossings.push_back(node);
  }
  return crossings;
}

std::vector<JunctionChain> find_chains(const JunctionGraph& graph) {
  return ChainWalk(graph).all();
}

Contracted contract_short_chains(JunctionGraph& graph, const std::vector<JunctionChain>& chains, double shortest) {
  Contracted contracted;
  UnionFind sets(graph.nodes.size());
  std::vector<char> gone(graph.edges.size(), 0);
  for (const JunctionChain& chain : chains) {
    if (length_of(graph, chain, shortest) >= shortest) continue;
    for (const std::uint32_t edge : chain.edges) gone[edge] = 1;
    const bool loop = sets.find(chain.nodes.front()) == sets.find(chain.nodes.back());
    ++(loop ? contracted.loops : contracted.chains);
    sets.unite(chain.nodes.front(), chain.nodes.back());
  }
  if (contracted.chains + contracted.loops == 0) return contracted;
  contracted.merged = merge_nodes(graph, sets);
  std::vector<Link> links;
  std::vector<std::uint32_t> edges;  // of the links
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
    if (gone[e] != 0) continue;
    const JunctionGraph::Edge& edge = graph.edges[e];
    links.push_back(ascending(sets.find(edge.nodes[0]), sets.find(edge.nodes[1])));
    edges.push_back(e);
  }
  graph.edges =
      edges_of(links, [&](std::uint32_t i) { return std::span<const Region>(graph.edges[edges[i]].regions); });
  return contracted;
}

}  // namespace scantet
