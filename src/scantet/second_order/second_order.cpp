// Edges are sorted by their corners, so that their nodes have the same numbers whatever the order of work. Easing goes
// round by round: all tets that fail take their edges back a step at once, so it does not matter which is looked at
// first.
#include "scantet/second_order/second_order.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>

#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/domain/nearest_crossing.h"
#include "scantet/second_order/jacobian.h"

namespace scantet {
namespace {

using Edge = std::array<VertexId, 2>;

constexpr std::size_t kGrain = 1024;
constexpr int kSteps = 4;          // in which an edge becomes straight
constexpr double kReach = 0.5;     // of the edge: how far the boundary is looked for
constexpr double kSlack = 1e-3;    // of the edge: how far its ends may be from its curve
constexpr double kFarthest = 0.5;  // of the edge: a curve's point beyond that is another place of it

Edge ascending(VertexId a, VertexId b) {
  return a < b ? Edge{a, b} : Edge{b, a};
}

/// What is known of an edge.
struct EdgeState {
  Vec bulge;           // from the middle to where its node belongs
  int steps = kSteps;  // of these, how many are left of the bulge
  Stratum stratum{0, 3};
};

class SecondOrder {
 public:
  SecondOrder(const TetMesh& mesh, const Domain& domain) : mesh_(mesh), domain_(domain) {
    for (const auto& curve : domain.curves()) {
      std::vector<Region> regions = curve->regions();
      std::sort(regions.begin(), regions.end());
      regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
      curves_[regions].push_back(curve);
    }
  }

  /// Where the nodes belong; the mesh stays as it is.
  void find() {
    find_edges();
    find_strata();
    place_nodes();
    ease();
  }

  /// Gives the mesh, which find() was asked of, its nodes. Return: what has become of the edges.
  SecondOrderCounts put(TetMesh& out) {
    const auto first = static_cast<VertexId>(mesh_.vertices.size());
    std::vector<std::array<VertexId, 6>> numbers(mesh_.tets.size());
    for (std::size_t t = 0; t < numbers.size(); ++t) {
      const TetJacobian jacobian(nodes_of(t));
      const double straight = straight_mm3(t);
      counts_.volume_mm3 += jacobian.volume_mm3();
      if (!jacobian.is_above(0)) ++counts_.unproved;
      // Coefficients bound the determinant, and so does what was proved with halves.
      const double share = jacobian.lower_bound_mm3() / straight;
      counts_.least_share = std::min(counts_.least_share, std::max(share, is_curved(t) ? kLeastJacobianShare : share));
      for (std::size_t e = 0; e < 6; ++e) numbers[t][e] = first + of_tet_[t][e];
    }
    std::vector<Point> nodes;
    nodes.reserve(edges_.size());
    for (std::size_t e = 0; e < edges_.size(); ++e) nodes.push_back(node(e));
    out.tet_edge_vertices = std::move(numbers);
    out.vertices.insert(out.vertices.end(), nodes.begin(), nodes.end());
    for (const EdgeState& state : states_) out.strata.push_back(state.stratum);
    for (MeshSet& set : out.sets) extend(set, first);
    return counts_;
  }

 private:
  std::size_t index_of(const Edge& edge) const {
    return static_cast<std::size_t>(std::lower_bound(edges_.begin(), edges_.end(), edge) - edges_.begin());
  }

  void find_edges() {
    edges_.reserve(6 * mesh_.tets.size());
    for (const Tet& tet : mesh_.tets) {
      for (const auto& [i, j] : kEdgesOfNodes) edges_.push_back(ascending(tet[i], tet[j]));
    }
    parallel_sort(edges_, std::less<>());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    edges_.shrink_to_fit();
    if (mesh_.vertices.size() + edges_.size() > std::numeric_limits<VertexId>::max()) {
      throw Error(Fault::usage, "usage.order", "the mesh would have more nodes than can be numbered",
                  "choose a larger --size, or --order 1");
    }
    states_.resize(edges_.size());
    of_tet_.resize(mesh_.tets.size());
    parallel_for(mesh_.tets.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        const Tet& tet = mesh_.tets[t];
        for (std::size_t e = 0; e < 6; ++e) {
          of_tet_[t][e] =
              static_cast<std::uint32_t>(index_of(ascending(tet[kEdgesOfNodes[e][0]], tet[kEdgesOfNodes[e][1]])));
        }
      }
    });
  }

  /// Strata of edges, and for those of facets the sum of the facets' normals and the first facet.
  void find_strata() {
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      for (const std::uint32_t e : of_tet_[t]) states_[e].stratum.index = mesh_.tet_regions[t];
    }
    normals_.resize(edges_.size());
    facets_.assign(edges_.size(), kNone);
    for (std::size_t f = 0; f < mesh_.boundary_facets.size(); ++f) {
      const Triangle& facet = mesh_.boundary_facets[f];
      const Point &a = mesh_.vertices[facet[0]], &b = mesh_.vertices[facet[1]], &c = mesh_.vertices[facet[2]];
      const Vec normal = cross(b - a, c - a);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t e = index_of(ascending(facet[i], facet[(i + 1) % 3]));
        if (facets_[e] == kNone) {
          facets_[e] = static_cast<std::uint32_t>(f);
          states_[e].stratum = {static_cast<std::int32_t>(mesh_.facet_patches[f]), 2};
        }
        normals_[e] = normals_[e] + normal;
      }
    }
    for (std::size_t i = 0; i < mesh_.curve_edges.size(); ++i) {
      const std::size_t e = index_of(ascending(mesh_.curve_edges[i][0], mesh_.curve_edges[i][1]));
      states_[e].stratum = {static_cast<std::int32_t>(mesh_.edge_curves[i]), 1};
    }
  }

  Point middle(std::size_t e) const { return 0.5 * (mesh_.vertices[edges_[e][0]] + mesh_.vertices[edges_[e][1]]); }
  double edge_mm(std::size_t e) const { return distance(mesh_.vertices[edges_[e][0]], mesh_.vertices[edges_[e][1]]); }

  void place_nodes() {
    std::vector<std::uint8_t> found(edges_.size(), 0);
    parallel_for(edges_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      Crossings crossings;
      for (std::size_t e = begin; e < end; ++e) {
        if (facets_[e] == kNone) continue;
        const Point from = middle(e);
        const std::optional<Point> to =
            states_[e].stratum.dimension == 1 ? on_curve(e, from) : on_surface(e, from, crossings);
        if (!to) continue;
        found[e] = 1;
        states_[e].bulge = *to - from;
      }
    });
    counts_.edges = edges_.size();
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (facets_[e] == kNone) continue;
      ++counts_.boundary_edges;
      ++(found[e] != 0 ? counts_.on_boundary : counts_.off_boundary);
    }
  }

  /// Curves with the regions of the edge's curve around them.
  std::optional<Point> on_curve(std::size_t e, const Point& from) const {
    const auto& regions = mesh_.curves[static_cast<std::size_t>(states_[e].stratum.index)].regions;
    const auto alike = curves_.find(regions);
    if (alike == curves_.end()) return std::nullopt;
    std::optional<Point> nearest;
    double least = kFarthest * edge_mm(e);
    for (const auto& curve : alike->second) {
      // Both ends must be near it, or it is another curve with the same regions.
      const double slack = kSlack * edge_mm(e);
      if (curve->nearest(mesh_.vertices[edges_[e][0]]).distance_mm > slack ||
          curve->nearest(mesh_.vertices[edges_[e][1]]).distance_mm > slack) {
        continue;
      }
      const Curve::Nearest place = curve->nearest(from);
      if (place.distance_mm > least) continue;
      least = place.distance_mm;
      nearest = place.point;
    }
    return nearest;
  }

  std::optional<Point> on_surface(std::size_t e, const Point& from, Crossings& crossings) const {
    const double normal_mm2 = length(normals_[e]);
    if (!(normal_mm2 > 0)) return std::nullopt;
    const Vec reach = (kReach * edge_mm(e) / normal_mm2) * normals_[e];
    domain_.crossings({from - reach, from + reach}, crossings);
    const auto& regions = mesh_.facet_regions[facets_[e]];
    const Crossing* const nearest = nearest_crossing(
        crossings, from, [&](const Crossing& c) { return c.from == regions[0] && c.to == regions[1]; });
    return nearest != nullptr ? std::optional(nearest->point) : std::nullopt;
  }

  Point node(std::size_t e) const {
    const EdgeState& state = states_[e];
    if (state.steps == kSteps) return middle(e) + state.bulge;
    return middle(e) + (static_cast<double>(state.steps) / kSteps) * state.bulge;
  }

  TetNodes nodes_of(std::size_t t) const {
    TetNodes nodes;
    for (std::size_t i = 0; i < 4; ++i) nodes[i] = mesh_.vertices[mesh_.tets[t][i]];
    for (std::size_t e = 0; e < 6; ++e) nodes[4 + e] = node(of_tet_[t][e]);
    return nodes;
  }

  double straight_mm3(std::size_t t) const {
    const Tet& tet = mesh_.tets[t];
    return orientation_mm3(mesh_.vertices[tet[0]], mesh_.vertices[tet[1]], mesh_.vertices[tet[2]],
                           mesh_.vertices[tet[3]]);
  }

  bool is_curved(std::size_t t) const {
    return std::any_of(of_tet_[t].begin(), of_tet_[t].end(),
                       [&](std::uint32_t e) { return states_[e].steps > 0 && states_[e].bulge != Vec{}; });
  }

  /// Tets whose determinant is not proved to be large enough, ascending.
  std::vector<std::uint32_t> failing() const {
    return parallel_collect<std::uint32_t>(
        mesh_.tets.size(), kGrain, [&](std::size_t begin, std::size_t end, auto& out) {
          for (std::size_t t = begin; t < end; ++t) {
            if (!is_curved(t)) continue;
            if (!TetJacobian(nodes_of(t)).is_above(kLeastJacobianShare * straight_mm3(t))) {
              out.push_back(static_cast<std::uint32_t>(t));
            }
          }
        });
  }

  void ease() {
    std::vector<std::uint8_t> eased_tets(mesh_.tets.size(), 0);
    for (std::vector<std::uint32_t> bad = failing(); !bad.empty(); bad = failing()) {
      std::vector<std::uint32_t> edges;
      for (const std::uint32_t t : bad) {
        eased_tets[t] = 1;
        for (const std::uint32_t e : of_tet_[t]) {
          if (states_[e].steps > 0 && states_[e].bulge != Vec{}) edges.push_back(e);
        }
      }
      std::sort(edges.begin(), edges.end());
      edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
      for (const std::uint32_t e : edges) --states_[e].steps;
    }
    counts_.eased_tets = static_cast<std::uint64_t>(std::count(eased_tets.begin(), eased_tets.end(), 1));
    counts_.eased_edges = static_cast<std::uint64_t>(
        std::count_if(states_.begin(), states_.end(), [](const EdgeState& s) { return s.steps < kSteps; }));
  }

  /// Puts the nodes of edges into a set of vertices that has both ends of an edge of a curve, all corners of a boundary
  /// facet at the edge, or of a tet there that is not between boundary vertices alone: those may lie across from each
  /// other.
  void extend(MeshSet& set, VertexId first) const {
    if (set.vertices.empty()) return;
    std::vector<std::uint8_t> has(mesh_.vertices.size(), 0);
    for (const VertexId v : set.vertices) has[v] = 1;
    std::vector<std::uint32_t> edges;
    const auto in_set = [&](VertexId v) { return has[v] != 0; };
    for (const Triangle& f : mesh_.boundary_facets) {
      if (!std::all_of(f.begin(), f.end(), in_set)) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        edges.push_back(static_cast<std::uint32_t>(index_of(ascending(f[i], f[(i + 1) % 3]))));
      }
    }
    for (const auto& [a, b] : mesh_.curve_edges) {
      if (in_set(a) && in_set(b)) edges.push_back(static_cast<std::uint32_t>(index_of(ascending(a, b))));
    }
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      const Tet& tet = mesh_.tets[t];
      const bool is_between = std::all_of(tet.begin(), tet.end(), [&](VertexId v) { return mesh_.on_boundary(v); });
      if (is_between || !std::all_of(tet.begin(), tet.end(), in_set)) continue;
      edges.insert(edges.end(), of_tet_[t].begin(), of_tet_[t].end());
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const std::uint32_t e : edges) set.vertices.push_back(first + e);
  }

  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  const TetMesh& mesh_;
  const Domain& domain_;
  std::map<std::vector<Region>, std::vector<std::shared_ptr<const Curve>>> curves_;  // by the regions around them
  std::vector<Edge> edges_;
  std::vector<EdgeState> states_;
  std::vector<std::array<std::uint32_t, 6>> of_tet_;  // edges
  std::vector<Vec> normals_;                          // of edges of facets, not of unit length
  std::vector<std::uint32_t> facets_;                 // one of each edge, or kNone
  SecondOrderCounts counts_;
};

}  // namespace

SecondOrderCounts make_second_order(TetMesh& mesh, const Domain& domain, const Progress& progress) {
  if (!mesh.tet_edge_vertices.empty()) {
    throw Error(Fault::internal, "mesh.order", "the mesh is of second order already");
  }
  SecondOrder second(mesh, domain);
  if (!run_interruptible(progress, [&] { second.find(); })) return {};
  return second.put(mesh);
}

namespace {

/// The nodes of a tet of either order.
TetNodes nodes_of(const TetMesh& mesh, std::size_t tet) {
  TetNodes nodes;
  for (std::size_t i = 0; i < 4; ++i) nodes[i] = mesh.vertices[mesh.tets[tet][i]];
  for (std::size_t e = 0; e < 6; ++e) {
    nodes[4 + e] = mesh.tet_edge_vertices.empty() ? lerp(nodes[kEdgesOfNodes[e][0]], nodes[kEdgesOfNodes[e][1]], 0.5)
                                                  : mesh.vertices[mesh.tet_edge_vertices[tet][e]];
  }
  return nodes;
}

}  // namespace

SecondOrderCounts measure_second_order(const TetMesh& mesh) {
  SecondOrderCounts counts;
  std::vector<std::uint8_t> is_of_edge(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (const VertexId v : mesh.tet_edge_vertices[t]) is_of_edge[v] = 1;
    const TetNodes nodes = nodes_of(mesh, t);
    const TetJacobian jacobian(nodes);
    const double straight = orientation_mm3(nodes[0], nodes[1], nodes[2], nodes[3]);
    counts.volume_mm3 += jacobian.volume_mm3();
    if (!jacobian.is_above(0)) ++counts.unproved;
    counts.least_share = std::min(counts.least_share, straight > 0 ? jacobian.lower_bound_mm3() / straight : 0.0);
  }
  for (VertexId v = 0; v < is_of_edge.size(); ++v) {
    if (is_of_edge[v] == 0) continue;
    ++counts.edges;
    if (mesh.on_boundary(v)) ++counts.boundary_edges;
  }
  return counts;
}

double curved_volume_mm3(const TetMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) sum += TetJacobian(nodes_of(mesh, t)).volume_mm3();
  return sum;
}

}  // namespace scantet
