// Without the edge ab, each triangle of a triangulation of the polygon around it makes a tet with a and one with b. The
// best triangulation is found by dynamic programming (Klincsek; Shewchuk, "Two discrete optimization algorithms for the
// topological improvement of tetrahedral meshes", 2002). At a boundary edge each region at it has a polygon of its own,
// and they share the edge that closes them: the new boundary edge.
#include <algorithm>

#include "scantet/optimize/edge_removal_impl.h"

namespace scantet::optimize {

void EdgeRemoval::try_edge(VertexId a, VertexId b, EdgeKind kind, Change& best) {
  if (!find_ring(a, b)) return;
  find_sectors();
  const bool closed = is_closed();
  const bool inner = closed && sectors_.size() == 1;
  if (inner != (kind == EdgeKind::inner) || sectors_.size() > (closed ? 2 : 1)) return;
  added_.clear();
  double sharpest = bound_;
  for (const Sector& sector : sectors_) {
    sharpest = std::max(sharpest, triangulate(a, b, sector, best.sharpest));
    if (sharpest >= best.sharpest) return;
    collect(a, b, 0, polygon_.size() - 1, ring_[sector.begin].region);
  }
  const VertexId u = ring_[sectors_[0].begin].from;
  const VertexId w = ring_[sectors_[0].end - 1].to;
  if (!inner) {
    sharpest = std::max(sharpest, rate_flip(a, b, u, w));
    if (sharpest >= best.sharpest) return;
  }
  best.reset(sharpest);
  best.added = added_;
  for (const RingTet& r : ring_) best.removed.push_back(r.tet);
  best.read = best.removed;
  if (inner) return;
  for (const VertexId v : {a, b, u, w}) {
    best.read.insert(best.read.end(), complex_.star(v).begin(), complex_.star(v).end());
  }
}

/// Lists the tets at the edge ab in the order in which they follow each other. Returns false if there are too many of
/// them, or if they are more than one row.
bool EdgeRemoval::find_ring(VertexId a, VertexId b) {
  ring_.clear();
  for (const TetId t : complex_.star(a)) {
    const Tet& tet = complex_.tet(t);
    if (!has_vertex(tet, b)) continue;
    if (ring_.size() == kMostTets) return false;
    const auto [from, to] = opposite_edge(tet, a, b);
    ring_.push_back({t, from, to, complex_.region(t)});
  }
  const auto is_first = [&](const RingTet& r) {
    return std::none_of(ring_.begin(), ring_.end(), [&](const RingTet& before) { return before.to == r.from; });
  };
  const auto first = std::find_if(ring_.begin(), ring_.end(), is_first);
  if (first != ring_.end()) std::swap(ring_.front(), *first);
  for (auto at = ring_.begin(); at + 1 != ring_.end(); ++at) {
    const auto next = std::find_if(at + 1, ring_.end(), [&](const RingTet& r) { return r.from == at->to; });
    if (next == ring_.end()) return false;
    std::swap(*(at + 1), *next);
  }
  return true;
}

void EdgeRemoval::find_sectors() {
  const auto change = std::adjacent_find(ring_.begin(), ring_.end(),
                                         [](const RingTet& r, const RingTet& s) { return r.region != s.region; });
  if (change != ring_.end() && is_closed()) std::rotate(ring_.begin(), change + 1, ring_.end());
  sectors_.clear();
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    if (i == 0 || ring_[i].region != ring_[i - 1].region) sectors_.push_back({i, i});
    sectors_.back().end = i + 1;
  }
}

/// Returns the sharpness of the sharpest tet; kInverted if there is no way with all less sharp than `too_sharp`.
double EdgeRemoval::triangulate(VertexId a, VertexId b, const Sector& sector, double too_sharp) {
  polygon_.assign(1, ring_[sector.begin].from);
  for (std::size_t i = sector.begin; i < sector.end; ++i) polygon_.push_back(ring_[i].to);
  if (polygon_.back() == polygon_.front()) polygon_.pop_back();
  const std::size_t last = polygon_.size() - 1;
  for (std::size_t i = 0; i < last; ++i) sharpest_[i][i + 1] = -kInverted;
  for (std::size_t span = 2; span <= last; ++span) {
    for (std::size_t i = 0; i + span <= last; ++i) {
      const std::size_t j = i + span;
      double& best = sharpest_[i][j];
      best = kInverted;
      for (std::size_t k = i + 1; k < j; ++k) {
        const double limit = std::min(best, too_sharp);
        double sharpest = std::max(sharpest_[i][k], sharpest_[k][j]);
        if (sharpest >= limit) continue;
        sharpest = std::max(sharpest, complex_.sharpness({a, polygon_[i], polygon_[k], polygon_[j]}, limit));
        if (sharpest >= limit) continue;
        sharpest = std::max(sharpest, complex_.sharpness({polygon_[i], polygon_[k], polygon_[j], b}, limit));
        if (sharpest >= limit) continue;
        best = sharpest;
        corner_[i][j] = k;
      }
    }
  }
  return sharpest_[0][last];
}

void EdgeRemoval::collect(VertexId a, VertexId b, std::size_t i, std::size_t j, Region region) {
  if (j == i + 1) return;
  const std::size_t k = corner_[i][j];
  added_.push_back({{a, polygon_[i], polygon_[k], polygon_[j]}, region});
  added_.push_back({{polygon_[i], polygon_[k], polygon_[j], b}, region});
  collect(a, b, i, k, region);
  collect(a, b, k, j, region);
}

/// How sharp the facets would be if uw took the place of the boundary edge ab; kInverted if it may not. It must be new;
/// where a region has one tet at ab only, which goes, uw is an edge of that, and must be an inner one.
double EdgeRemoval::rate_flip(VertexId a, VertexId b, VertexId u, VertexId w) {
  if (!may_lose(a) || !may_lose(b) || complex_.is_sharp_edge(a, b)) return kInverted;
  const bool is_edge =
      std::any_of(sectors_.begin(), sectors_.end(), [](const Sector& s) { return s.end - s.begin == 1; });
  for (const TetId t : complex_.star(u)) {
    const Tet& tet = complex_.tet(t);
    if (!has_vertex(tet, w)) continue;
    if (!is_edge) return kInverted;
    for (int k = 0; k < 4; ++k) {
      const VertexId opposite = tet[static_cast<std::size_t>(k)];
      if (opposite != u && opposite != w && complex_.is_boundary_face(t, k)) return kInverted;
    }
  }
  const Point& pa = complex_.point(a);
  const Point& pb = complex_.point(b);
  const Point& pu = complex_.point(u);
  const Point& pw = complex_.point(w);
  // They point out of the first sector.
  const bool on_curve = guard_.touches_curve({u, w});
  Facets before;
  before.add({pa, pu, pb}, guard_.touches_curve({a, u, b}));
  before.add({pa, pb, pw}, guard_.touches_curve({a, b, w}));
  Facets after;
  after.add({pa, pu, pw}, on_curve || complex_.on_curve(a));
  after.add({pb, pw, pu}, on_curve || complex_.on_curve(b));
  Sides sides{ring_.front().region, sectors_.size() > 1 ? ring_[sectors_[1].begin].region : kOutside};
  if (sides.front < sides.behind && sides.front != kOutside) {
    std::swap(sides.behind, sides.front);
    for (Facets* facets : {&before, &after}) {
      for (Corners& facet : facets->all()) std::swap(facet[1], facet[2]);
    }
  }
  if ((complex_.on_curve(a) || complex_.on_curve(b)) && !guard_.has_surface_near(before, sides)) return kInverted;
  return guard_.rate_replacement(before, after, sides);
}

/// Whether v can do without an edge of the boundary that is none of a curve.
bool EdgeRemoval::may_lose(VertexId v) {
  constexpr std::size_t kLeastFacets = 4;
  if (complex_.on_curve(v)) return true;  // which has two facets beside the edge, and one instead
  return guard_.freedom(v, fan_) == Freedom::on_surface && fan_.rim.size() >= kLeastFacets;
}

}  // namespace scantet::optimize
