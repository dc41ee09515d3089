// A mesh in itself: its boundary, derived from the tets alone, and what is wrong with either.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/verify/verify.h"

namespace scantet::verify {

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

/// How many tets cover the inside of each component of the boundary, just behind it, must be one: then, with positive
/// tets and a boundary that is embedded, tets overlap nowhere. Adds what is wrong to `faults`.
/// Return: whether that is so.
bool check_coverage(const TetMesh& mesh, const Shell& shell, std::vector<VerifyFinding>& faults);

/// Calls visit(facet, direction) for the facets that a ray from p along x meets: direction 1 if it leaves the mesh
/// there, -1 if it enters. Return: false if it meets an edge or a vertex, or starts on a facet; then the visits mean
/// nothing.
class BoundaryRays {
 public:
  BoundaryRays(const TetMesh& mesh, const Shell& shell);
  ~BoundaryRays();
  BoundaryRays(const BoundaryRays&) = delete;
  BoundaryRays& operator=(const BoundaryRays&) = delete;
  struct Hit {
    std::uint32_t facet;
    int direction;
  };
  bool cast(const Point& p, std::vector<Hit>& hits) const;
  /// How often the mesh covers p; hits: what a ray from there meets. has_moved: set if the ray had to begin up to 1e-5
  /// mm beside p. -1: not known.
  int coverage(const Point& p, std::vector<Hit>& hits, bool& has_moved) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scantet::verify
