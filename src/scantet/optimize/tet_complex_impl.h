// A tetrahedral mesh whose tets can be replaced a few at a time: what exudation and improvement work on.
#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <cassert>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "scantet/base/mesh_topology.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/optimize/tet_judge_impl.h"

namespace scantet::optimize {

using TetId = std::uint32_t;
inline constexpr TetId kNoTet = 0xffffffff;

inline bool has_vertex(const Tet& tet, VertexId v) {
  return tet[0] == v || tet[1] == v || tet[2] == v || tet[3] == v;
}

/// Which corner of the tet v is. Pre: it is one.
inline int corner_index(const Tet& tet, VertexId v) {
  assert(has_vertex(tet, v));
  return tet[0] == v ? 0 : tet[1] == v ? 1 : tet[2] == v ? 2 : 3;
}

/// The vertices c and d of the tet so that (a, b, c, d) is oriented like it. Pre: a and b are two of the others.
std::array<VertexId, 2> opposite_edge(const Tet& tet, VertexId a, VertexId b);

/// A tet to be added: positively oriented.
struct NewTet {
  Tet vertex;
  Region region;
};

/// The tets of a mesh with, for each vertex, the tets around it. Neighbours are not stored: they are found from the
/// stars, which only what is improved pays for. Const methods may be called from many threads at once.
class TetComplex {
 public:
  /// Takes the mesh over. The boundary facets are kept as they are until tets at them change.
  explicit TetComplex(TetMesh mesh, const TetJudge& judge = TetJudge());

  /// Some of the tets, in their order, as a complex of its own. vertices: all of theirs, ascending; the new one numbers
  /// them in this order, and knows where it was cut out. What release() says of boundary facets does not hold for it.
  TetComplex part(std::span<const TetId> tets, const std::vector<VertexId>& vertices) const;

  std::size_t vertex_slots() const { return mesh_.vertices.size(); }
  std::size_t tet_slots() const { return mesh_.tets.size(); }
  bool is_tet(TetId t) const { return mesh_.tet_regions[t] != kOutside; }
  const Point& point(VertexId v) const { return mesh_.vertices[v]; }
  bool on_boundary(VertexId v) const { return mesh_.on_boundary(v); }
  bool has_curves() const { return has_curves_; }                            ///< or corners
  bool on_curve(VertexId v) const { return mesh_.strata[v].dimension < 2; }  ///< or at a corner
  /// Whether the edge ab is one of a curve that the tets do not tell.
  bool is_sharp_edge(VertexId a, VertexId b) const {
    return std::binary_search(sharp_edges_.begin(), sharp_edges_.end(), std::pair(std::min(a, b), std::max(a, b)));
  }
  const Tet& tet(TetId t) const { return mesh_.tets[t]; }
  Region region(TetId t) const { return mesh_.tet_regions[t]; }
  const TetJudge& judge() const { return judge_; }
  /// What the judge says of a tet of the complex or of one that could be.
  double sharpness(const Tet& t, double too_sharp = kInverted) const {
    const TetJudge& judge = has_curves_ && touches_curve(mesh_, t) ? curve_judge_ : judge_;
    return judge.sharpness(point(t[0]), point(t[1]), point(t[2]), point(t[3]), too_sharp);
  }

  /// The tets around v, in an order that depends on the history of the complex only. Valid until tets change.
  std::span<const TetId> star(VertexId v) const { return {around_.data() + stars_[v].begin, stars_[v].size}; }

  /// The tet beyond the face of t opposite to its corner k; kNoTet where the mesh ends.
  TetId across(TetId t, int k) const;
  /// Whether the complex is a part() of another one that goes on beyond this face. Pre: if so, t is still the part's.
  bool is_cut(TetId t, int k) const { return t < cut_faces_.size() && cut_faces_[t][k]; }
  /// The face opposite to corner k lies between two regions, or between a region and the outside.
  bool is_boundary_face(TetId t, int k) const;

  /// A vertex of a curve stays one.
  void move(VertexId v, const Point& p, bool on_boundary) {
    assert(is_finite(p));
    mesh_.vertices[v] = p;
    if (!on_curve(v)) mesh_.strata[v].dimension = on_boundary ? 2 : 3;
  }
  VertexId add_vertex(const Point& p, bool on_boundary);

  /// Takes tets away and adds others that fill the same place; a vertex without tets is dropped by release().
  /// Pre: the union of both is the same, but for boundary faces that the caller means to change; vertices of new
  /// boundary faces are on_boundary.
  /// Returns the slots of the added ones, in their order; valid until the next call.
  std::span<const TetId> replace(std::span<const TetId> removed, std::span<const NewTet> added);
  /// Whether both have the same faces towards the tets around them, but for faces with all vertices on the boundary.
  bool is_same_place(std::span<const TetId> removed, std::span<const NewTet> added) const;

  /// The mesh as TetMesh promises it: no empty slots, no vertex without tets, boundary facets up to date and sorted as
  /// build_boundary sorts them. The complex is empty afterwards. What did not change keeps its order.
  TetMesh release();

 private:
  /// Where in around_ the tets around a vertex are listed.
  struct Star {
    std::uint32_t begin = 0;
    std::uint32_t size = 0;
    std::uint32_t capacity = 0;
  };

  struct Facet {
    Triangle oriented;
    std::array<Region, 2> regions;
  };

  void build_stars();
  void list_sharp_edges();
  void join_star(VertexId v, TetId t);
  void leave_star(VertexId v, TetId t);
  void mark_changed(const Tet& tet);
  bool is_possible(const NewTet& fresh) const;
  bool has_changed(const Triangle& f) const {
    return changed_[f[0]] != 0 && changed_[f[1]] != 0 && changed_[f[2]] != 0;
  }
  void update_boundary();
  std::vector<Facet> changed_facets() const;
  void drop_free_tets();
  void drop_lone_vertices();

  TetMesh mesh_;
  TetJudge judge_;
  TetJudge curve_judge_;  // of tets with a vertex on a curve
  bool has_curves_;
  std::vector<std::pair<VertexId, VertexId>> sharp_edges_;  // ascending
  std::vector<TetId> free_;                                 // the slots of tets that were taken away
  std::vector<TetId> used_;                                 // the slots that the last call of replace() filled
  std::vector<Star> stars_;                                 // one per vertex
  std::vector<TetId> around_;
  std::vector<std::bitset<4>> cut_faces_;  // by tet, of a part
  std::vector<std::uint8_t> changed_;      // one per vertex: 1 if it is on the boundary and tets at it have changed
};

}  // namespace scantet::optimize
