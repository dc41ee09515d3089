// A tetrahedral mesh whose tets can be replaced a few at a time: what exudation and improvement work on.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scantet/base/tet_mesh.h"

namespace scantet::optimize {

using TetId = std::uint32_t;
inline constexpr TetId kNoTet = 0xffffffff;

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
  explicit TetComplex(TetMesh mesh);

  std::size_t vertex_slots() const { return mesh_.vertices.size(); }
  std::size_t tet_slots() const { return mesh_.tets.size(); }
  bool is_tet(TetId t) const { return mesh_.tet_regions[t] != kOutside; }
  const Point& point(VertexId v) const { return mesh_.vertices[v]; }
  bool on_boundary(VertexId v) const { return mesh_.on_boundary[v] != 0; }
  const Tet& tet(TetId t) const { return mesh_.tets[t]; }
  Region region(TetId t) const { return mesh_.tet_regions[t]; }

  /// The tets around v, in an order that depends on the history of the complex only. Valid until tets change.
  std::span<const TetId> star(VertexId v) const;

  /// The tet beyond the face of t opposite to its corner k; kNoTet where the mesh ends.
  TetId across(TetId t, int k) const;
  /// The face opposite to corner k lies between two regions, or between a region and the outside.
  bool is_boundary_face(TetId t, int k) const;

  void move(VertexId v, const Point& p) { mesh_.vertices[v] = p; }
  VertexId add_vertex(const Point& p, bool on_boundary);

  /// Takes tets away and adds others that fill the same place; a vertex without tets is dropped by release().
  /// Pre: the union of both is the same, but for boundary faces that the caller means to change.
  void replace(std::span<const TetId> removed, std::span<const NewTet> added);

  /// The mesh as TetMesh promises it: no empty slots, no vertex without tets, boundary facets up to date and sorted as
  /// build_boundary sorts them. The complex is empty afterwards. What did not change keeps its order.
  TetMesh release();

 private:
  void keep_star(VertexId v);  // gives v a list of its own, which can change

  TetMesh mesh_;
  std::vector<TetId> free_;           // slots of tets taken away
  std::vector<std::uint32_t> first_;  // the stars at the start: star v is tets_around_[first_[v] … first_[v + 1])
  std::vector<TetId> tets_around_;
  std::vector<std::uint32_t> own_star_;        // one per vertex: 1 + its index in stars_, 0 if it has not changed
  std::vector<std::vector<TetId>> stars_;      // of vertices whose tets have changed
  std::vector<Triangle> lost_facets_;          // boundary facets of tets taken away, vertices ascending
  std::vector<std::uint8_t> boundary_changed_;  // one per vertex: a boundary facet at it may have changed
};

}  // namespace scantet::optimize
