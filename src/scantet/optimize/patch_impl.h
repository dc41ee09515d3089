// Private: a part of a complex, to be changed on trial.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scantet/optimize/worst_first_impl.h"

namespace scantet::optimize {

/// Some tets of a complex as a complex of their own. Its rim is where other tets of the whole are beyond their faces.
class Patch {
 public:
  /// tets: of the whole, without repeats.
  Patch(const TetComplex& whole, std::vector<TetId> tets);

  /// The part as it is in the whole. A copy of it may be changed by what keeps off the rim.
  const TetComplex& complex() const { return complex_; }
  /// The vertices of the part as the whole numbers them, ascending.
  const std::vector<VertexId>& vertices() const { return vertices_; }
  /// Whether the change moves no vertex of the rim and takes away no tet with a face there.
  bool keeps_off_rim(const Change& change) const;
  bool is_on_rim(VertexId v) const { return v < rim_vertices_.size() && rim_vertices_[v] != 0; }

  /// Makes the whole, which has not changed here since, as the changed copy is.
  void put_into(TetComplex& whole, const TetComplex& changed) const;

 private:
  void find_rim();

  std::vector<TetId> tets_;
  std::vector<VertexId> vertices_;
  TetComplex complex_;
  std::vector<std::uint8_t> rim_tets_;
  std::vector<std::uint8_t> rim_vertices_;
};

/// The vertices of these tets, ascending, each once.
std::vector<VertexId> vertices_of(const TetComplex& complex, std::span<const TetId> tets);

/// The tets around vertices of these tets, and those around theirs, and so on; rings: how often. Ascending.
std::vector<TetId> tets_around(const TetComplex& complex, std::span<const TetId> tets, int rings);

}  // namespace scantet::optimize
