// The faces around the star of v are joined to u instead, which fills the star if all tets are positively oriented. A
// vertex of the boundary takes its facets along; then the link condition keeps the topology: the neighbours that u and
// v share are those of the edge uv, in the mesh and on its boundary.
#include <algorithm>

#include "scantet/optimize/contraction_impl.h"

namespace scantet::optimize {
namespace {

/// Collects the vertices of those of the tets that are wanted, in ascending order and each once.
template <class Wanted>
void collect_vertices(const TetComplex& complex, std::span<const TetId> tets, const Wanted& wanted,
                      std::vector<VertexId>& vertices) {
  vertices.clear();
  for (const TetId t : tets) {
    const Tet& tet = complex.tet(t);
    if (wanted(tet)) vertices.insert(vertices.end(), tet.begin(), tet.end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

bool contains(const std::vector<VertexId>& ascending, VertexId v) {
  return std::binary_search(ascending.begin(), ascending.end(), v);
}

}  // namespace

void Contraction::try_edge(VertexId v, VertexId u, Change& best) {
  const Freedom freedom = guard_.freedom(v, fan_);
  if (freedom == Freedom::none) return;
  added_.clear();
  double sharpest = bound_;
  for (const TetId t : complex_.star(v)) {
    Tet tet = complex_.tet(t);
    if (has_vertex(tet, u)) continue;
    std::replace(tet.begin(), tet.end(), v, u);
    sharpest = std::max(sharpest, complex_.sharpness(tet, best.sharpest));
    if (sharpest >= best.sharpest) return;
    added_.push_back({tet, complex_.region(t)});
  }
  const bool on_surface = freedom == Freedom::on_surface;
  if (on_surface) {
    if (!keeps_topology(v, u)) return;
    sharpest = std::max(sharpest, rate_facets(v, u));
    if (sharpest >= best.sharpest) return;
  }
  best.reset(sharpest);
  best.added = added_;
  best.removed.assign(complex_.star(v).begin(), complex_.star(v).end());
  best.read = best.removed;
  if (on_surface) best.read.insert(best.read.end(), complex_.star(u).begin(), complex_.star(u).end());
}

bool Contraction::keeps_topology(VertexId v, VertexId u) {
  if (guard_.freedom(u, other_) != Freedom::on_surface) return false;
  if (fan_.rim.size() == 3 && other_.rim.size() == 3) return false;  // the surface of a tet: it would be gone
  const auto in_fan = [&](VertexId w) { return std::find(fan_.rim.begin(), fan_.rim.end(), w) != fan_.rim.end(); };
  if (!in_fan(u) || std::count_if(other_.rim.begin(), other_.rim.end(), in_fan) != 2) return false;
  collect_vertices(
      complex_, complex_.star(v), [](const Tet&) { return true; }, near_v_);
  collect_vertices(
      complex_, complex_.star(v), [&](const Tet& tet) { return has_vertex(tet, u); }, near_edge_);
  for (const TetId t : complex_.star(u)) {
    for (const VertexId w : complex_.tet(t)) {
      if (contains(near_v_, w) && !contains(near_edge_, w)) return false;
    }
  }
  return true;
}

/// How sharp the facets of v would be if v went to u; kInverted if they may not go there.
double Contraction::rate_facets(VertexId v, VertexId u) {
  facets_ = guard_.facets(v, fan_);
  moved_facets_.clear();
  for (std::size_t i = 0; i < fan_.rim.size(); ++i) {
    if (fan_.rim[i] == u || fan_.rim[(i + 1) % fan_.rim.size()] == u) continue;
    moved_facets_.push_back({complex_.point(u), facets_[i][1], facets_[i][2]});
  }
  return guard_.rate_replacement(facets_, moved_facets_, fan_);
}

}  // namespace scantet::optimize
