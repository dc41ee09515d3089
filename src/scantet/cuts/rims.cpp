// The graph of the plane (rim_graph.h) becomes chains between corners. Curves of the domain that hit the plane are
// corners: those of three regions or more are where the graph has junctions, sharp edges break a chain. Points between
// those of a chain are added until the chain is close to the rim.
#include "scantet/cuts/rims.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "scantet/cuts/rim_curve.h"
#include "scantet/cuts/rim_graph.h"
#include "scantet/domain/curve_regions.h"

namespace scantet {
namespace {

constexpr double kClose = 0.01;    // of a square: a chain may be so far from the rim
constexpr double kBeside = 0.25;   // of a square: where the rim is looked for beside a chain
constexpr double kNothing = 1e-7;  // of a square: points as close are one
constexpr double kHitReach = 2;    // squares between a junction of the graph and that of the domain
constexpr int kMostHalvings = 5;
constexpr std::uint32_t kNoNode = 0xffffffff;

/// A way through the graph, from a corner to the next, or around.
struct Chain {
  std::vector<Point> points;
  RimSides sides{};
  std::optional<std::array<std::size_t, 2>> corners;
};

class RimFinder {
 public:
  RimFinder(const CutSpace& space, std::size_t plane, const std::vector<CutLine>& lines, CutCurves& found)
      : space_(space),
        plane_(space.planes[plane]),
        axes_(plane_, space.box.center()),
        found_(found),
        graph_(trace_rims(space, plane, lines)) {}

  PlaneRims run(std::size_t plane, const std::vector<CurveHit>& hits) {
    for (const CurveHit& hit : hits) {
      if (hit.plane == plane) place(hit.corner);
    }
    join_links();
    PlaneRims rims;
    rims.meets_inside = graph_.meets_inside;
    for (std::uint32_t n = 0; n < graph_.nodes.size(); ++n) {
      if (links_at_[n].empty() || links_at_[n].size() == 2 || graph_.nodes[n].corner) continue;
      ++rims.unsettled;
      add_corner(n);
    }
    walked_.assign(graph_.links.size(), 0);
    for (std::uint32_t n = 0; n < graph_.nodes.size(); ++n) {
      if (!graph_.nodes[n].corner) continue;
      for (const std::uint32_t link : links_at_[n]) {
        if (walked_[link] == 0) add_rim(walk(n, link));
      }
    }
    for (std::uint32_t link = 0; link < graph_.links.size(); ++link) {
      if (walked_[link] == 0) add_rim(walk(graph_.links[link].nodes[0], link));
    }
    return rims;
  }

 private:
  /// Puts a corner where a curve of the domain hits the plane into the graph.
  void place(std::size_t corner) {
    const Point& p = found_.corners[corner].point;
    const std::vector<Region>& regions = found_.corners[corner].regions;
    double least = kHitReach * graph_.step_mm;
    std::uint32_t nearest = kNoNode;
    for (std::uint32_t n = 0; n < graph_.nodes.size() && regions.size() > 2; ++n) {
      const RimNode& node = graph_.nodes[n];
      if (!node.is_junction || node.corner || distance(node.point, p) > least) continue;
      least = distance(node.point, p);
      nearest = n;
    }
    if (nearest != kNoNode) {
      graph_.nodes[nearest].point = p;
      graph_.nodes[nearest].corner = corner;
      return;
    }
    split_nearest_link(corner);
  }

  void split_nearest_link(std::size_t corner) {
    const Corner& at = found_.corners[corner];
    double least = kHitReach * graph_.step_mm;
    std::size_t nearest = graph_.links.size();
    for (std::size_t l = 0; l < graph_.links.size(); ++l) {
      const RimLink& link = graph_.links[l];
      const auto is_there = [&](Region region) {
        return region == kOutside || std::binary_search(at.regions.begin(), at.regions.end(), region);
      };
      if (!is_there(link.left) || !is_there(link.right)) continue;
      const double away = distance_to(link, at.point);
      if (away >= least) continue;
      least = away;
      nearest = l;
    }
    if (nearest == graph_.links.size()) return;
    const auto node = static_cast<std::uint32_t>(graph_.nodes.size());
    graph_.nodes.push_back({at.point, corner, false});
    RimLink rest = graph_.links[nearest];
    graph_.links[nearest].nodes[1] = node;
    rest.nodes[0] = node;
    graph_.links.push_back(rest);
  }

  double distance_to(const RimLink& link, const Point& p) const {
    const Point& a = graph_.nodes[link.nodes[0]].point;
    const Vec along = graph_.nodes[link.nodes[1]].point - a;
    const double squared = squared_length(along);
    const double t = squared > 0 ? std::clamp(dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
    return distance(p, a + t * along);
  }

  void join_links() {
    links_at_.assign(graph_.nodes.size(), {});
    for (std::uint32_t l = 0; l < graph_.links.size(); ++l) {
      for (const std::uint32_t node : graph_.links[l].nodes) links_at_[node].push_back(l);
    }
  }

  void add_corner(std::uint32_t node) {
    std::vector<Region> regions{kOutside};
    for (const std::uint32_t l : links_at_[node]) {
      const RimLink& link = graph_.links[l];
      const auto [low, high] = std::minmax(link.left, link.right);
      unite_regions(regions, std::array{low, high});
    }
    graph_.nodes[node].corner = found_.corners.size();
    found_.corners.push_back({graph_.nodes[node].point, std::move(regions), {}});
  }

  Chain walk(std::uint32_t start, std::uint32_t link) {
    Chain chain;
    std::uint32_t node = start;
    const bool is_forward = graph_.links[link].nodes[0] == start;
    chain.sides = {graph_.links[link].left, graph_.links[link].right};
    if (!is_forward) std::swap(chain.sides.left, chain.sides.right);
    chain.points.push_back(graph_.nodes[node].point);
    for (;;) {
      walked_[link] = 1;
      const auto& ends = graph_.links[link].nodes;
      node = ends[0] == node ? ends[1] : ends[0];
      chain.points.push_back(graph_.nodes[node].point);
      if (node == start || graph_.nodes[node].corner) break;
      const std::vector<std::uint32_t>& links = links_at_[node];
      link = links[0] == link ? links[1] : links[0];
    }
    const auto first = graph_.nodes[start].corner;
    const auto last = graph_.nodes[node].corner;
    if (first && last) chain.corners = {*first, *last};
    return chain;
  }

  /// The points of a chain, and others on the rim between them.
  std::vector<Point> course_of(const Chain& chain) const {
    std::vector<Point> course{chain.points.front()};
    for (std::size_t n = 1; n < chain.points.size(); ++n) {
      add_between(chain, chain.points[n - 1], chain.points[n], 0, course);
      course.push_back(chain.points[n]);
    }
    std::vector<Point> apart;
    for (const Point& p : course) {
      if (apart.empty() || distance(apart.back(), p) > kNothing * graph_.step_mm) apart.push_back(p);
    }
    if (apart.size() > 1) apart.back() = course.back();
    return apart;
  }

  void add_between(const Chain& chain, const Point& a, const Point& b, int halvings, std::vector<Point>& course) const {
    const double long_mm = distance(a, b);
    if (halvings == kMostHalvings || long_mm < kClose * graph_.step_mm) return;
    const Point middle = lerp(a, b, 0.5);
    // In a square that it leaves on the side where it entered a rim may bow as far.
    const double reach_mm = std::max(0.5 * long_mm, graph_.step_mm);
    const auto on_rim = meeting_across(space_.inner, plane_, chain.sides, middle, b - a, reach_mm);
    if (!on_rim || distance(*on_rim, middle) <= kClose * graph_.step_mm) return;
    add_between(chain, a, *on_rim, halvings + 1, course);
    course.push_back(*on_rim);
    add_between(chain, *on_rim, b, halvings + 1, course);
  }

  /// About the way of a rim, right-handed, there follow the outside beyond the plane, what is right and what is left.
  static std::vector<Region> regions_around(const Chain& chain) {
    std::vector<Region> regions{kOutside};
    for (const Region side : {chain.sides.right, chain.sides.left}) {
      if (side != kOutside) regions.push_back(side);
    }
    return regions;
  }

  void add_rim(const Chain& chain) {
    const std::vector<Point> course = course_of(chain);
    if (course.size() < 2 || (!chain.corners && course.size() < 4)) return;
    if (chain.corners && (*chain.corners)[0] == (*chain.corners)[1] && course.size() < 4) return;
    PolylineCurve polyline(course, regions_around(chain), chain.corners);
    found_.curves.push_back(
        std::make_shared<RimCurve>(space_.inner, plane_, chain.sides, std::move(polyline), kBeside * graph_.step_mm));
  }

  const CutSpace& space_;
  const CutPlane& plane_;
  PlaneAxes axes_;
  CutCurves& found_;
  RimGraph graph_;
  std::vector<std::vector<std::uint32_t>> links_at_;  // each node
  std::vector<char> walked_;                          // along each link
};

}  // namespace

PlaneRims find_rims(const CutSpace& space, std::size_t plane, const std::vector<CutLine>& lines,
                    const std::vector<CurveHit>& hits, CutCurves& found) {
  return RimFinder(space, plane, lines, found).run(plane, hits);
}

}  // namespace scantet
