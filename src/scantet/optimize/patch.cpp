// Tets of the part keep their slots until they are replaced, so what has changed is seen slot by slot.
#include <algorithm>

#include "scantet/optimize/patch_impl.h"

namespace scantet::optimize {
namespace {

void sort_and_unite(std::vector<std::uint32_t>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace

std::vector<VertexId> vertices_of(const TetComplex& complex, std::span<const TetId> tets) {
  std::vector<VertexId> vertices;
  for (const TetId t : tets) vertices.insert(vertices.end(), complex.tet(t).begin(), complex.tet(t).end());
  sort_and_unite(vertices);
  return vertices;
}

std::vector<TetId> tets_around(const TetComplex& complex, std::span<const TetId> tets, int rings) {
  std::vector<TetId> found(tets.begin(), tets.end());
  for (int ring = 0; ring < rings; ++ring) {
    for (const VertexId v : vertices_of(complex, found)) {
      found.insert(found.end(), complex.star(v).begin(), complex.star(v).end());
    }
    sort_and_unite(found);
  }
  return found;
}

Patch::Patch(const TetComplex& whole, std::vector<TetId> tets)
    : tets_(std::move(tets)), vertices_(vertices_of(whole, tets_)), complex_(whole.part(tets_, vertices_)) {
  find_rim();
}

void Patch::find_rim() {
  rim_tets_.assign(tets_.size(), 0);
  rim_vertices_.assign(vertices_.size(), 0);
  for (TetId t = 0; t < tets_.size(); ++t) {
    for (int k = 0; k < 4; ++k) {
      if (!complex_.is_cut(t, k)) continue;
      rim_tets_[t] = 1;
      for (const VertexId v : face_of(complex_.tet(t), k)) rim_vertices_[v] = 1;
    }
  }
}

bool Patch::keeps_off_rim(const Change& change) const {
  const auto is_on_rim_tet = [&](TetId t) { return t < rim_tets_.size() && rim_tets_[t] != 0; };
  return !is_on_rim(change.vertex) && std::none_of(change.removed.begin(), change.removed.end(), is_on_rim_tet);
}

void Patch::put_into(TetComplex& whole, const TetComplex& changed) const {
  std::vector<VertexId> number = vertices_;
  for (VertexId v = 0; v < changed.vertex_slots(); ++v) {
    if (changed.star(v).empty()) {
      if (v >= number.size()) number.push_back(kNoVertex);
    } else if (v >= number.size()) {
      number.push_back(whole.add_vertex(changed.point(v), changed.on_boundary(v)));
    } else if (changed.point(v) != complex_.point(v)) {
      whole.move(number[v], changed.point(v), changed.on_boundary(v));
    }
  }
  std::vector<TetId> removed;
  std::vector<NewTet> added;
  for (TetId t = 0; t < changed.tet_slots(); ++t) {
    const bool was = t < tets_.size();
    const bool is = changed.is_tet(t);
    if (was && is && changed.tet(t) == complex_.tet(t) && changed.region(t) == complex_.region(t)) continue;
    if (was) removed.push_back(tets_[t]);
    if (!is) continue;
    NewTet fresh{changed.tet(t), changed.region(t)};
    for (VertexId& v : fresh.vertex) v = number[v];
    added.push_back(fresh);
  }
  whole.replace(removed, added);
}

}  // namespace scantet::optimize
