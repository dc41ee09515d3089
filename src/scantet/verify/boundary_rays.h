// Where rays meet the boundary of a mesh, hence what the mesh covers.
#pragma once

#include <vector>

#include "scantet/verify/box_tree.h"
#include "scantet/verify/shell.h"

namespace scantet::verify {

/// The boundary's facets in a tree, and rays along x through it. Const methods may be called from many threads.
class BoundaryRays {
 public:
  /// mesh, shell: must outlive it.
  BoundaryRays(const TetMesh& mesh, const Shell& shell);
  struct Hit {
    std::uint32_t facet;
    int direction;  ///< 1 if the ray leaves the mesh there, -1 if it enters
  };
  static constexpr std::uint32_t kNone = 0xffffffff;
  /// hits: the facets that a ray from p meets, but for those of the component `without`. Return: false if it meets an
  /// edge or a vertex, or starts on a facet; then the hits mean nothing.
  bool cast(const Point& p, std::vector<Hit>& hits, std::uint32_t without = kNone) const;
  /// How often the mesh covers p; hits: what a ray from there meets. has_moved: set if the ray had to begin up to 1e-5
  /// mm beside p. -1: not known.
  int coverage(const Point& p, std::vector<Hit>& hits, bool& has_moved) const;
  /// The boxes of the facets, mm.
  const BoxTree& tree() const { return tree_; }

 private:
  const Point& corner(std::uint32_t facet, std::size_t n) const {
    return mesh_.vertices[shell_.vertices[shell_.facets[facet][n]]];
  }

  const TetMesh& mesh_;
  const Shell& shell_;
  BoxTree tree_;
};

/// How many tets cover the inside of each component of the boundary, just behind it, must be one: then, with positive
/// tets and a boundary that is embedded, tets overlap nowhere. Adds what is wrong to `faults`.
/// Return: whether that is so.
bool check_coverage(const TetMesh& mesh, const Shell& shell, const BoundaryRays& rays,
                    std::vector<VerifyFinding>& faults);

}  // namespace scantet::verify
