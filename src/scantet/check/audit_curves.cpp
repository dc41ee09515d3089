// A mesh follows a curve of its domain if the boundary vertices that lie on it, in their order along it, are joined by
// edges of boundary facets, from end to end, or all around. A vertex that is told to be on several curves, as they come
// close to each other, may be on another one alone: it may be passed over. Where a mesh has one curve for several,
// edges with the curve's regions around them, near the curve, may take the place of that edge. Where the domain has one
// curve of four regions for two of three, which are closer than places that are one, the mesh may have two again: each
// of the four is at edges all along then, with two of the others.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "scantet/base/parallel.h"
#include "scantet/base/point_grid_impl.h"
#include "scantet/check/audit_impl.h"
#include "scantet/domain/curve_regions.h"
#include "scantet/domain/patch_pieces.h"

namespace scantet::auditing {
namespace {

constexpr double kWithin = 1e-6;  // of the domain's diagonal: what is nearer to a curve is on it
constexpr double kBeside = 0.2;   // of the size: a curve that stands for another, too, is no farther from it

using Edge = std::pair<VertexId, VertexId>;

struct OnCurve {
  double along_mm;
  VertexId vertex;
};

/// The vertices on the boundary, to be asked for those on a curve.
class BoundaryVertices {
 public:
  /// step_mm: at which a curve is looked at; any, about the length of an edge is quickest.
  BoundaryVertices(const TetMesh& mesh, const std::vector<VertexId>& vertices, double step_mm)
      : vertices_(vertices), step_mm_(step_mm) {
    std::vector<Point> points;
    points.reserve(vertices.size());
    for (const VertexId v : vertices) points.push_back(mesh.vertices[v]);
    grid_ = PointGrid(points, step_mm);
  }

  /// Calls visit(vertex, point) for all that are within a distance of the curve, and for others near it; each once.
  template <class Visit>
  void each_near(const Curve& curve, double within_mm, const Visit& visit) const {
    std::set<std::uint32_t> seen;
    const double steps = std::ceil(curve.length_mm() / step_mm_);
    for (double k = 0; k <= steps; ++k) {
      // No point of the curve is farther than half a step along it from one that is looked at.
      const Point p = curve.at(curve.length_mm() * k / steps);
      grid_.any_near(p, step_mm_ + within_mm, [&](std::uint32_t i, const Point& q, double) {
        if (seen.insert(i).second) visit(vertices_[i], q);
        return false;
      });
    }
  }

 private:
  const std::vector<VertexId>& vertices_;
  double step_mm_;
  PointGrid grid_;
};

std::vector<OnCurve> vertices_on(const Curve& curve, const BoundaryVertices& boundary, double within_mm) {
  std::vector<OnCurve> found;
  boundary.each_near(curve, within_mm, [&](VertexId v, const Point& p) {
    const Curve::Nearest nearest = curve.nearest(p);
    if (nearest.distance_mm <= within_mm) found.push_back({nearest.along_mm, v});
  });
  std::sort(found.begin(), found.end(), [](const OnCurve& a, const OnCurve& b) {
    return a.along_mm != b.along_mm ? a.along_mm < b.along_mm : a.vertex < b.vertex;
  });
  return found;
}

std::array<Edge, 3> edges_of(const BoundaryFace& face) {
  const auto& v = face.vertices;  // ascending
  return {{{v[0], v[1]}, {v[0], v[2]}, {v[1], v[2]}}};
}

/// Edges of boundary faces, ascending, both of whose ends are told to be on curves, so often.
std::vector<Edge> edges_between(const FaceMatch& match, const std::vector<std::uint32_t>& curves_at) {
  std::vector<Edge> edges;
  for (const BoundaryFace& face : match.boundary) {
    for (const Edge& edge : edges_of(face)) {
      if (curves_at[edge.first] > 0 && curves_at[edge.second] > 0) edges.push_back(edge);
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Edges of more than two boundary faces, ascending.
std::vector<Edge> crowded_edges(const FaceMatch& match) {
  std::vector<Edge> edges;
  edges.reserve(3 * match.boundary.size());
  for (const BoundaryFace& face : match.boundary) {
    for (const Edge& edge : edges_of(face)) edges.push_back(edge);
  }
  parallel_sort(edges, std::less<>());
  std::vector<Edge> crowded;
  for (std::size_t n = 2; n < edges.size(); ++n) {
    if (edges[n] == edges[n - 2] && (crowded.empty() || crowded.back() != edges[n])) crowded.push_back(edges[n]);
  }
  return crowded;
}

/// Edges around pieces of the boundary that have names of their own, ascending.
std::vector<Edge> rim_edges(const TetMesh& mesh, const FaceMatch& match, const Domain& domain) {
  const auto* const pieces = dynamic_cast<const PatchPieces*>(&domain);
  if (pieces == nullptr) return {};
  std::vector<std::pair<std::size_t, Edge>> edges;
  for (const BoundaryFace& face : match.boundary) {
    const auto& [a, b, c] = face.vertices;
    const std::size_t piece = pieces->piece_of({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
    if (piece == 0) continue;
    for (const Edge& edge : edges_of(face)) edges.emplace_back(piece, edge);
  }
  std::sort(edges.begin(), edges.end());
  std::vector<Edge> rims;
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end] == edges[begin]) ++end;
    if (end == begin + 1) rims.push_back(edges[begin].second);
  }
  std::sort(rims.begin(), rims.end());
  rims.erase(std::unique(rims.begin(), rims.end()), rims.end());
  return rims;
}

/// The edges of the mesh where three or more regions meet, and those around pieces of its boundary, with the regions.
class JunctionEdges {
 public:
  /// step_mm: about the length of an edge.
  JunctionEdges(const TetMesh& mesh, const FaceMatch& match, const Domain& domain, double step_mm) : mesh_(mesh) {
    const std::vector<Edge> rims = rim_edges(mesh, match, domain);
    const std::vector<Edge> crowded = crowded_edges(match);
    std::vector<Edge> all;
    std::set_union(crowded.begin(), crowded.end(), rims.begin(), rims.end(), std::back_inserter(all));
    std::vector<bool> is_end(mesh.vertices.size(), false);
    for (const auto& [a, b] : all) is_end[a] = is_end[b] = true;
    std::vector<std::pair<Edge, Region>> sides;
    for (const BoundaryFace& face : match.boundary) {
      for (const Edge& edge : edges_of(face)) {
        if (!is_end[edge.first] || !is_end[edge.second]) continue;
        if (!std::binary_search(all.begin(), all.end(), edge)) continue;
        for (const std::uint32_t tet : {face.behind, face.front}) {
          sides.emplace_back(edge, tet == kNone ? kOutside : mesh.tet_regions[tet]);
        }
      }
    }
    std::sort(sides.begin(), sides.end());
    sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
      std::vector<Region> regions;
      for (; end < sides.size() && sides[end].first == sides[begin].first; ++end) regions.push_back(sides[end].second);
      if (regions.size() < 3 && !std::binary_search(rims.begin(), rims.end(), sides[begin].first)) continue;
      const auto [a, b] = sides[begin].first;
      next_[a].push_back({b, regions});
      next_[b].push_back({a, regions});
    }
    std::vector<Point> points;
    for (const auto& [v, edges] : next_) {
      ends_.push_back(v);
      points.push_back(mesh.vertices[v]);
      regions_.emplace_back();
      for (const Next& next : edges) unite_regions(regions_.back(), next.regions);
    }
    grid_ = PointGrid(points, step_mm);
  }

  /// The vertices on such edges that a region and two more of these meet at, or all if these are two, and that are no
  /// farther than this from a point.
  std::set<VertexId> near(const Point& p, double within_mm, Region region, const std::vector<Region>& regions) const {
    std::set<VertexId> found;
    grid_.any_near(p, within_mm, [&](std::uint32_t i, const Point&, double) {
      if (has_most(regions_[i], region, regions)) found.insert(ends_[i]);
      return false;
    });
    return found;
  }

  /// Whether edges around which a region and two more of these lie, or one if there are but two, lead from one of the
  /// vertices to one of others, over vertices that are allowed.
  template <class Allows>
  bool lead(const std::set<VertexId>& from, const std::set<VertexId>& to, Region region,
            const std::vector<Region>& regions, const Allows& allows) const {
    std::set<VertexId> seen = from;
    std::vector<VertexId> front(from.begin(), from.end());
    while (!front.empty()) {
      const VertexId v = front.back();
      front.pop_back();
      if (to.count(v) > 0) return true;
      const auto found = next_.find(v);
      if (found == next_.end()) continue;
      for (const Next& next : found->second) {
        if (!has_most(next.regions, region, regions) || seen.count(next.vertex) > 0) continue;
        if (!allows(mesh_.vertices[next.vertex])) continue;
        seen.insert(next.vertex);
        front.push_back(next.vertex);
      }
    }
    return false;
  }

 private:
  struct Next {
    VertexId vertex;
    std::vector<Region> regions;  // around the edge, ascending
  };

  /// Whether ascending regions have this one and two more of others, ascending too, or all if these are two.
  static bool has_most(const std::vector<Region>& regions, Region region, const std::vector<Region>& others) {
    if (!std::binary_search(regions.begin(), regions.end(), region)) return false;
    const auto is_other = [&](Region r) { return std::binary_search(others.begin(), others.end(), r); };
    return std::count_if(regions.begin(), regions.end(), is_other) >= std::min<std::ptrdiff_t>(3, std::ssize(others));
  }

  const TetMesh& mesh_;
  std::map<VertexId, std::vector<Next>> next_;
  std::vector<VertexId> ends_;
  std::vector<std::vector<Region>> regions_;  // around each of them, ascending
  PointGrid grid_;
};

std::string name_of(const Curve& curve, std::size_t index) {
  return curve.name().empty() ? named("curve", index) : curve.name();
}

/// One curve against the mesh.
class CurveCheck {
 public:
  /// curves_at: by vertex, how many curves it is told to be on; edges: those between such vertices, ascending.
  CurveCheck(const Curve& curve, const std::vector<OnCurve>& on, const std::vector<std::uint32_t>& curves_at,
             const std::vector<Edge>& edges, const JunctionEdges& junctions, const SizingField* size, double within_mm)
      : curve_(curve),
        on_(on),
        curves_at_(curves_at),
        edges_(edges),
        junctions_(junctions),
        size_(size),
        within_mm_(within_mm),
        regions_(regions_at(curve)) {}

  /// Calls miss(point) where the mesh does not follow it.
  template <class Miss>
  void run(const Miss& miss) const {
    const double end_mm = curve_.length_mm();
    if (on_.empty()) {
      if (!is_led({0}, {end_mm})) miss(curve_.at(0));
      return;
    }
    const bool is_closed = !curve_.corners().has_value();
    const OnCurve& first = on_.front();
    const OnCurve& last = on_.back();
    if (!is_closed && first.along_mm > within_mm_ && !is_led({0}, {first.along_mm, first.vertex})) miss(curve_.at(0));
    if (!is_closed && last.along_mm < end_mm - within_mm_ && !is_led({last.along_mm, last.vertex}, {end_mm})) {
      miss(curve_.at(end_mm));
    }
    const std::size_t all = on_.size() + (is_closed ? 1 : 0);
    const Ordered order{on_, is_closed ? first_of_its_own() : 0};
    std::vector<char> reached(all, 0);
    reached[0] = 1;
    for (std::size_t k = 1; k < all; ++k) {
      for (std::size_t from = k; from-- > 0 && reached[k] == 0;) {
        reached[k] = reached[from] != 0 && are_joined(order, from, k) ? 1 : 0;
        if (!may_be_passed(order[from])) break;
      }
      if (reached[k] != 0 || (k + 1 < all && may_be_passed(order[k]))) continue;
      reached[k] = 1;
      miss(curve_.at(order[k - 1].along_mm));
    }
  }

 private:
  /// Vertices along the curve, around it again after the last one.
  struct Ordered {
    const std::vector<OnCurve>& on;
    std::size_t first;

    OnCurve operator[](std::size_t k) const { return on[(first + k) % on.size()]; }
  };

  /// Whether it may be on another curve alone.
  bool may_be_passed(const OnCurve& there) const { return curves_at_[there.vertex] > 1; }
  /// The first vertex that is on this curve alone; the first one, if there is none.
  std::size_t first_of_its_own() const {
    const auto found =
        std::find_if(on_.begin(), on_.end(), [&](const OnCurve& there) { return !may_be_passed(there); });
    return found == on_.end() ? 0 : static_cast<std::size_t>(found - on_.begin());
  }

  bool are_joined(const Ordered& order, std::size_t from, std::size_t to) const {
    const OnCurve a = order[from];
    const OnCurve b = order[to];
    const Edge edge = std::minmax(a.vertex, b.vertex);
    if (std::binary_search(edges_.begin(), edges_.end(), edge)) return true;
    if (to > from + 1) return false;
    const double to_mm = b.along_mm > a.along_mm ? b.along_mm : b.along_mm + curve_.length_mm();
    return is_led({a.along_mm, a.vertex}, {to_mm, b.vertex});
  }

  double beside_mm(const Point& p) const { return size_ == nullptr ? 0 : kBeside * size_->size_at(p); }

  /// An end of a stretch.
  struct End {
    double along_mm;
    std::optional<VertexId> vertex = std::nullopt;  // that is there; any near it, if none
  };

  std::set<VertexId> vertices_at(const End& end, Region region) const {
    if (end.vertex) return {*end.vertex};
    const Point p = curve_.at(end.along_mm);
    return junctions_.near(p, beside_mm(p), region, regions_);
  }

  /// Whether edges near the curve lead from one place to another along it, for each of its regions.
  bool is_led(const End& from, const End& to) const {
    if (size_ == nullptr) return false;
    const auto is_beside = [&](const Point& p) {
      const Curve::Nearest nearest = curve_.nearest(p);
      const double beside = beside_mm(p);
      double along_mm = nearest.along_mm;
      if (along_mm < from.along_mm - beside) along_mm += curve_.corners() ? 0 : curve_.length_mm();
      return nearest.distance_mm <= beside && along_mm >= from.along_mm - beside && along_mm <= to.along_mm + beside;
    };
    const auto leads = [&](Region region) {
      return junctions_.lead(vertices_at(from, region), vertices_at(to, region), region, regions_, is_beside);
    };
    // Of three or fewer all are at each edge that counts: what holds of one holds of all.
    if (regions_.size() <= 3) return !regions_.empty() && leads(regions_.front());
    return std::all_of(regions_.begin(), regions_.end(), leads);
  }

  const Curve& curve_;
  const std::vector<OnCurve>& on_;
  const std::vector<std::uint32_t>& curves_at_;
  const std::vector<Edge>& edges_;
  const JunctionEdges& junctions_;
  const SizingField* size_;
  double within_mm_;
  std::vector<Region> regions_;
};

}  // namespace

void check_curves(const TetMesh& mesh, const FaceMatch& match, const std::vector<VertexId>& boundary,
                  const Domain& domain, const SizingField* size, AuditReport& report) {
  const std::vector<std::shared_ptr<const Curve>> curves = domain.curves();
  if (curves.empty()) return;
  const double within_mm = kWithin * domain.bounds().diagonal();
  // About the length of a boundary edge: of n points on a surface as wide as the bounds.
  const double step_mm = domain.bounds().diagonal() / std::sqrt(static_cast<double>(boundary.size()) + 1);
  const BoundaryVertices vertices(mesh, boundary, step_mm);
  const auto for_each_curve = [&](const auto& visit) {
    parallel_for(curves.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) visit(i);
    });
  };
  std::vector<std::vector<OnCurve>> on(curves.size());
  for_each_curve([&](std::size_t i) { on[i] = vertices_on(*curves[i], vertices, within_mm); });
  std::vector<std::uint32_t> curves_at(mesh.vertices.size(), 0);
  for (const std::vector<OnCurve>& on_curve : on) {
    for (const OnCurve& there : on_curve) ++curves_at[there.vertex];
  }
  const std::vector<Edge> edges = edges_between(match, curves_at);
  const JunctionEdges junctions(mesh, match, domain, step_mm);
  std::vector<std::vector<Point>> missed(curves.size());
  for_each_curve([&](std::size_t i) {
    const CurveCheck check(*curves[i], on[i], curves_at, edges, junctions, size, within_mm);
    check.run([&](const Point& where) { missed[i].push_back(where); });
  });
  Tally broken{"audit.curve"};
  for (std::size_t i = 0; i < curves.size(); ++i) {
    for (const Point& where : missed[i]) broken.hit(where, [&] { return name_of(*curves[i], i); });
  }
  record(broken, report);
}

}  // namespace scantet::auditing
