// Every element is looked at by itself, side by side, with the judges that improvement works with; their shares are
// turned into what users read only where a bound is broken.
#include "scantet/check/conformance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "scantet/base/mesh_topology.h"
#include "scantet/base/parallel.h"
#include "scantet/check/facet_corners_impl.h"
#include "scantet/optimize/facet_judge_impl.h"
#include "scantet/optimize/short_edges_impl.h"
#include "scantet/optimize/tet_judge_impl.h"

namespace scantet {
namespace {

using optimize::Corners;
using optimize::FacetJudge;
using optimize::FacetShares;
using optimize::ShortEdge;
using optimize::TetJudge;
using optimize::TetShares;

constexpr std::size_t kGrain = 4096;

/// An element that breaks a bound.
template <class Shares>
struct Broken {
  Point place;
  Shares shares;
  Point finer_at;  // where smaller elements would help
  double edge_mm;  // the longest
};

template <std::size_t count>
double longest_edge_mm(const std::array<Point, count>& p) {
  double longest = 0;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) longest = std::max(longest, squared_distance(p[i], p[j]));
  }
  return std::sqrt(longest);
}

/// The centroid; of a needle, whose shortest edge is far shorter than its longest, the vertex farthest from that edge:
/// there elements are too large for what is across from it.
Point finer_at(const std::array<Point, 4>& p) {
  constexpr double kFarShorter = 1.0 / 4;
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0;
  Point middle;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double squared = squared_distance(p[i], p[j]);
      longest = std::max(longest, squared);
      if (squared < shortest) middle = lerp(p[i], p[j], 0.5);
      shortest = std::min(shortest, squared);
    }
  }
  if (shortest >= kFarShorter * kFarShorter * longest) return 0.25 * (p[0] + p[1] + p[2] + p[3]);
  return *std::max_element(p.begin(), p.end(), [&](const Point& a, const Point& b) {
    return squared_distance(a, middle) < squared_distance(b, middle);
  });
}

/// The angle under 90° that has a share of the squared sine of another.
double sharp_angle_deg(double share, double asked_deg) {
  const double asked_sine = std::sin(asked_deg * std::numbers::pi / 180);
  return std::asin(std::min(1.0, std::sqrt(std::max(share, 0.0)) * asked_sine)) * 180 / std::numbers::pi;
}

/// Adds to a bound those elements that have less than all of their share.
template <class Shares, class Value>
BrokenBound collect(const std::vector<Broken<Shares>>& broken, double Shares::*share, const Value& value_of) {
  BrokenBound bound;
  double least = 1;
  for (const Broken<Shares>& element : broken) {
    const double its_share = element.shares.*share;
    if (its_share >= 1) continue;
    ++bound.count;
    if (its_share >= least) continue;
    least = its_share;
    bound.worst = value_of(its_share);
    bound.place = element.place;
  }
  return bound;
}

template <class Shares, class IsBroken>
std::uint64_t count_if(const std::vector<Broken<Shares>>& broken, const IsBroken& is_broken) {
  return static_cast<std::uint64_t>(std::count_if(
      broken.begin(), broken.end(), [&](const Broken<Shares>& element) { return is_broken(element.shares); }));
}

std::vector<Broken<TetShares>> broken_tets(const TetMesh& mesh, const ElementBounds& bounds) {
  const TetJudge usual_judge(bounds);
  const TetJudge curve_judge = usual_judge.without_rules();
  const auto find = [&](std::size_t begin, std::size_t end, std::vector<Broken<TetShares>>& found) {
    for (std::size_t i = begin; i < end; ++i) {
      const Tet& t = mesh.tets[i];
      const std::array<Point, 4> p{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]};
      const TetJudge& judge = touches_curve(mesh, t) ? curve_judge : usual_judge;
      if (judge.keeps_all(p[0], p[1], p[2], p[3])) continue;
      const TetShares shares = judge.shares(p[0], p[1], p[2], p[3]);
      if (shares.least() < 1)
        found.push_back({0.25 * (p[0] + p[1] + p[2] + p[3]), shares, finer_at(p), longest_edge_mm(p)});
    }
  };
  return parallel_collect<Broken<TetShares>>(mesh.tets.size(), kGrain, find);
}

std::vector<Broken<FacetShares>> broken_facets(const TetMesh& mesh, const Domain& domain, const RuleTarget& rules) {
  const FacetJudge judge(domain, rules);
  const auto find = [&](std::size_t begin, std::size_t end, std::vector<Broken<FacetShares>>& found) {
    Crossings crossings;
    for (std::size_t i = begin; i < end; ++i) {
      if (touches_curve(mesh, mesh.boundary_facets[i])) continue;
      const FacetCorners p = corners_of(mesh, i);
      const FacetShares shares = judge.shares(p, crossings);
      const Point centroid = centroid_of(p);
      if (shares.least() < 1) found.push_back({centroid, shares, centroid, longest_edge_mm(p)});
    }
  };
  return parallel_collect<Broken<FacetShares>>(mesh.boundary_facets.size(), kGrain, find);
}

/// Edges, the worst first, by the cubes of a grid that their middles lie in.
std::vector<ShortEdgePlace> places_of(const TetMesh& mesh, const std::vector<ShortEdge>& edges, double side_mm) {
  std::vector<ShortEdgePlace> places;
  std::map<std::array<double, 3>, std::size_t> place_in;
  for (const ShortEdge& edge : edges) {
    const Point& p = mesh.vertices[edge.vertex[0]];
    const Point& q = mesh.vertices[edge.vertex[1]];
    const Point middle = lerp(p, q, 0.5);
    const std::array<double, 3> cube{std::floor(middle.x / side_mm), std::floor(middle.y / side_mm),
                                     std::floor(middle.z / side_mm)};
    const auto [entry, is_new] = place_in.try_emplace(cube, places.size());
    if (is_new) places.push_back({middle, distance(p, q), 0});
    ++places[entry->second].edges;
  }
  return places;
}

void check_edges(const TetMesh& mesh, const EdgeTarget& target, Conformance& found) {
  constexpr double kSideOfLength = 20;
  const std::vector<ShortEdge> edges = optimize::short_edges(mesh, target);
  if (edges.empty()) return;
  found.short_edges = places_of(mesh, edges, target.share > 0 ? target.size->min_size() : kSideOfLength * target.mm);
  found.min_edge.count = edges.size();
  found.min_edge.worst = edges.front().share * (target.share > 0 ? target.share : target.mm);
  found.min_edge.place = found.short_edges.front().place;
}

}  // namespace

Conformance check_conformance(const TetMesh& mesh, const Domain& domain, const ElementBounds& bounds) {
  Conformance found;
  found.facets = mesh.boundary_facets.size();
  found.tets = mesh.tets.size();
  if (bounds.min_edge) check_edges(mesh, *bounds.min_edge, found);
  const auto of_bound = [](double bound) {
    return [bound](double share) {
      return share > 0 ? bound / std::sqrt(share) : std::numeric_limits<double>::infinity();
    };
  };
  const std::vector<Broken<TetShares>> tets = broken_tets(mesh, bounds);
  for (const auto& tet : tets) {
    found.places.push_back(tet.finer_at);
    found.edges_mm.push_back(tet.edge_mm);
  }
  found.min_dihedral = collect(tets, &TetShares::min_dihedral,
                               [&](double share) { return sharp_angle_deg(share, bounds.min_dihedral_deg); });
  found.max_dihedral = collect(tets, &TetShares::max_dihedral,
                               [&](double share) { return 180 - sharp_angle_deg(share, bounds.max_dihedral_deg); });
  found.scaled_jacobian = collect(tets, &TetShares::scaled_jacobian, [&](double share) {
    return std::sqrt(std::max(share, 0.0)) * bounds.min_scaled_jacobian;
  });
  found.tet_size = collect(tets, &TetShares::size, of_bound(1));
  found.unmet.r3 = count_if(tets, [](const TetShares& s) { return std::min(s.size, s.radius_edge) < 1; });
  if (!bounds.rules) return found;
  const RuleBounds& rules = bounds.rules->bounds;
  found.tet_radius_edge = collect(tets, &TetShares::radius_edge, of_bound(rules.cell_radius_edge));
  const std::vector<Broken<FacetShares>> facets = broken_facets(mesh, domain, *bounds.rules);
  for (const auto& facet : facets) {
    found.places.push_back(facet.finer_at);
    found.edges_mm.push_back(facet.edge_mm);
  }
  found.unmet.r1 = count_if(facets, [](const FacetShares& s) { return s.radius_edge < 1; });
  found.unmet.r2 = count_if(facets, [](const FacetShares& s) { return std::min(s.size, s.distance) < 1; });
  found.facet_radius_edge = collect(facets, &FacetShares::radius_edge, of_bound(rules.facet_radius_edge));
  found.facet_size = collect(facets, &FacetShares::size, of_bound(1));
  found.facet_distance = collect(facets, &FacetShares::distance, of_bound(rules.facet_distance_mm.value_or(0)));
  return found;
}

}  // namespace scantet
