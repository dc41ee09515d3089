// The stars lie in one array, tight at first; one that grows moves to the end with room to spare. Boundary facets can
// only have changed where all three vertices belong to tets that were replaced: those are derived anew, the others are
// kept.
#include <algorithm>
#include <cassert>
#include <utility>

#include "scantet/base/mesh_topology.h"
#include "scantet/base/parallel.h"
#include "scantet/optimize/tet_complex_impl.h"

namespace scantet::optimize {
namespace {

/// A face of a tet with its vertices in ascending order. k says which corner of the tet it is opposite to.
struct Face {
  Triangle ascending;
  TetId tet;
  int k;

  friend bool operator<(const Face& a, const Face& b) {
    return a.ascending != b.ascending ? a.ascending < b.ascending : a.tet < b.tet;
  }
};

Triangle ascending(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

}  // namespace

std::array<VertexId, 2> opposite_edge(const Tet& tet, VertexId a, VertexId b) {
  assert(a != b && has_vertex(tet, b));
  Triangle face = face_of(tet, corner_index(tet, a));  // points away from a: with a in front it is oriented like tet
  std::rotate(face.begin(), std::find(face.begin(), face.end(), b), face.end());
  return {face[1], face[2]};
}

TetComplex::TetComplex(TetMesh mesh, const TetJudge& judge)
    : mesh_(std::move(mesh)),
      judge_(judge),
      curve_judge_(judge.without_rules()),
      has_curves_(!mesh_.curves.empty() || !mesh_.corners.empty()),
      changed_(mesh_.vertices.size(), 0) {
  build_stars();
  list_sharp_edges();
}

void TetComplex::list_sharp_edges() {
  for (std::size_t e = 0; e < mesh_.curve_edges.size(); ++e) {
    const auto [a, b] = mesh_.curve_edges[e];
    if (mesh_.curves[mesh_.edge_curves[e]].is_sharp) sharp_edges_.emplace_back(std::min(a, b), std::max(a, b));
  }
  std::sort(sharp_edges_.begin(), sharp_edges_.end());
}

TetComplex TetComplex::part(std::span<const TetId> tets, const std::vector<VertexId>& vertices) const {
  const auto number_of = [&](VertexId v) {
    return static_cast<VertexId>(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin());
  };
  TetMesh mesh;
  for (const VertexId v : vertices) {
    mesh.vertices.push_back(mesh_.vertices[v]);
    mesh.strata.push_back(mesh_.strata[v]);
  }
  for (const TetId t : tets) {
    Tet tet = mesh_.tets[t];
    for (VertexId& v : tet) v = number_of(v);
    mesh.tets.push_back(tet);
    mesh.tet_regions.push_back(mesh_.tet_regions[t]);
  }
  TetComplex part(std::move(mesh), judge_);
  part.has_curves_ = has_curves_;
  for (const auto& [a, b] : sharp_edges_) {
    const bool has_both = std::binary_search(vertices.begin(), vertices.end(), a) &&
                          std::binary_search(vertices.begin(), vertices.end(), b);
    if (has_both) part.sharp_edges_.emplace_back(number_of(a), number_of(b));
  }
  part.cut_faces_.assign(tets.size(), {});
  for (TetId t = 0; t < tets.size(); ++t) {
    for (int k = 0; k < 4; ++k) part.cut_faces_[t][k] = part.across(t, k) == kNoTet && across(tets[t], k) != kNoTet;
  }
  return part;
}

/// A counting sort in pieces: each piece of the tets has its own counts, so that it knows where in each star to write.
void TetComplex::build_stars() {
  constexpr std::size_t kPieces = 4;
  const std::size_t vertices = mesh_.vertices.size();
  const std::size_t grain = mesh_.tets.size() / kPieces + 1;
  std::array<std::vector<std::uint32_t>, kPieces> place;  // by piece and vertex: how many tets, then the next entry
  parallel_for(mesh_.tets.size(), grain, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t>& count = place[begin / grain];
    count.assign(vertices, 0);
    for (std::size_t t = begin; t < end; ++t) {
      for (const VertexId v : mesh_.tets[t]) ++count[v];
    }
  });
  stars_.resize(vertices);
  std::uint32_t next = 0;
  for (std::size_t v = 0; v < vertices; ++v) {
    stars_[v].begin = next;
    for (auto& count : place) {
      if (!count.empty()) next += std::exchange(count[v], next);
    }
    stars_[v].size = stars_[v].capacity = next - stars_[v].begin;
  }
  around_.resize(next);
  parallel_for(mesh_.tets.size(), grain, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t>& write = place[begin / grain];
    for (std::size_t t = begin; t < end; ++t) {
      for (const VertexId v : mesh_.tets[t]) around_[write[v]++] = static_cast<TetId>(t);
    }
  });
}

TetId TetComplex::across(TetId t, int k) const {
  const Triangle face = face_of(tet(t), k);
  const auto fewer = [&](VertexId a, VertexId b) { return stars_[a].size < stars_[b].size; };
  const VertexId lonely = *std::min_element(face.begin(), face.end(), fewer);
  for (const TetId other : star(lonely)) {
    if (other == t) continue;
    const Tet& w = tet(other);
    if (has_vertex(w, face[0]) && has_vertex(w, face[1]) && has_vertex(w, face[2])) return other;
  }
  return kNoTet;
}

bool TetComplex::is_boundary_face(TetId t, int k) const {
  const TetId other = across(t, k);
  return other == kNoTet ? !is_cut(t, k) : region(other) != region(t);
}

VertexId TetComplex::add_vertex(const Point& p, bool on_boundary) {
  assert(is_finite(p));
  mesh_.vertices.push_back(p);
  mesh_.strata.push_back({0, static_cast<std::uint8_t>(on_boundary ? 2 : 3)});
  stars_.push_back({});
  changed_.push_back(0);
  return static_cast<VertexId>(mesh_.vertices.size() - 1);
}

void TetComplex::join_star(VertexId v, TetId t) {
  Star& star = stars_[v];
  if (star.size == star.capacity) {
    const std::uint32_t capacity = star.capacity + star.capacity / 2 + 8;
    const auto begin = static_cast<std::uint32_t>(around_.size());
    around_.resize(around_.size() + capacity, kNoTet);
    std::copy_n(around_.begin() + star.begin, star.size, around_.begin() + begin);
    star.begin = begin;
    star.capacity = capacity;
  }
  around_[star.begin + star.size++] = t;
}

void TetComplex::leave_star(VertexId v, TetId t) {
  Star& star = stars_[v];
  const auto begin = around_.begin() + star.begin;
  const auto found = std::find(begin, begin + star.size, t);
  assert(found != begin + star.size);
  *found = *(begin + star.size - 1);
  --star.size;
}

void TetComplex::mark_changed(const Tet& tet) {
  for (const VertexId v : tet) changed_[v] = mesh_.on_boundary(v) ? 1 : 0;
}

/// Has four vertices of the complex, and a region.
bool TetComplex::is_possible(const NewTet& fresh) const {
  Tet v = fresh.vertex;
  std::sort(v.begin(), v.end());
  return std::adjacent_find(v.begin(), v.end()) == v.end() && v[3] < vertex_slots() && fresh.region != kOutside;
}

bool TetComplex::is_same_place(std::span<const TetId> removed, std::span<const NewTet> added) const {
  std::vector<Triangle> faces;
  const auto add_faces = [&](const Tet& tet) {
    for (int k = 0; k < 4; ++k) faces.push_back(ascending(face_of(tet, k)));
  };
  for (const TetId t : removed) add_faces(tet(t));
  for (const NewTet& fresh : added) add_faces(fresh.vertex);
  std::sort(faces.begin(), faces.end());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (i + 1 < faces.size() && faces[i] == faces[i + 1]) {
      ++i;
    } else if (!std::all_of(faces[i].begin(), faces[i].end(), [&](VertexId v) { return on_boundary(v); })) {
      return false;
    }
  }
  return true;
}

std::span<const TetId> TetComplex::replace(std::span<const TetId> removed, std::span<const NewTet> added) {
  assert(std::all_of(removed.begin(), removed.end(), [&](TetId t) { return is_tet(t); }));
  assert(std::all_of(added.begin(), added.end(), [&](const NewTet& fresh) { return is_possible(fresh); }));
  for (const TetId t : removed) {
    mark_changed(tet(t));
    for (const VertexId v : tet(t)) leave_star(v, t);
    mesh_.tet_regions[t] = kOutside;
    free_.push_back(t);
  }
  used_.clear();
  for (const NewTet& fresh : added) {
    if (free_.empty()) {
      free_.push_back(static_cast<TetId>(mesh_.tets.size()));
      mesh_.tets.emplace_back();
      mesh_.tet_regions.push_back(kOutside);
    }
    const TetId t = free_.back();
    free_.pop_back();
    mesh_.tets[t] = fresh.vertex;
    mesh_.tet_regions[t] = fresh.region;
    mark_changed(fresh.vertex);
    for (const VertexId v : fresh.vertex) join_star(v, t);
    used_.push_back(t);
  }
  return used_;
}

TetMesh TetComplex::release() {
  update_boundary();
  drop_free_tets();
  drop_lone_vertices();
  set_strata(mesh_);
  TetMesh mesh = std::exchange(mesh_, {});
  *this = TetComplex(TetMesh{});
  return mesh;
}

/// Replaces the boundary facets whose vertices have all changed.
void TetComplex::update_boundary() {
  const std::vector<Facet> fresh = changed_facets();
  std::vector<Facet> facets;
  facets.reserve(mesh_.boundary_facets.size() + fresh.size());
  auto next = fresh.begin();
  for (std::size_t i = 0; i < mesh_.boundary_facets.size(); ++i) {
    const Facet facet{mesh_.boundary_facets[i], mesh_.facet_regions[i]};
    if (has_changed(facet.oriented)) continue;
    while (next != fresh.end() && ascending(next->oriented) < ascending(facet.oriented)) facets.push_back(*next++);
    facets.push_back(facet);
  }
  facets.insert(facets.end(), next, fresh.end());
  mesh_.boundary_facets.clear();
  mesh_.facet_regions.clear();
  for (const Facet& facet : facets) {
    mesh_.boundary_facets.push_back(facet.oriented);
    mesh_.facet_regions.push_back(facet.regions);
  }
}

/// The boundary facets whose vertices have all changed, as the tets have them now, in order.
std::vector<TetComplex::Facet> TetComplex::changed_facets() const {
  std::vector<Face> faces;
  for (VertexId v = 0; v < changed_.size(); ++v) {
    if (changed_[v] == 0) continue;
    for (const TetId t : star(v)) {
      for (int k = 0; k < 4; ++k) {
        const Triangle face = ascending(face_of(tet(t), k));
        if (face[0] == v && has_changed(face)) faces.push_back({face, t, k});
      }
    }
  }
  std::sort(faces.begin(), faces.end());

  std::vector<Facet> facets;
  const auto add = [&](const Face& behind, Region in_front) {
    Triangle facet = face_of(tet(behind.tet), behind.k);
    std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
    facets.push_back({facet, {region(behind.tet), in_front}});
  };
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (i + 1 == faces.size() || faces[i].ascending != faces[i + 1].ascending) {
      add(faces[i], kOutside);
      continue;
    }
    const Region a = region(faces[i].tet);
    const Region b = region(faces[i + 1].tet);
    if (a != b) add(a < b ? faces[i] : faces[i + 1], std::max(a, b));
    ++i;
  }
  return facets;
}

void TetComplex::drop_free_tets() {
  if (free_.empty()) return;
  std::size_t kept = *std::min_element(free_.begin(), free_.end());
  for (std::size_t t = kept; t < mesh_.tets.size(); ++t) {
    if (mesh_.tet_regions[t] == kOutside) continue;
    mesh_.tets[kept] = mesh_.tets[t];
    mesh_.tet_regions[kept++] = mesh_.tet_regions[t];
  }
  mesh_.tets.resize(kept);
  mesh_.tet_regions.resize(kept);
}

void TetComplex::drop_lone_vertices() {
  const auto lone = [](const Star& star) { return star.size == 0; };
  if (std::none_of(stars_.begin(), stars_.end(), lone)) return;
  std::vector<VertexId> number(stars_.size());
  VertexId kept = 0;
  for (VertexId v = 0; v < stars_.size(); ++v) {
    number[v] = kept;
    if (lone(stars_[v])) continue;
    mesh_.vertices[kept++] = mesh_.vertices[v];
  }
  mesh_.vertices.resize(kept);
  for (Tet& tet : mesh_.tets) {
    for (VertexId& v : tet) v = number[v];
  }
  for (Triangle& facet : mesh_.boundary_facets) {
    for (VertexId& v : facet) v = number[v];
  }
  for (auto& edge : mesh_.curve_edges) {
    for (VertexId& v : edge) v = number[v];
  }
}

}  // namespace scantet::optimize
