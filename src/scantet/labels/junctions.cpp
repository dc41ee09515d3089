// Traced in linear fields first (junction_pieces.cpp), which settles what joins what; then the points are moved to
// where the trilinear fields are equal. What is shorter than a tenth of a voxel is mostly made by ties, and is smaller
// than any mesh will show.
#include "scantet/labels/junctions.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <optional>

#include "scantet/base/parallel.h"
#include "scantet/labels/junction_curve.h"
#include "scantet/labels/junction_graph.h"
#include "scantet/labels/junction_pieces.h"
#include "scantet/labels/junction_places.h"

namespace scantet {
namespace {

constexpr double kApart = 0.02;      // voxels; closer points are one
constexpr double kShortest = 0.1;    // voxels
constexpr double kThinned = 0.02;    // of the shortest voxel edge
constexpr std::size_t kPlaces = 16;  // along a curve where the order of its regions is looked at
constexpr int kMostRounds = 8;       // of contractions

/// Moves nodes to where their regions meet. Return: how many stay where they are.
std::size_t settle(const LabelField& field, JunctionGraph& graph, const std::vector<std::uint32_t>& nodes) {
  std::atomic<std::size_t> unsettled{0};
  parallel_for(nodes.size(), 1024, [&](std::size_t begin, std::size_t end) {
    JunctionPlaces places(field);
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) {
      JunctionGraph::Node& node = graph.nodes[nodes[i]];
      std::optional<Vec> place = places.meeting_near(node.index, node.regions);
      if (!place) {
        ++count;
        place = places.boundary_near(node.index);
      }
      if (place) node.index = *place;
    }
    unsettled += count;
  });
  return unsettled;
}

std::vector<std::uint32_t> nodes_with_edges(const JunctionGraph& graph) {
  std::vector<std::uint32_t> nodes;
  nodes.reserve(2 * graph.edges.size());
  for (const JunctionGraph::Edge& edge : graph.edges) nodes.insert(nodes.end(), edge.nodes.begin(), edge.nodes.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// The points of a polyline that are needed so that all others are within `tolerance` of it, its ends among them.
std::vector<Point> thinned(const std::vector<Point>& points, double tolerance) {
  std::vector<char> kept(points.size(), 0);
  kept.front() = kept.back() = 1;
  std::vector<std::array<std::size_t, 2>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    const Vec along = points[last] - points[first];
    const double squared = squared_length(along);
    double most = tolerance * tolerance;
    std::size_t farthest = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double t = squared > 0 ? std::clamp(dot(points[i] - points[first], along) / squared, 0.0, 1.0) : 0;
      const double off = squared_distance(points[i], lerp(points[first], points[last], t));
      if (off <= most) continue;
      most = off;
      farthest = i;
    }
    if (farthest == first) continue;
    kept[farthest] = 1;
    open.push_back({first, farthest});
    open.push_back({farthest, last});
  }
  std::vector<Point> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (kept[i] != 0 && (result.empty() || points[i] != result.back())) result.push_back(points[i]);
  }
  return result;
}

/// The regions of a chain in the order in which they follow each other around it, right-handed about its direction in
/// world space.
class RegionOrder {
 public:
  RegionOrder(const LabelField& field, const JunctionGraph& graph)
      : graph_(graph), mirrored_(field.frame().determinant_mm3() < 0), places_(field) {}

  std::vector<Region> of(const JunctionChain& chain) {
    std::vector<Region> order = chain.regions.size() == 3 ? of_three(chain) : of_more(chain);
    if (mirrored_) std::reverse(order.begin(), order.end());
    std::rotate(order.begin(), std::min_element(order.begin(), order.end()), order.end());
    return order;
  }

 private:
  /// Calls look(place, direction) for some places along the chain, none of them an end if there are others.
  template <class Look>
  void look_along(const JunctionChain& chain, const Look& look) {
    const auto index = [&](std::size_t i) { return graph_.nodes[chain.nodes[i]].index; };
    const std::size_t inner = chain.nodes.size() - 2;
    for (std::size_t n = 0; n < std::min(inner, kPlaces); ++n) {
      const std::size_t i = 1 + n * inner / std::min(inner, kPlaces);
      look(index(i), index(i + 1) - index(i - 1));
    }
    if (inner > 0) return;
    const Vec middle = 0.5 * (index(0) + index(1));
    look(places_.meeting_near(middle, chain.regions).value_or(middle), index(1) - index(0));
  }

  std::vector<Region> of_three(const JunctionChain& chain) {
    std::vector<Region> order = chain.regions;
    double turn = 0;
    look_along(chain, [&](const Vec& place, const Vec& direction) {
      turn += places_.turn_of(place, direction, std::span<const Region, 3>(chain.regions.data(), 3));
    });
    if (turn < 0) std::swap(order[1], order[2]);
    return order;
  }

  std::vector<Region> of_more(const JunctionChain& chain) {
    std::map<std::vector<Region>, std::size_t> votes;
    look_along(chain, [&](const Vec& place, const Vec& direction) {
      std::vector<Region> around = places_.regions_around(place, direction);
      std::vector<Region> found = around;
      std::sort(found.begin(), found.end());
      if (std::includes(found.begin(), found.end(), chain.regions.begin(), chain.regions.end())) ++votes[around];
    });
    const auto best =
        std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    return best == votes.end() ? chain.regions : best->first;
  }

  const JunctionGraph& graph_;
  bool mirrored_;
  JunctionPlaces places_;
};

/// Numbers corners as chains come to them.
class Corners {
 public:
  explicit Corners(const JunctionGraph& graph) : number_(graph.nodes.size(), kNone) {}

  std::size_t add(std::uint32_t node) {
    if (number_[node] == kNone) {
      number_[node] = nodes_.size();
      nodes_.push_back(node);
      ends_.push_back(0);
    }
    ++ends_[number_[node]];
    return number_[node];
  }
  const std::vector<std::uint32_t>& nodes() const { return nodes_; }
  std::size_t open_ends() const { return static_cast<std::size_t>(std::count(ends_.begin(), ends_.end(), 1U)); }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};
  std::vector<std::size_t> number_;  // of each node
  std::vector<std::uint32_t> nodes_;
  std::vector<std::size_t> ends_;  // of curves, at each
};

void add_curves(const LabelField& field, const JunctionGraph& graph, const std::vector<JunctionChain>& chains,
                Junctions& out) {
  const double tolerance_mm = kThinned * field.frame().min_spacing_mm();
  std::vector<std::shared_ptr<const Curve>> curves(chains.size());
  std::vector<std::optional<std::array<std::size_t, 2>>> corners(chains.size());
  Corners numbers(graph);
  for (std::size_t i = 0; i < chains.size(); ++i) {
    if (!chains[i].closed) {
      const std::size_t start = numbers.add(chains[i].nodes.front());
      corners[i] = {start, numbers.add(chains[i].nodes.back())};
    }
  }
  parallel_for(chains.size(), 64, [&](std::size_t begin, std::size_t end) {
    RegionOrder order(field, graph);
    for (std::size_t i = begin; i < end; ++i) {
      std::vector<Point> points;
      for (const std::uint32_t node : chains[i].nodes)
        points.push_back(field.frame().to_world(graph.nodes[node].index));
      PolylineCurve course(thinned(points, tolerance_mm), order.of(chains[i]), corners[i]);
      curves[i] = std::make_shared<JunctionCurve>(field, std::move(course));
    }
  });
  for (const std::uint32_t node : numbers.nodes()) {
    out.corners.push_back({field.frame().to_world(graph.nodes[node].index), graph.nodes[node].regions, {}});
  }
  out.open_ends = numbers.open_ends();
  out.curves = std::move(curves);
}

}  // namespace

Junctions find_junctions(const LabelField& field, Progress& progress) {
  progress.report({"read", "junctions", 0, std::nullopt, 0});
  Junctions found;
  JunctionPieces traced = trace_junctions(field, progress);
  if (progress.cancelled()) return {};
  found.broken = traced.broken;
  JunctionGraph graph = join_pieces(traced.pieces, kApart);
  traced.pieces = {};
  if (progress.cancelled()) return {};
  found.unsettled = settle(field, graph, nodes_with_edges(graph));
  std::vector<JunctionChain> chains = find_chains(graph);
  for (int round = 0; round < kMostRounds; ++round) {
    const Contracted contracted = contract_short_chains(graph, chains, kShortest);
    found.contracted += contracted.chains;
    found.loops += contracted.loops;
    if (contracted.chains + contracted.loops == 0) break;
    found.unsettled += settle(field, graph, contracted.merged);
    chains = find_chains(graph);
  }
  if (progress.cancelled()) return {};
  add_curves(field, graph, chains, found);
  for (const std::uint32_t node : find_crossings(graph)) {
    const JunctionGraph::Node& at = graph.nodes[node];
    if (at.regions.size() == 3) found.crossings.push_back({at.index, {at.regions[0], at.regions[1], at.regions[2]}});
  }
  return found;
}

}  // namespace scantet
