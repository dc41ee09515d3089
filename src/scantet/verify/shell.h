// A mesh in itself: its boundary, derived from the tets alone, and what is wrong with either.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/verify/verify.h"

namespace scantet::verify {

/// The faces of a tet that is positively oriented, seen from outside; each with the vertex opposite to it left out.
inline constexpr std::array<std::array<int, 3>, 4> kFaces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// The boundary of all tets together, whatever their regions.
struct Shell {
  std::vector<VertexId> vertices;         ///< of the mesh, ascending: those of facets
  std::vector<Triangle> facets;           ///< of indices into `vertices`; their right-hand normal points out of the tet
  std::vector<std::uint32_t> tet_behind;  ///< one a facet

  std::vector<std::uint32_t> star_begin;  ///< one a vertex and one more: where its facets begin in `star`
  std::vector<std::uint32_t> star;        ///< facets
  std::vector<std::uint8_t> is_disc;      ///< one a vertex: its facets follow each other once around it

  std::vector<std::uint32_t> component;  ///< one a facet, from 0
  std::vector<std::int64_t> euler;       ///< one a component
  std::vector<std::uint32_t> first;      ///< its first facet
  std::size_t tet_components = 0;        ///< of the tets, joined through faces
  bool is_closed = false;                ///< every edge has two facets, which run along it in opposite directions
  bool is_manifold = false;              ///< closed, and all stars are discs

  const Triangle& facet(std::size_t f) const { return facets[f]; }
};

/// Builds it, and puts into `faults` what is wrong: tets that are not positive (exactly), faces of more than two tets
/// or of two on the same side, edges and vertices where the boundary is no surface, several regions.
Shell make_shell(const TetMesh& mesh, std::vector<VerifyFinding>& faults);

/// A surface by itself: facets of mesh.vertices, whose tets are not looked at; tet_behind is empty.
Shell make_shell(const TetMesh& mesh, std::vector<Triangle> facets, std::vector<VerifyFinding>& faults);

}  // namespace scantet::verify
